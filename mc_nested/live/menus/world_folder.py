"""Restoring a world from a copy of its folder, for games without cheats. Only a world with the marker is restored.

template --copy--> a folder beside the saves --verified, byte for byte--> renamed to be the world; the old world is
renamed away and kept until the next time
"""

import filecmp
import shutil
from pathlib import Path

from mc_nested.errors import RunError

MARKER = "mc-nested-arena.txt"
"""The file that a world's folder must hold to be restored: it says that the world may be replaced."""

KEPT = "mc-nested-worlds"
"""The folder in the game's own, not among the saves, for the copy being made and the last world."""


def restore_world(world: Path, template: Path) -> None:
    """Make ``world``, a folder in the game's saves, the same as ``template``. The game must have left the world.

    Raises:
        RunError: one of them is no folder with the marker, or the disk fails. The world is unchanged then.
    """
    for folder in (world, template):
        if folder.is_symlink() or not (folder / MARKER).is_file():
            raise RunError(
                f"{folder}: has no {MARKER}, so it is never replaced: put that file into a world of its own for this"
            )
    if world.resolve() == template.resolve() or world.resolve() in template.resolve().parents:
        raise RunError(f"{template}: is the world itself, or in it: copy the world to another place first")
    kept = world.parent.parent / KEPT
    copy, last = kept / f"{world.name}.new", kept / f"{world.name}.last"
    try:
        shutil.rmtree(copy, ignore_errors=True)
        kept.mkdir(exist_ok=True)
        shutil.copytree(template, copy)
        _check_same(template, copy)
        shutil.rmtree(last, ignore_errors=True)
        world.rename(last)
        try:
            copy.rename(world)
        except OSError:
            last.rename(world)
            raise
    except (OSError, shutil.Error) as error:
        raise RunError(f"{world}: can't be restored ({error}): leave the world in the game, and make room") from error


def _check_same(original: Path, copy: Path) -> None:
    """OSError if two folders differ in any file."""
    names = _file_names(original)
    if names != _file_names(copy):
        raise OSError("the copy lacks files")
    differing = [name for name in names if not filecmp.cmp(original / name, copy / name, shallow=False)]
    if differing:
        raise OSError(f"the copy of {differing[0]} differs")


def _file_names(folder: Path) -> list[Path]:
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
