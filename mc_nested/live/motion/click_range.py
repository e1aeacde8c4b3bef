"""Pure rules for the positions from which a click lands on the floor in front of a cell."""

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import is_inside
from mc_nested.live.model.coordinates import GroundVector

COASTING_CLICK = 0.19
"""Blocks off the middle from which a click is right, if the agent comes to a stop within the tolerance. From 0.2 on the
game refuses a block (FACTS: Standing, looking, placing). At 65 degrees the next cell's floor is hit from there."""

BESIDE, BEHIND = 0.4, 0.2
"""Blocks off the middle, to a side and back, from which the same floor is hit: at 65 degrees it is hit from up to 0.5
and 0.25 (FACTS: Standing, looking, placing)."""

STRAY_CELLS = 2
"""Cells that a late release may carry an agent too far: an early click is only right if they are in the arena."""


def is_near(position: GroundVector, cell: Cell, tolerance: float) -> bool:
    """Whether a position is at most ``tolerance`` blocks off a cell's middle, on each axis."""
    return max(abs(cell[0] - position.right), abs(cell[1] - position.forward)) <= tolerance


def hits_floor(position: GroundVector, cell: Cell) -> bool:
    """Whether a click from there lands on the floor in front of a cell, and the game does not refuse it."""
    right, forward = position.right - cell[0], position.forward - cell[1]
    return abs(right) <= BESIDE and -BEHIND <= forward <= COASTING_CLICK


def is_click_right(position: GroundVector, end_if_late: GroundVector, cell: Cell, size: int) -> bool:
    """Whether a click is right from a position and from everywhere up to where one tick more would carry the agent.

    ``size`` is the arena's: what stands beyond its edge isn't known.
    """
    way = end_if_late.right - position.right, end_if_late.forward - position.forward
    axis = 1 if abs(way[1]) >= abs(way[0]) else 0
    beyond = list(cell)
    beyond[axis] += STRAY_CELLS if way[axis] > 0 else -STRAY_CELLS
    return is_inside((beyond[0], beyond[1]), size) and hits_floor(position, cell) and hits_floor(end_if_late, cell)
