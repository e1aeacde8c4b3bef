"""One process at a time writes to the folder of a run or a study."""

import errno
import os
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from mc_nested.errors import RunError
from mc_nested.file_lock import file_lock

FILE = "in-use.lock"
"""In the folder while a process writes there, with its id; one that was killed leaves it behind, unlocked."""

LOOK_EVERY_S = 0.05

_NO_LOCKS = (errno.ENOLCK, errno.ENOSYS, errno.ENOTSUP, errno.EOPNOTSUPP)


@contextmanager
def folder_lock(folder: Path, patience_s: float = 0.0) -> Iterator[None]:
    """Hold a folder for the block; it is made where there is none.

    RunError if another process, which it names, still holds it after ``patience_s``, or if nothing can be written
    there. On a disk that knows no locks, as some network disks, nobody is refused.
    """
    end = time.monotonic() + patience_s
    with ExitStack() as held:
        while holder := _held_by_another(folder, held):
            if time.monotonic() >= end:
                raise RunError(f"{folder}: {holder} is writing there: wait until it ends, or stop it")
            time.sleep(LOOK_EVERY_S)
        yield


def holder_of(folder: Path) -> str | None:
    """Return the process that holds a folder now, in words; None where none does, or it can't be told."""
    if not os.access(folder / FILE, os.R_OK | os.W_OK):
        return None
    try:
        with file_lock(folder / FILE) as lock:
            return None if lock.is_mine else _named(lock.holder)
    except OSError:
        return None


def _held_by_another(folder: Path, held: ExitStack) -> str | None:
    """Take the folder until ``held`` ends, or say which process has it."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        lock = held.enter_context(file_lock(folder / FILE))
    except OSError as error:
        if error.errno in _NO_LOCKS:
            return None
        raise RunError(f"{folder}: can't be written, {error.strerror}: name another folder") from error
    if lock.is_mine:
        return None
    held.close()
    return _named(lock.holder)


def _named(process: int | None) -> str:
    return "another process" if process is None else f"process {process}"
