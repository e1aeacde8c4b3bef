"""The folder that a verb writes a new run or experiment to: the one that was named, or a new one under runs/."""

import contextlib
import datetime
import itertools
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mc_nested.cli.completion import RUNS
from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_kind import check_free
from mc_nested.learn.runs.folder_lock import folder_lock

LONGEST_NAME = 50
"""Characters of a folder's name before its date: no system refuses it then, whatever the letters."""


@contextmanager
def output_folder(out: Path | None, name: str, now: datetime.datetime | None = None) -> Iterator[Path]:
    """Yield the folder ``out``, or runs/NAME-DATE, held for the block by this process alone.

    It is made, and removed again where the block writes nothing there. Raise RunError if it holds anything already, is
    held by another process, or can't be made.
    """
    if out is None:
        made = _missing(RUNS)
        path = _reserved(name, now or datetime.datetime.now())
        made.insert(0, path)
    else:
        check_free(out)
        made, path = _missing(out), out
    try:
        with folder_lock(path):
            yield path
    finally:
        for folder in made:
            with contextlib.suppress(OSError):  # it isn't empty
                folder.rmdir()


def _missing(path: Path) -> list[Path]:
    """Return which of a folder and those around it aren't there yet, the innermost first."""
    return list(itertools.takewhile(lambda folder: not folder.exists(), (path, *path.parents)))


def _reserved(name: str, now: datetime.datetime) -> Path:
    """Make a new empty folder under runs/ that no other process has, even one that began in the same second."""
    safe = re.sub(r"[^\w.-]+", "-", name).strip("-.")[:LONGEST_NAME]
    dated = f"{safe or 'run'}-{now:%Y-%m-%d-%H%M%S}"
    names = (dated if number == 1 else f"{dated}-{number}" for number in itertools.count(1))
    return next(filter(_is_made, map(RUNS.joinpath, names)))


def _is_made(path: Path) -> bool:
    """Make a folder; return False if there is something of that name, raise RunError if it can't be made."""
    try:
        path.mkdir(parents=True)
    except OSError as error:
        if path.exists():
            return False
        raise RunError(f"{path}: can't be made, {error.strerror}: name a new folder with --out DIR") from error
    return True
