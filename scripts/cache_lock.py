"""One run at a time in a folder of fetched files. Standard library only; Linux."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from scripts.standin_parts import Say
from scripts.standin_processes import wait_until

PATIENCE_S = 1800.0
"""Seconds to wait for another run: it may be fetching everything over a slow connection."""


class BusyError(Exception):
    """Another run doesn't end; the message is one line."""


@contextmanager
def alone(folder: Path, say: Say, script: str, patience_s: float = PATIENCE_S) -> Iterator[None]:
    """Let one run of ``script`` at a time use the folder: a second waits, BusyError where that takes too long.

    The kernel lifts the lock even if this process is killed.
    """
    import fcntl  # missing on Windows
    import os

    lock = os.open(folder, os.O_RDONLY)

    def is_mine() -> bool:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True

    try:
        if not is_mine():
            say(f"waiting for another {script} to end")
            if not wait_until(is_mine, patience_s):
                raise BusyError(f"another {script} is still running here: wait for it, or stop it")
        yield
    finally:
        os.close(lock)
