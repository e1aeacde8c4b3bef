"""The rules of the task: where a move leads, where a block lands, when an episode ends (docs/explanation/task.md).

Cells are (x, y): x to the right, y forward, the way the agent looks for the whole episode (paper, section 5).
``size`` is the number of cells along each side of the arena (Scenario.size).
"""

from collections.abc import Collection

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arrays import Bools

STEP: dict[Action, Cell] = {
    Action.F: (0, 1),
    Action.B: (0, -1),
    Action.L: (-1, 0),
    Action.R: (1, 0),
    Action.FD: (0, 1),
    Action.LD: (-1, 0),
    Action.RD: (1, 0),
    Action.BD: (0, -1),
}
"""The cells that each action's move covers, as (right, forward)."""

PLACES = frozenset({Action.FD, Action.LD, Action.RD, Action.BD})
"""The actions that place a block after their move."""

WITH_BLOCK = {Action.F: Action.FD, Action.B: Action.BD, Action.L: Action.LD, Action.R: Action.RD}
"""The action that makes the same move and then places a block."""


def is_inside(cell: Cell, size: int) -> bool:
    """Return whether the cell belongs to the arena."""
    return 0 <= cell[0] < size and 0 <= cell[1] < size


def front_of(cell: Cell) -> Cell:
    """Return the cell in front of the agent, inside the arena or not."""
    return cell[0], cell[1] + 1


def axis_of(action: Action) -> tuple[int, int]:
    """Return the axis of the action's move, 0 right or 1 forward, and its direction on it."""
    right, forward = STEP[action]
    return (0, right) if right else (1, forward)


def moved(cell: Cell, action: Action, placed: Collection[Cell], size: int) -> Cell:
    """Return the cell that the action's move leads to: the same cell if a block or the arena's edge stops it."""
    right, forward = STEP[action]
    ahead = (cell[0] + right, cell[1] + forward)
    return ahead if is_inside(ahead, size) and ahead not in placed else cell


def landing(cell: Cell, action: Action, placed: Collection[Cell], size: int) -> Cell | None:
    """Return where the action's block lands once the agent has moved to ``cell``; None if the rules void it."""
    front = front_of(cell)
    if action not in PLACES or not is_inside(front, size) or front in placed:
        return None
    return front


def end_of_episode(blocks_left: int, steps: int, step_limit: int) -> tuple[bool, bool]:
    """Return whether the episode has terminated, no block being left, and whether it is truncated at the step limit.

    sim/grid_step.py says the same, compiled.
    """
    terminated = blocks_left == 0
    return terminated, not terminated and steps >= step_limit


def grid_of(cells: Collection[Cell], size: int) -> Bools:
    """Return the cells as a grid (x, y), (size, size)."""
    grid = np.zeros((size, size), dtype=np.bool_)
    for cell in cells:
        grid[cell] = True
    return grid


def cells_of(grid: Bools) -> frozenset[Cell]:
    """Return the cells that a grid (x, y) marks."""
    return frozenset((int(x), int(y)) for x, y in np.argwhere(grid))
