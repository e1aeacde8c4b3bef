"""Signals that end the process, as exceptions; others' handlers and other threads are left alone."""

import signal
import threading
from types import FrameType

import pytest

from mc_nested.live.input.signals import signals_as_exit


def test_sigterm_raises_system_exit_and_the_default_handler_is_restored() -> None:
    with pytest.raises(SystemExit) as caught, signals_as_exit():
        signal.raise_signal(signal.SIGTERM)
    assert caught.value.code == 128 + signal.SIGTERM
    assert signal.getsignal(signal.SIGTERM) == signal.SIG_DFL


def test_a_signal_handler_that_other_code_set_stays() -> None:
    received: list[int] = []

    def note(number: int, _frame: FrameType | None) -> None:
        received.append(number)

    before = signal.signal(signal.SIGTERM, note)
    try:
        with signals_as_exit():
            signal.raise_signal(signal.SIGTERM)
        assert received == [signal.SIGTERM]
        assert signal.getsignal(signal.SIGTERM) is note
    finally:
        signal.signal(signal.SIGTERM, before)


def test_no_signal_handler_is_set_outside_the_main_thread() -> None:
    seen: list[object] = []

    def enter() -> None:
        with signals_as_exit():
            seen.append(signal.getsignal(signal.SIGTERM))

    thread = threading.Thread(target=enter)
    thread.start()
    thread.join()
    assert seen == [signal.SIG_DFL]
