"""Restoring a world from a copy of its folder, for games without cheats: only a world that carries the marker.

template --copy--> a folder beside the saves --verified, byte for byte--> renamed to be the world; the world that was
there is renamed away and kept until the next time
"""

import filecmp
import shutil
from pathlib import Path

from mc_nested.errors import RunError

MARKER = "mc-nested-arena.txt"
"""The file that a world's folder must hold to be restored: who puts it there says that the world may be replaced."""

KEPT = "mc-nested-worlds"
"""The folder in the game's own, not among the saves, that holds the copy being made and the last world."""


def restore_world(world: Path, template: Path) -> None:
    """Make ``world``, a folder in the game's saves, the same as ``template``. The game must have left the world.

    Raises:
        RunError: one of them is no folder with the marker, or the disk refuses; the world is as it was then.
    """
    for folder in (world, template):
        if folder.is_symlink() or not (folder / MARKER).is_file():
            raise RunError(
                f"{folder}: has no {MARKER}, so it is never replaced: put that file into a world of its own for this"
            )
    if world.resolve() == template.resolve() or world.resolve() in template.resolve().parents:
        raise RunError(f"{template}: is the world itself, or in it: copy the world to another place first")
    kept = world.parent.parent / KEPT
    new, last = kept / f"{world.name}.new", kept / f"{world.name}.last"
    try:
        shutil.rmtree(new, ignore_errors=True)
        kept.mkdir(exist_ok=True)
        shutil.copytree(template, new)
        _check_same(template, new)
        shutil.rmtree(last, ignore_errors=True)
        world.rename(last)
        try:
            new.rename(world)
        except OSError:
            last.rename(world)
            raise
    except (OSError, shutil.Error) as error:
        raise RunError(f"{world}: can't be restored ({error}): leave the world in the game, and make room") from error


def _check_same(one: Path, other: Path) -> None:
    """OSError where two folders differ in any file."""
    files = [sorted(path.relative_to(root) for path in root.rglob("*") if path.is_file()) for root in (one, other)]
    if files[0] != files[1]:
        raise OSError("the copy lacks files")
    differ = [name for name in files[0] if not filecmp.cmp(one / name, other / name, shallow=False)]
    if differ:
        raise OSError(f"the copy of {differ[0]} differs")
