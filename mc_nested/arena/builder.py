"""The scripted builder: the upper limit in every plot. It shows that every design's optimum can be reached.

It builds the farthest row first, and each row from its nearer end. So all nearer rows are still free, nothing is ever
in the way, and no state (x, y, b) repeats between two blocks.

In a design in parts, what was built first may stand in the way of what comes later. The order is found backwards, from
the whole design: a block can have been the last one if the agent can get from the cell before it to where it goes next.
Taking a block away never closes a way. So it doesn't matter which block is taken away first: if there is an order, one
is found, and a design for which none is found can't be built.
"""

from collections import deque
from collections.abc import Collection
from dataclasses import replace
from itertools import groupby

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import PLACES, WITH_BLOCK, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import ScenarioError


def out_of_reach(scenario: Scenario) -> frozenset[Cell]:
    """Return the cells of the design where no block can land: the agent can't get to the cell before them."""
    stands: set[Cell] = set()
    _spread(stands, scenario.start, (), scenario.size)
    return frozenset(cell for cell in scenario.design if _before(cell) not in stands)


def within_reach(scenario: Scenario) -> Scenario:
    """Return the scenario without the cells that are out of reach, and without parts of which nothing is left."""
    design = scenario.design - out_of_reach(scenario)
    parts = [replace(part, cells=part.cells & design) for part in scenario.parts]
    return replace(scenario, design=design, parts=tuple(part for part in parts if part.cells))


def order_of_parts(scenario: Scenario) -> list[Cell] | None:
    """Return the cells in an order in which the parts can be built; None if there is none."""
    free = {(x, y) for x in range(scenario.size) for y in range(scenario.size)} - scenario.design
    while free:
        stands: set[Cell] = set()
        _spread(stands, min(free), scenario.design, scenario.size)
        free -= stands
        order = _ending_among(stands, scenario)
        if order is not None:
            return order
    return None


def _ending_among(stands: set[Cell], scenario: Scenario) -> list[Cell] | None:
    """Return an order after which the agent stands in one of these connected cells; None if there is none.

    ``stands`` grows to all the cells that it could have been in before.
    """
    backwards: list[Cell] = []
    placed = set(scenario.design)
    for part in reversed(scenario.in_order):
        left = set(part.cells)
        while left:
            last = [cell for cell in left if _before(cell) in stands]
            if not last:
                return None
            # The nearest row goes up last, and its blocks beside one another.
            beside = (backwards[-1] if backwards else min(last))[0]
            chosen = min(last, key=lambda cell: (cell[1], abs(cell[0] - beside), cell[0]))
            backwards.append(chosen)
            left.remove(chosen)
            placed.remove(chosen)
            _spread(stands, chosen, placed, scenario.size)
    return backwards[::-1]


def _before(target: Cell) -> Cell:
    """Return where the agent stands to place a block there."""
    return target[0], target[1] - 1


def _spread(reached: set[Cell], cell: Cell, placed: Collection[Cell], size: int) -> None:
    """Add a cell to those that are reached, and all that can be reached from it past these blocks."""
    reached.add(cell)
    waiting = deque([cell])
    while waiting:
        here = waiting.popleft()
        for action in WITH_BLOCK:
            there = moved(here, action, placed, size)
            if there not in reached:
                reached.add(there)
                waiting.append(there)


def way_to(start: Cell, goal: Cell, placed: Collection[Cell], size: int) -> list[Action]:
    """Return the fewest moves that end there, one at least: a block is only placed after a move."""
    waiting: deque[tuple[Cell, list[Action]]] = deque([(start, [])])
    seen: set[Cell] = set()
    while waiting:
        here, path = waiting.popleft()
        for action in WITH_BLOCK:
            there = moved(here, action, placed, size)
            if there == goal:
                return [*path, action]
            if there not in seen:
                seen.add(there)
                waiting.append((there, [*path, action]))
    raise ScenarioError(f"cell {goal} can't be reached from {start}: change the order of the parts")


def build(scenario: Scenario) -> list[Action]:
    """Return the actions that place every block of the design, part after part, from the start cell.

    ScenarioError if the parts can't be built in their order.
    """
    order = order_of_parts(scenario) if scenario.parts else _order(scenario)
    if order is None:
        raise ScenarioError(f"scenario {scenario.name}: its parts can't be built in their order: change it")
    actions: list[Action] = []
    placed: set[Cell] = set()
    cell = scenario.start
    for target in order:
        stand = _before(target)
        if scenario.parts:
            path = way_to(cell, stand, placed, scenario.size)
        else:  # nothing is ever in the way
            path = _walk(cell, stand) or _step_aside(cell, scenario.size)
        actions += [*path[:-1], WITH_BLOCK[path[-1]]]
        placed.add(target)
        cell = stand
    return actions


def build_with_materials(scenario: Scenario, material: int | None = None) -> list[tuple[Action, int]]:
    """Return ``build``'s actions, each with its material in hand: the named one, or the one worth most in the part."""
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
    """Return the moves away and back: the agent is in the right cell, but a block is only placed after a move."""
    there_and_back = ((Action.B, Action.F), (Action.L, Action.R), (Action.R, Action.L))
    return next([there, back] for there, back in there_and_back if moved(cell, there, (), size) != cell)
