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

CELLS: tuple[Cell, ...] = tuple((x, y) for y in (3, 8, 13) for x in (1, 4, 7, 10, 13))
"""Cells whose floor is looked at, spread over the arena."""

VIEW_S = 1.0
"""How long a new view may take to be seen."""

ANGLE_TOLERANCE_DEG = 0.2
"""How far the view may differ from what a command asked for: the debug screen shows tenths."""


@dataclass(frozen=True)
class LookAroundResult:
    """Blocks that stand in the arena's way, and how many of the looks saw the expected floor."""

    in_the_way: dict[Block, str]
    floor: int
    looks: int


def look_around(console: CommandConsole, arena: Arena) -> LookAroundResult:
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
    return LookAroundResult(in_the_way, floor, len(CELLS))


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
