"""A lock by a file, for one process at a time; the system lifts it when that process ends, even if it is killed."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

if sys.platform == "win32":
    import msvcrt

    def _take(file: int) -> None:
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)

    def _give_back(file: int) -> None:
        # Windows lifts the lock of a file that is closed, but not at once.
        os.lseek(file, 0, os.SEEK_SET)
        msvcrt.locking(file, msvcrt.LK_UNLCK, 1)
else:
    import fcntl

    def _take(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def _give_back(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_UN)


@contextmanager
def file_lock(path: Path) -> Iterator[bool]:
    """Take the lock for the block, and say whether it is this process's: it doesn't wait for another to give it up.

    The file stays: one that is removed could be locked by one process under its old name and by another under its new.
    OSError if the file can't be made, or is on a disk that knows no locks.
    """
    file = os.open(path, os.O_RDWR | os.O_CREAT, 0o600)
    try:
        try:
            _take(file)
        except (BlockingIOError, PermissionError):  # another process has it: POSIX's error, and Windows's
            yield False
            return
        try:
            yield True
        finally:
            _give_back(file)
    finally:
        os.close(file)
