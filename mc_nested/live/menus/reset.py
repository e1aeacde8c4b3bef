"""Restore an arena at a reset: by chat commands, or, in games without cheats, from a copy of the world's folder.

The commands are in the syntax of the game's version (FACTS: Commands). Only a world with the marker is restored:

template --copy--> a folder beside the saves --verified, byte for byte--> renamed to be the world; the old world is
renamed away and kept until the next time
"""

import filecmp
import shutil
from collections.abc import Sequence
from pathlib import Path

from mc_nested.arena.action import Cell
from mc_nested.errors import RunError
from mc_nested.live.profile.arena import Arena, Box
from mc_nested.live.profile.tables import Dialect, Profile

STACK = 64
"""Blocks of one material in the hotbar: the game's full stack."""


def reset_commands(profile: Profile, start: Cell, blocks: Sequence[str]) -> list[str]:
    """Return what to type before an episode: clear the marked blocks, mend the floor, go to ``start``, fill the hotbar.

    ``blocks`` are the scenario's block names, one for each hotbar slot from the left. ProfileError without an arena.
    """
    arena = profile.marked_arena()
    return [
        clear_command(arena),
        *floor_commands(arena, profile.game.dialect),
        teleport_command(arena, start, profile.body.pitch),
        *(item_command(profile.game.dialect, slot, profile.block_name(block)) for slot, block in enumerate(blocks)),
    ]


def clear_command(arena: Arena) -> str:
    """Return the command that fills the marked blocks with air, and none outside."""
    return fill_command(arena.region, "air")


def fill_command(box: Box, block: str) -> str:
    """Return the command that fills a box."""
    return f"/fill {box_text(box)} minecraft:{block}"


def floor_commands(arena: Arena, dialect: Dialect) -> list[str]:
    """Return commands that fill holes in the floor under the marked blocks.

    Return none where the profile doesn't name the floor.

    A click that brings the game to the front breaks a block in Creative mode (FACTS: Input and windows).
    """
    if arena.floor is None:
        return []
    (x, y, z), (other_x, _, other_z) = arena.region
    floor = (x, y - 1, z), (other_x, y - 1, other_z)
    data = " 0" if dialect == "1.12" else ""
    # A mod's block is named with its namespace, as the debug screen shows it.
    block = arena.floor if ":" in arena.floor else f"minecraft:{arena.floor}"
    return [f"/fill {box_text(floor)} {block}{data} keep"]


def teleport_command(arena: Arena, cell: Cell, pitch: float) -> str:
    """Return the command to stand in the middle of a cell and look the arena's way, ``pitch`` degrees down."""
    x, y, z = arena.centre_of(cell)
    # x and z keep their decimals, since the game moves whole numbers by half a block; y is taken as it is.
    return f"/tp @s {x:.1f} {y:.0f} {z:.1f} {arena.yaw:g} {pitch:g}"


def item_command(dialect: Dialect, slot: int, block: str) -> str:
    """Return the command that puts a stack of a block into a hotbar slot; 0 is the leftmost."""
    if dialect == "1.12":
        return f"/replaceitem entity @s slot.hotbar.{slot} minecraft:{block} {STACK} 0"
    if dialect == "1.13":
        return f"/replaceitem entity @s hotbar.{slot} minecraft:{block} {STACK}"
    return f"/item replace entity @s hotbar.{slot} with minecraft:{block} {STACK}"


def box_text(box: Box) -> str:
    """Return a box as commands write it."""
    return " ".join(str(part) for corner in box for part in corner)


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
    """Raise OSError if two folders differ in any file."""
    names = _file_names(original)
    if names != _file_names(copy):
        raise OSError("the copy lacks files")
    differing = [name for name in names if not filecmp.cmp(original / name, copy / name, shallow=False)]
    if differing:
        raise OSError(f"the copy of {differing[0]} differs")


def _file_names(folder: Path) -> list[Path]:
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
