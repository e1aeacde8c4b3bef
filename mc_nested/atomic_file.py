"""Atomic writes: after a crash, a full disk or Ctrl+C the old file is intact."""

import os
import secrets
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

SUFFIX = ".unfinished"
"""Ends the name of a file that is still being written, or that a killed process left behind."""


@contextmanager
def atomic_write(path: Path) -> Iterator[Path]:
    """Yield a temporary path to write to; its file replaces ``path`` when the block ends, or is removed after an error.

    Raise OSError if the disk refuses.
    """
    unfinished = path.with_name(f"{path.name}.{secrets.token_hex(4)}{SUFFIX}")
    try:
        yield unfinished
        with unfinished.open("rb+") as file:  # Windows flushes only what is open for writing
            os.fsync(file.fileno())
        unfinished.replace(path)
    except BaseException:
        # Removed even after an error, so that a full disk has room again.
        unfinished.unlink(missing_ok=True)
        raise


def is_leftover(path: Path) -> bool:
    """Return whether the file was being written when a process was killed; only for files that nobody writes now."""
    return path.name.endswith(SUFFIX)


def remove_leftovers(folder: Path) -> None:
    """Remove what killed processes left in a folder that nobody else writes to."""
    for path in folder.iterdir():
        if is_leftover(path):
            path.unlink(missing_ok=True)
