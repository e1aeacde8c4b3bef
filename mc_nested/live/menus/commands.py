"""The chat commands of a reset, in the syntax of the game's version (FACTS: Commands)."""

from collections.abc import Sequence

from mc_nested.arena.action import Cell
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.tables import Dialect, Profile

STACK = 64
"""Blocks of one material in the hotbar: the game's full stack."""


def reset_commands(profile: Profile, start: Cell, blocks: Sequence[str]) -> list[str]:
    """What to type before an episode: clear the marked blocks, mend the floor, teleport to ``start``, fill the hotbar.

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
    """Fill the marked blocks with air, and none outside."""
    low, high = arena.region
    return f"/fill {_words(low)} {_words(high)} minecraft:air"


def floor_commands(arena: Arena, dialect: Dialect) -> list[str]:
    """Fill the holes in the floor under the marked blocks; nothing where the profile doesn't say what the floor is.

    A click that brings the game to the front breaks a block in Creative mode (FACTS: Input and windows).
    """
    if arena.floor is None:
        return []
    (x, y, z), (other_x, _, other_z) = arena.region
    low, high = (x, y - 1, z), (other_x, y - 1, other_z)
    data = " 0" if dialect == "1.12" else ""
    # A mod's block is named with its namespace, as the debug screen shows it.
    block = arena.floor if ":" in arena.floor else f"minecraft:{arena.floor}"
    return [f"/fill {_words(low)} {_words(high)} {block}{data} keep"]


def teleport_command(arena: Arena, cell: Cell, pitch: float) -> str:
    """Stand in the middle of a cell and look the arena's way, ``pitch`` degrees down."""
    x, y, z = arena.centre_of(cell)
    # x and z keep their decimals, since the game moves whole numbers by half a block; y is taken as it is.
    return f"/tp @s {x:.1f} {y:.0f} {z:.1f} {arena.yaw:g} {pitch:g}"


def item_command(dialect: Dialect, slot: int, block: str) -> str:
    """Put a stack of a block into a hotbar slot; 0 is the leftmost."""
    if dialect == "1.12":
        return f"/replaceitem entity @s slot.hotbar.{slot} minecraft:{block} {STACK} 0"
    if dialect == "1.13":
        return f"/replaceitem entity @s hotbar.{slot} minecraft:{block} {STACK}"
    return f"/item replace entity @s hotbar.{slot} with minecraft:{block} {STACK}"


def _words(block: tuple[int, int, int]) -> str:
    return " ".join(str(part) for part in block)
