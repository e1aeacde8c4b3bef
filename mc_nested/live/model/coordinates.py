"""Between the arena's cells and the world's blocks, and the positions from which a click lands in front of a cell.

Cells are (x, y): x to the right, y forward, as the agent faces. In the world east is +X and south is +Z; yaw 0 is
south, 90 west, 180 north, -90 east (FACTS: The F3 debug screen).
"""

import math
from typing import Literal, NamedTuple

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import is_inside
from mc_nested.live.model.reading import XYZ, Block, WorldPose

Facing = Literal["north", "south", "west", "east"]

_FORWARD: dict[Facing, tuple[int, int]] = {"north": (0, -1), "south": (0, 1), "west": (-1, 0), "east": (1, 0)}
_YAW: dict[Facing, float] = {"south": 0.0, "west": 90.0, "north": 180.0, "east": -90.0}


class GroundVector(NamedTuple):
    """A position, an offset or a velocity on the ground, in blocks, as the agent faces."""

    right: float
    forward: float

    def minus(self, other: "GroundVector") -> "GroundVector":
        """Return the vector from ``other`` to here."""
        return GroundVector(self.right - other.right, self.forward - other.forward)


def yaw_of(facing: Facing) -> float:
    """Return the yaw, in degrees, of an agent that faces that way."""
    return _YAW[facing]


def facing_of(yaw: float) -> Facing:
    """Return the nearest of the four ways to face for a yaw in degrees, of any number of turns."""
    quarters: list[Facing] = ["south", "west", "north", "east"]
    return quarters[round(yaw / 90.0) % 4]


def turn_between(yaw: float, other: float) -> float:
    """Return the unsigned angle between two yaws, 0 to 180 degrees."""
    return abs((yaw - other + 180.0) % 360.0 - 180.0)


def block_of(origin: Block, facing: Facing, cell: Cell) -> Block:
    """Return the block that fills ``cell``; ``origin`` is the block of cell (0, 0), at the level of the feet."""
    forward_x, forward_z = _FORWARD[facing]
    right_x, right_z = -forward_z, forward_x
    x, y = cell
    return origin[0] + right_x * x + forward_x * y, origin[1], origin[2] + right_z * x + forward_z * y


def corners_of(one: Block, other: Block) -> tuple[Block, Block]:
    """Return the lowest and the highest corner of the box that two of its corners span, both included."""
    (x, y, z), (other_x, other_y, other_z) = one, other
    return (min(x, other_x), min(y, other_y), min(z, other_z)), (max(x, other_x), max(y, other_y), max(z, other_z))


def centre_of(origin: Block, facing: Facing, cell: Cell) -> tuple[float, float, float]:
    """Return the world position of the feet of an agent in the middle of ``cell``, in blocks."""
    x, y, z = block_of(origin, facing, cell)
    return x + 0.5, float(y), z + 0.5


def position_of(origin: Block, facing: Facing, xyz: tuple[float, float, float]) -> GroundVector:
    """Return the world position ``xyz`` in cells: the middle of cell (x, y) is at exactly (x, y)."""
    forward_x, forward_z = _FORWARD[facing]
    right_x, right_z = -forward_z, forward_x
    east, south = xyz[0] - origin[0] - 0.5, xyz[2] - origin[2] - 0.5
    return GroundVector(east * right_x + south * right_z, east * forward_x + south * forward_z)


def offset_from(pose: WorldPose, xyz: XYZ) -> GroundVector:
    """Return the position ``xyz`` as seen from a pose. Yaw 0 is south, 90 west (FACTS: Standing, looking, placing)."""
    sine, cosine = math.sin(math.radians(pose.yaw)), math.cos(math.radians(pose.yaw))
    east, south = xyz[0] - pose.xyz[0], xyz[2] - pose.xyz[2]
    return GroundVector(-east * cosine - south * sine, -east * sine + south * cosine)


def cell_at(position: tuple[float, float]) -> Cell:
    """Return the cell that holds a position given in cells."""
    return math.floor(position[0] + 0.5), math.floor(position[1] + 0.5)


EYES = 1.62
"""Blocks from the feet to the eyes (FACTS: Standing, looking, placing)."""

COASTING_CLICK = 0.19
"""Blocks off the middle from which a click is right, if the agent comes to a stop within the tolerance. From 0.2 on the
game refuses a block (FACTS: Standing, looking, placing). At 65 degrees the next cell's floor is hit from there."""

BESIDE, BEHIND = 0.4, 0.2
"""Blocks off the middle, to a side and back, from which the same floor is hit: at 65 degrees it is hit from up to 0.5
and 0.25 (FACTS: Standing, looking, placing)."""

STRAY_CELLS = 2
"""Cells that a late release may carry an agent too far: an early click is only right if they are in the arena."""


def is_near(position: GroundVector, cell: Cell, tolerance: float) -> bool:
    """Return whether a position is at most ``tolerance`` blocks off a cell's middle, on each axis."""
    return max(abs(cell[0] - position.right), abs(cell[1] - position.forward)) <= tolerance


def hits_floor(position: GroundVector, cell: Cell) -> bool:
    """Return whether a click from there lands on the floor in front of a cell, and the game does not refuse it."""
    right, forward = position.right - cell[0], position.forward - cell[1]
    return abs(right) <= BESIDE and -BEHIND <= forward <= COASTING_CLICK


def is_click_right(position: GroundVector, end_if_late: GroundVector, cell: Cell, size: int) -> bool:
    """Return whether a click is right from a position and from everywhere that one tick more may carry the agent.

    ``size`` is the arena's: what stands beyond its edge isn't known.
    """
    way = end_if_late.right - position.right, end_if_late.forward - position.forward
    axis = 1 if abs(way[1]) >= abs(way[0]) else 0
    beyond = list(cell)
    beyond[axis] += STRAY_CELLS if way[axis] > 0 else -STRAY_CELLS
    return is_inside((beyond[0], beyond[1]), size) and hits_floor(position, cell) and hits_floor(end_if_late, cell)
