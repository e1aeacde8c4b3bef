"""A job's files between two machines: what it goes on from is sent to the worker, its outcome or last save back."""

import shutil
from collections.abc import Mapping
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.studies.outcome import OUTCOME

Files = Mapping[str, bytes]
"""Contents by path, relative to a folder, with slashes."""

CHECKPOINT = "checkpoint"


def files_below(folder: Path) -> Files:
    """Return the folder's files; none where there is no such folder."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != LOCK)
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in paths}


def write_below(folder: Path, files: Files) -> None:
    """Write the files into the folder; OSError if the disk refuses."""
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(path) as unfinished:
            unfinished.write_bytes(content)


def land(folder: Path, files: Files) -> None:
    """Put what came back of a job into its folder, in place of the checkpoint there; OSError if the disk refuses.

    Whenever the process is killed, the folder holds the old checkpoint, the new one or the outcome, each whole, or
    nothing, so that the job begins anew.
    """
    current, new, old = folder / CHECKPOINT, folder / f"{CHECKPOINT}.new", folder / f"{CHECKPOINT}.old"
    for leftover in (new, old):
        shutil.rmtree(leftover, ignore_errors=True)
    inside = f"{CHECKPOINT}/"
    saved = {name.removeprefix(inside): each for name, each in files.items() if name.startswith(inside)}
    write_below(new, saved)
    write_below(folder, {name: each for name, each in files.items() if name == OUTCOME})
    if current.exists():
        current.rename(old)
    if saved:
        new.rename(current)
    shutil.rmtree(old, ignore_errors=True)
