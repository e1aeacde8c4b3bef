"""Ctrl+C that lets the step in hand finish, so that what is saved is whole."""

import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

INTERRUPTED = 130
"""Exit code after Ctrl+C."""

ONE_AND_THE_SAME_S = 1.0
"""A terminal and a launcher in it can both pass on the same Ctrl+C, and a finger can slip: what comes within this time
of the first is no second request."""


class Stopped(Exception):  # noqa: N818 - no error: what was asked for, and how to go on
    """Somebody stopped the command; the message says what was saved."""


class Interrupt:
    """Whether somebody asked to stop."""

    def __init__(self) -> None:
        self.requested = False
        self._first = 0.0

    def request(self, _number: int, _frame: FrameType | None) -> None:
        """Take note of a signal; a second one, a while later, doesn't wait any longer."""
        now = time.monotonic()
        if not self.requested:
            self.requested, self._first = True, now
        elif now - self._first > ONE_AND_THE_SAME_S:
            raise KeyboardInterrupt


@contextmanager
def catch_interrupts() -> Iterator[Interrupt]:
    """While inside, the first Ctrl+C or termination only takes note; outside the main thread nothing changes."""
    interrupt = Interrupt()
    if threading.current_thread() is not threading.main_thread():
        yield interrupt
        return
    numbers = (signal.SIGINT, signal.SIGTERM)
    before = {number: signal.signal(number, interrupt.request) for number in numbers}
    try:
        yield interrupt
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
