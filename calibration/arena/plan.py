"""The commands that build an arena, as pure functions."""

from collections.abc import Sequence

from mc_nested.live.menus.reset import box_text, clear_command, fill_command, item_command
from mc_nested.live.model.reading import Block
from mc_nested.live.model.versions import version_numbers
from mc_nested.live.profile.arena import FLOOR, Arena, Box, border_block, border_of, box_of, floor_of
from mc_nested.live.profile.tables import Profile

BAD_FLOORS = (
    "ice",
    "slime",
    "soul_sand",
    "soul_soil",
    "honey",
    "sand",
    "gravel",
    "farmland",
    "path",
    "carpet",
    "leaves",
)
"""Parts of names of blocks that make no good floor: slippery, slow, lower than a whole block, falling or decaying."""

HEIGHTS = (64, 32, 16)
"""Blocks above the floor at which the copy may lie, out of the way and in the same chunks."""


def copy_positions(arena: Arena, version: str) -> list[Block]:
    """Return lowest corners where a copy of the box fits in the sky above it, below the world's top."""
    low, high = box_of(arena)
    top = 319 if version_numbers(version) >= (1, 18) else 255
    tall = high[1] - low[1] + 1
    return [(low[0], low[1] + up, low[2]) for up in HEIGHTS if low[1] + up + 2 * tall <= top]


def box_at(box: Box, corner: Block) -> Box:
    """Return the box moved so that its lowest corner is there."""
    low, high = box
    return corner, (corner[0] + high[0] - low[0], corner[1] + high[1] - low[1], corner[2] + high[2] - low[2])


def do_overlap(one: Box, other: Box) -> bool:
    """Return whether two boxes share a block."""
    return all(one[0][axis] <= other[1][axis] and other[0][axis] <= one[1][axis] for axis in range(3))


def is_good_floor(floor_id: str) -> bool:
    """Return whether a block, as the debug screen names it, makes a good floor."""
    return not any(part in floor_id for part in BAD_FLOORS)


def copy_command(box: Box, to: Block) -> str:
    """Copy a box to a new lowest corner."""
    return f"/clone {box_text(box)} {' '.join(map(str, to))}"


def build_commands(profile: Profile, arena: Arena, materials: Sequence[str], *, builds_floor: bool) -> list[str]:
    """Return commands for floor, air, border, game mode, mobs, time, weather, materials, in the version's syntax."""
    dialect = profile.game.dialect
    return [
        *([fill_command(floor_of(arena), FLOOR)] if builds_floor else []),
        clear_command(arena),
        *(fill_command(side, border_block(materials)) for side in border_of(arena)),
        "/gamemode creative",
        "/difficulty peaceful",
        "/time set 6000",
        "/weather clear",
        *(f"/gamerule {rule} false" for rule in gamerules(profile.game.version)),
        *(item_command(dialect, slot, profile.block_name(block)) for slot, block in enumerate(materials)),
    ]


def gamerules(version: str) -> tuple[str, ...]:
    """Return the gamerules for time, weather and mobs, by their names in that version."""
    if version_numbers(version) >= (1, 21, 11):
        return "advance_time", "advance_weather", "spawn_mobs"
    return "doDaylightCycle", "doWeatherCycle", "doMobSpawning"


def volume(box: Box) -> int:
    """Return how many blocks a box has."""
    low, high = box
    return (high[0] - low[0] + 1) * (high[1] - low[1] + 1) * (high[2] - low[2] + 1)
