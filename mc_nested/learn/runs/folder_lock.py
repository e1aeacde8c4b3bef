"""One process at a time writes to the folder of a run or a study.

While nobody writes there, it can be renamed and deleted; nothing outside it is ever touched.
"""

import errno
import os
import shutil
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
        raise RunError(f"{folder}: can't be written, {error.strerror}: name another folder, or make room") from error
    if lock.is_mine:
        return None
    held.close()
    return _named(lock.holder)


def _named(process: int | None) -> str:
    return "another process" if process is None else f"process {process}"


CONFIG = "config.toml"


def rename_folder(folder: Path, name: str) -> Path:
    """Give a folder another name, beside where it is; RunError if that isn't a free name, or somebody writes there."""
    if not name.strip() or name == ".." or Path(name).name != name:
        raise RunError(f"{name!r} is no name: it stays in {folder.parent}, name it without a folder")
    renamed = folder.with_name(name)
    if renamed.exists() or renamed.is_symlink():
        raise RunError(f"{renamed}: exists already: choose another name, nothing was changed")
    if holder := holder_of(folder):
        raise RunError(f"{folder}: {holder} is writing there: wait until it ends, or stop it")
    try:
        return folder.rename(renamed)
    except OSError as error:
        raise RunError(f"{folder}: can't be renamed, {error.strerror}: nothing was changed") from error


def delete_folder(folder: Path) -> None:
    """Delete a folder with all it holds; what links in it point to stays.

    RunError if it is a link itself, somebody writes there, or the disk refuses.
    """
    if folder.is_symlink():
        raise RunError(f"{folder}: is a link to {folder.readlink()}: delete that one, or remove the link yourself")
    try:
        with folder_lock(folder):
            # The folder counts as a run until the last moment, so that an interrupted deletion can be repeated.
            for entry in sorted(folder.iterdir(), key=lambda entry: entry.name == CONFIG):
                if entry.name == FILE:
                    continue
                if entry.is_dir() and not entry.is_symlink():
                    shutil.rmtree(entry)
                else:
                    entry.unlink()
        folder.rmdir()
    except OSError as error:
        raise RunError(f"{error.filename}: can't be deleted, {error.strerror}: the rest is still there") from error
