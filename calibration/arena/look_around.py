"""Looks at the arena's floor from one position in it, to see what stands in the way."""

import math
from dataclasses import dataclass

from calibration.command_console import CommandConsole
from mc_nested.arena.action import Cell
from mc_nested.live.model.coordinates import turn_between
from mc_nested.live.model.reading import Block, Reading, Target
from mc_nested.live.profile.arena import Arena

EYE_HEIGHT = 1.62
"""Blocks from the feet to the eyes (FACTS: Standing, looking, placing)."""

SIGHT = 19.5
"""Blocks from the eyes to the farthest floor that is looked at (FACTS: The F3 debug screen)."""

ACROSS, ALONG = (1, 4, 7, 10, 13), (3, 8, 13)
"""Where the cells lie whose floor is looked at, in fifteenths of the arena's size, spread over it."""

VIEW_S = 1.0
"""How long a new view may take to be seen."""

ANGLE_TOLERANCE_DEG = 0.2
"""How far the view may differ from what a command asked for: the debug screen shows tenths."""


@dataclass(frozen=True)
class LookAroundResult:
    """Blocks that stand in the arena's way, and how many of the looks saw the expected floor.

    ``out_of_sight`` cells were too far away to be looked at.
    """

    in_the_way: dict[Block, str]
    floor: int
    looks: int
    out_of_sight: int = 0


def cells_to_look_at(size: int) -> list[Cell]:
    """Cells spread over an arena."""
    return [(size * x // 15, size * y // 15) for y in ALONG for x in ACROSS]


def is_in_sight(cell: Cell, standing: Cell) -> bool:
    """Whether a cell's floor can be seen from ``standing``: in an arena of 15 cells a side, each can from anywhere."""
    return math.hypot(math.dist(cell, standing), EYE_HEIGHT) <= SIGHT


def look_around(console: CommandConsole, arena: Arena, standing: Cell) -> LookAroundResult:
    """Look at the floor of some cells; the player's feet stay where they are, on the cell ``standing``."""
    in_the_way: dict[Block, str] = {}
    floor = 0
    spread = cells_to_look_at(arena.size)
    cells = [cell for cell in spread if is_in_sight(cell, standing)]
    for cell in cells:
        x, y, z = arena.block_of(cell)
        target = look_at(console, (x + 0.5, float(y), z + 0.5))
        if target is None or target.pos is None:
            continue
        if target.pos == (x, y - 1, z):
            floor += 1
        elif target.pos[1] >= y:
            in_the_way[target.pos] = target.id or "a block"
    return LookAroundResult(in_the_way, floor, len(cells), len(spread) - len(cells))


def look_at(console: CommandConsole, point: tuple[float, float, float]) -> Target | None:
    """Turn the view to a point and return the block that is seen there, or None."""
    feet = console.read().xyz or point
    east, down, south = point[0] - feet[0], feet[1] + EYE_HEIGHT - point[1], point[2] - feet[2]
    yaw, pitch = math.degrees(math.atan2(-east, south)), math.degrees(math.atan2(down, math.hypot(east, south)))
    return teleport_and_look(console, f"~ ~ ~ {yaw:.1f} {pitch:.1f}", yaw, pitch)


def teleport_and_look(console: CommandConsole, pose: str, yaw: float, pitch: float) -> Target | None:
    """Teleport to ``pose``, which includes the view, and return the block that is seen from there, or None."""
    console.send(f"/tp @s {pose}")

    def is_there(reading: Reading) -> bool:
        return (
            reading.yaw is not None
            and reading.pitch is not None
            and turn_between(reading.yaw, yaw) <= ANGLE_TOLERANCE_DEG
            and abs(reading.pitch - pitch) <= ANGLE_TOLERANCE_DEG
        )

    reading = console.watch(is_there, VIEW_S)
    return reading.target if reading else None
