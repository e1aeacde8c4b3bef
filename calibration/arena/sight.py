"""Looking around an arena from one place in it: what is seen where its floor should be."""

import math
from dataclasses import dataclass

from calibration.console import Console
from mc_nested.arena.rules import Cell
from mc_nested.live.coordinates import turn_between
from mc_nested.live.profile_tables import Arena
from mc_nested.live.reading import Block, Reading, Target

EYES = 1.62
"""Blocks from the feet to the eyes (FACTS: Standing, looking, placing)."""

CELLS: tuple[Cell, ...] = tuple((x, y) for y in (3, 8, 13) for x in (1, 4, 7, 10, 13))
"""Cells whose floor is looked at: spread over the arena."""

SEEN_S = 1.0
"""How long a view may take to be seen."""

TURNED = 0.2
"""Degrees that a view may be off what a command asked for: the debug screen shows tenths."""


@dataclass(frozen=True)
class Sights:
    """What was seen: blocks that stand in the arena's way, and how many of the looks saw the floor that they should."""

    in_the_way: dict[Block, str]
    floor: int
    looks: int


def look_around(console: Console, arena: Arena) -> Sights:
    """Look at the floor of some cells; the player's feet stay where they are."""
    in_the_way: dict[Block, str] = {}
    floor = 0
    for cell in CELLS:
        x, y, z = arena.block_of(cell)
        target = look_at(console, (x + 0.5, float(y), z + 0.5))
        if target is None or target.pos is None:
            continue
        if target.pos == (x, y - 1, z):
            floor += 1
        elif target.pos[1] >= y:
            in_the_way[target.pos] = target.id or "a block"
    return Sights(in_the_way, floor, len(CELLS))


def look_at(console: Console, point: tuple[float, float, float]) -> Target | None:
    """Turn the view to a point, and say which block is seen there; None where none is, or none is shown."""
    feet = console.read().xyz or point
    east, down, south = point[0] - feet[0], feet[1] + EYES - point[1], point[2] - feet[2]
    yaw, pitch = math.degrees(math.atan2(-east, south)), math.degrees(math.atan2(down, math.hypot(east, south)))
    return turned(console, f"~ ~ ~ {yaw:.1f} {pitch:.1f}", yaw, pitch)


def turned(console: Console, where: str, yaw: float, pitch: float) -> Target | None:
    """Teleport to ``where``, a view included, and say which block is seen once the view is there; None without one."""
    console.send(f"/tp @s {where}")

    def is_there(reading: Reading) -> bool:
        return (
            reading.yaw is not None
            and reading.pitch is not None
            and turn_between(reading.yaw, yaw) <= TURNED
            and abs(reading.pitch - pitch) <= TURNED
        )

    reading = console.watch(is_there, SEEN_S)
    return reading.target if reading else None
