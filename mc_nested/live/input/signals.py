"""Turns ending signals into an exception, so that every ``finally`` on the way out still runs."""

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_NAMES = ("SIGTERM", "SIGHUP", "SIGBREAK")
"""The signals that would end the process at once; SIGINT already is an exception. Not every system has all three."""


class EndedBySignal(SystemExit):
    """A signal ends the process; ``status`` is the exit code by shell convention, 128 plus the signal's number."""

    def __init__(self, number: int) -> None:
        self.status = 128 + number
        super().__init__(self.status)


@contextmanager
def signals_as_exit() -> Iterator[None]:
    """Raise EndedBySignal for a signal that would end the process, while the block runs.

    Handlers that others installed stay. Outside the main thread, where none may be set, nothing changes.
    """
    replaced: list[signal.Signals] = []
    try:
        if threading.current_thread() is threading.main_thread():
            for number in (getattr(signal, name) for name in _NAMES if hasattr(signal, name)):
                if signal.getsignal(number) == signal.SIG_DFL:
                    replaced.append(number)
                    signal.signal(number, _exit)
        yield
    finally:
        for number in replaced:
            signal.signal(number, signal.SIG_DFL)


def _exit(number: int, _frame: FrameType | None) -> None:
    raise EndedBySignal(number)
