"""Atomic writes: after a crash, a full disk or Ctrl+C the old file is intact."""

import errno
import os
import secrets
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mc_nested.errors import UserError

SUFFIX = ".unfinished"
"""Ends the name of a file that is still being written, or that a killed process left behind."""


FULL = "no space left on the disk"

LEAST_FREE = 1 << 16
"""Bytes; with fewer, what failed to be written had no room, in whatever words a library says so."""


class FullDiskError(OSError):
    """There was no room for a file."""

    def __str__(self) -> str:
        return FULL


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield a temporary path to write to; its file replaces ``path`` when the block ends, or is removed after an error.

    Raise OSError if the disk refuses; FullDiskError if it is full.
    """
    unfinished = path.with_name(f"{path.name}.{secrets.token_hex(4)}{SUFFIX}")
    try:
        yield unfinished
        with unfinished.open("rb+") as file:  # Windows flushes only what is open for writing
            os.fsync(file.fileno())
        unfinished.replace(path)
    except BaseException as error:
        full = isinstance(error, Exception) and _is_full(error, path.parent)
        # Removed even after an error, so that a full disk has room again.
        unfinished.unlink(missing_ok=True)
        if full:
            raise FullDiskError(errno.ENOSPC, FULL, str(path)) from error
        raise


@contextmanager
def whole_folder(path: Path, kind: type[UserError]) -> Iterator[Path]:
    """Yield a new folder to write to, which becomes ``path`` when the block ends, or is removed after an error.

    Raise ``kind``, one line, if there is something already, or the disk refuses.
    """
    if path.exists():
        raise kind(f"{path}: is there already: name a new folder, nothing was overwritten")
    unfinished = path.with_name(f"{path.name}.{secrets.token_hex(4)}{SUFFIX}")
    try:
        with refused_as(kind, path, "name another folder, or make room"):
            unfinished.mkdir(parents=True)
            yield unfinished
            unfinished.rename(path)
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)


@contextmanager
def refused_as(kind: type[UserError], what: Path, remedy: str) -> Iterator[None]:
    """Raise ``kind`` where the disk refuses what the block does: one line that says what, why and the remedy."""
    try:
        yield
    except OSError as error:
        raise kind(f"{what}: can't be written ({error.strerror or error}): {remedy}") from error


def _is_full(error: Exception, folder: Path) -> bool:
    """Return whether an error, or the one that it is about, says that a disk is full, or the folder's is."""
    if any(getattr(each, "errno", None) == errno.ENOSPC for each in (error, error.__context__)):
        return True
    try:
        return shutil.disk_usage(folder).free < LEAST_FREE
    except OSError:
        return False


def is_leftover(path: Path) -> bool:
    """Return whether the file was being written when a process was killed; only for files that nobody writes now."""
    return path.name.endswith(SUFFIX)


def remove_leftovers(folder: Path) -> None:
    """Remove what killed processes left in a folder that nobody else writes to."""
    for path in folder.iterdir():
        if is_leftover(path):
            path.unlink(missing_ok=True)
