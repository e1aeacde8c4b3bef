"""Renaming and deleting a run's folder, while nobody writes there; nothing outside it is ever touched."""

import shutil
from pathlib import Path

from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.learn.runs.folder_lock import folder_lock, holder_of

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
                if entry.name == LOCK:
                    continue
                if entry.is_dir() and not entry.is_symlink():
                    shutil.rmtree(entry)
                else:
                    entry.unlink()
        folder.rmdir()
    except OSError as error:
        raise RunError(f"{error.filename}: can't be deleted, {error.strerror}: the rest is still there") from error
