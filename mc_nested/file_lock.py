"""A lock by a file, for one process at a time; the system releases it when that process ends, even if it is killed."""

import contextlib
import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

if sys.platform == "win32":
    import msvcrt

    _FAR_BEHIND = 1 << 20
    """The byte that is locked: nobody else can read it then, and everybody may read the process id at the beginning."""
    _BEING_REMOVED_S = 2.0
    """Seconds after which a file that can't be opened is one that may not be opened."""
    _AGAIN_S = 0.01

    def _take(file: int) -> None:
        os.lseek(file, _FAR_BEHIND, os.SEEK_SET)
        msvcrt.locking(file, msvcrt.LK_NBLCK, 1)

    def _give_back(file: int) -> None:
        # Windows lifts the lock of a file that is closed, but not at once.
        os.lseek(file, _FAR_BEHIND, os.SEEK_SET)
        msvcrt.locking(file, msvcrt.LK_UNLCK, 1)

    def _open(path: Path) -> int:
        """Open or make the file.

        While another process removes it, Windows refuses that, as if it were not permitted.
        """
        until = time.monotonic() + _BEING_REMOVED_S
        while True:
            try:
                return os.open(path, os.O_RDWR | os.O_CREAT)
            except PermissionError:  # noqa: PERF203 - it is tried again
                if time.monotonic() > until:
                    raise
                time.sleep(_AGAIN_S)
else:
    import fcntl

    def _take(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)

    def _give_back(file: int) -> None:
        fcntl.flock(file, fcntl.LOCK_UN)

    def _open(path: Path) -> int:
        return os.open(path, os.O_RDWR | os.O_CREAT, 0o600)


_LONGEST_ID = 20
"""Bytes of a process id that are read."""


@dataclass(frozen=True)
class Lock:
    """A lock: whether it is this process's, and the id of the process that has it; None where the file doesn't say."""

    is_mine: bool
    holder: int | None


@contextmanager
def file_lock(path: Path) -> Iterator[Lock]:
    """Try to take the lock for the block, and yield whether this process has it; don't wait for another to give it up.

    The file is removed after the block, but stays if the process is killed: its presence proves no lock.
    Raise OSError if the file can't be made, or is on a disk that knows no locks.
    """
    file, is_mine = _opened(path)
    try:
        if not is_mine:
            yield Lock(False, _holder(file))
            return
        os.lseek(file, 0, os.SEEK_SET)
        os.ftruncate(file, 0)
        os.write(file, str(os.getpid()).encode())
        try:
            yield Lock(True, os.getpid())
        finally:
            if sys.platform != "win32":  # which removes no open file
                _remove(path)
            _give_back(file)
    finally:
        os.close(file)
        if sys.platform == "win32" and is_mine:
            _remove(path)  # refused where another process has opened it by now


def _opened(path: Path) -> tuple[int, bool]:
    """Open the file, and return it with whether this process has locked it."""
    while True:
        file = _open(path)
        try:
            _take(file)
        except (BlockingIOError, PermissionError):  # another process has it: POSIX's error, and Windows's
            return file, False
        except BaseException:
            os.close(file)
            raise
        if _is_still_there(file, path):
            return file, True
        os.close(file)  # it was removed between opening and locking: another process may have made a new one


def _is_still_there(file: int, path: Path) -> bool:
    try:
        return os.path.samestat(os.fstat(file), path.stat())
    except FileNotFoundError:
        return False


def _holder(file: int) -> int | None:
    os.lseek(file, 0, os.SEEK_SET)
    written = os.read(file, _LONGEST_ID)
    return int(written) if written.isdigit() else None


def _remove(path: Path) -> None:
    with contextlib.suppress(OSError):
        path.unlink()
