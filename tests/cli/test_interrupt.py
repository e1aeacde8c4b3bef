"""Ctrl+C: the first is noted, an echo of it ignored, a later one doesn't wait."""

import signal
import sys

import pytest

from mc_nested.cli import interrupt as interrupt_module
from mc_nested.cli.interrupt import catch_interrupts


def test_first_ctrl_c_is_recorded_and_its_echo_is_ignored() -> None:
    with catch_interrupts() as interrupt:
        assert not interrupt.requested
        signal.raise_signal(signal.SIGINT)
        assert interrupt.requested
        signal.raise_signal(signal.SIGINT)


def test_a_later_ctrl_c_interrupts_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interrupt_module, "SAME_REQUEST_S", -1.0)
    with catch_interrupts():
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)


def test_signal_handlers_are_restored_after_the_block() -> None:
    before = signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)
    with catch_interrupts():
        pass
    assert (signal.getsignal(signal.SIGINT), signal.getsignal(signal.SIGTERM)) == before


def test_message_after_ctrl_c_is_printed_once(capfd: pytest.CaptureFixture[str]) -> None:
    with catch_interrupts() as interrupt:
        interrupt.says = "stopping"
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
    assert capfd.readouterr().err == "stopping\n"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGHUP")
def test_a_closed_terminal_is_recorded_unless_hang_ups_are_ignored() -> None:
    before = signal.signal(signal.SIGHUP, signal.SIG_DFL)  # the tests may run under nohup
    try:
        with catch_interrupts() as interrupt:
            signal.raise_signal(signal.SIGHUP)
            assert interrupt.requested
        signal.signal(signal.SIGHUP, signal.SIG_IGN)
        with catch_interrupts() as interrupt:
            signal.raise_signal(signal.SIGHUP)
            assert not interrupt.requested
    finally:
        signal.signal(signal.SIGHUP, before)
