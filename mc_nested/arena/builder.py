"""The scripted builder: the upper limit in every plot. It shows that every design's optimum can be reached.

It builds the farthest row first, and each row from its nearer end. So all nearer rows are still free, nothing is ever
in the way, and no state (x, y, b) repeats between two blocks. A design in parts is built by part_builder.py.
"""

from itertools import groupby

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.part_builder import build_in_parts
from mc_nested.arena.rules import PLACES, STEP, WITH_BLOCK, is_inside
from mc_nested.arena.scenario import Scenario


def build(scenario: Scenario) -> list[Action]:
    """The actions that place every block of the design, part after part, from the start cell.

    ScenarioError if the parts can't be built in their order.
    """
    if scenario.parts:
        return build_in_parts(scenario)
    actions: list[Action] = []
    cell = scenario.start
    for target in _order(scenario):
        stand = (target[0], target[1] - 1)
        path = _walk(cell, stand) or _step_aside(cell, scenario.size)
        actions += [*path[:-1], WITH_BLOCK[path[-1]]]
        cell = stand
    return actions


def build_with_materials(scenario: Scenario, material: int | None = None) -> list[tuple[Action, int]]:
    """The same actions, each with the material in hand: the one named, or the one that is worth most in the part."""
    steps, left = [], scenario.blocks
    for action in build(scenario):
        best = scenario.best_materials[scenario.part_at(left)]
        steps.append((action, best if material is None else material))
        left -= action in PLACES
    return steps


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
