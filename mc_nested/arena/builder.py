"""The scripted builder: the upper limit in every plot. It shows that every design's optimum can be reached.

It builds the farthest row first, and each row from its nearer end. So all nearer rows are still free, nothing is ever
in the way, and no state (x, y, b) repeats between two blocks.
"""

from itertools import groupby

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import STEP, is_inside
from mc_nested.arena.scenario import Scenario

WITH_BLOCK = {Action.F: Action.FD, Action.B: Action.BD, Action.L: Action.LD, Action.R: Action.RD}
"""The action that makes the same move and then places a block."""


def build(scenario: Scenario) -> list[Action]:
    """The actions that place every block of the design, from the start cell."""
    actions: list[Action] = []
    cell = scenario.start
    for target in _order(scenario):
        stand = (target[0], target[1] - 1)
        path = _walk(cell, stand) or _step_aside(cell, scenario.size)
        actions += [*path[:-1], WITH_BLOCK[path[-1]]]
        cell = stand
    return actions


def _order(scenario: Scenario) -> list[Cell]:
    order: list[Cell] = []
    x = scenario.start[0]
    farthest_first = sorted(scenario.design, key=lambda cell: (-cell[1], cell[0]))
    for _, cells in groupby(farthest_first, key=lambda cell: cell[1]):
        row = list(cells)
        if abs(row[-1][0] - x) < abs(row[0][0] - x):
            row.reverse()
        order += row
        x = row[-1][0]
    return order


def _walk(start: Cell, goal: Cell) -> list[Action]:
    across, along = goal[0] - start[0], goal[1] - start[1]
    return [Action.F if along > 0 else Action.B] * abs(along) + [Action.R if across > 0 else Action.L] * abs(across)


def _step_aside(cell: Cell, size: int) -> list[Action]:
    """Away and back: the agent is in the right cell, but every action that places a block begins with a move."""
    there_and_back = ((Action.B, Action.F), (Action.L, Action.R), (Action.R, Action.L))
    return next(
        [there, back]
        for there, back in there_and_back
        if is_inside((cell[0] + STEP[there][0], cell[1] + STEP[there][1]), size)
    )
