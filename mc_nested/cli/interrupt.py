"""Ctrl+C that lets the current step finish, so that everything can be saved."""

import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

INTERRUPTED = 130
"""Exit code after Ctrl+C."""

STDERR = 2

SAME_REQUEST_S = 1.0
"""A terminal and a launcher in it can both pass on the same Ctrl+C, and a finger can slip: a signal within this time of
the first is no second request."""


class Stopped(Exception):  # noqa: N818 - no error: it was asked for
    """The command was stopped on purpose; the message says what was saved and how to resume."""


class Interrupt:
    """A request to stop, if any. ``says``, unless empty, is written to standard error at the first request."""

    def __init__(self) -> None:
        self.requested = False
        self.says = ""
        self._first = 0.0

    def request(self, _number: int, _frame: FrameType | None) -> None:
        """Record a signal; a second one, SAME_REQUEST_S later or more, interrupts at once."""
        now = time.monotonic()
        if not self.requested:
            self.requested, self._first = True, now
            if self.says:
                with contextlib.suppress(OSError):
                    os.write(STDERR, f"{self.says}\n".encode())  # print can't be entered twice, a signal comes anywhere
        elif now - self._first > SAME_REQUEST_S:
            raise KeyboardInterrupt


@contextmanager
def catch_interrupts() -> Iterator[Interrupt]:
    """Only record the first Ctrl+C, SIGTERM, or SIGHUP of a closed terminal, while the block runs.

    A SIGHUP that is ignored, as under nohup, stays so. Outside the main thread nothing changes.
    """
    interrupt = Interrupt()
    if threading.current_thread() is not threading.main_thread():
        yield interrupt
        return
    numbers = [signal.SIGINT, signal.SIGTERM]
    if sys.platform != "win32" and signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:
        numbers.append(signal.SIGHUP)
    before = {number: signal.signal(number, interrupt.request) for number in numbers}
    try:
        yield interrupt
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
