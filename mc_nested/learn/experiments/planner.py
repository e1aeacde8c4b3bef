"""A script that explores and builds from a learnt map, without any network: what learning is compared with.

It takes the moves and where a block lands as known (arena/rules.py). Of the design it knows what its own placings came
to. While cells are to be found it goes where the chance of one a step is best; it builds by the scripted builder.
"""

from collections import deque
from collections.abc import Collection, Mapping
from dataclasses import replace

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.rules import STEP, WITH_BLOCK, front_of, is_inside, moved
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.imagination.beliefs import Belief, Beliefs

BESIDE_ONE, BESIDE_MORE = 0.35, 0.3
"""The chance that an unknown cell pays that lies beside one paying cell, where designs go on, or beside more."""


def plan_of_build(scenario: Scenario, beliefs: Beliefs) -> list[Action]:
    """The actions that build the cells known to pay; of the scenario, its start and size alone are looked at."""
    known = frozenset((int(x), int(y)) for x, y in np.argwhere(beliefs.cells == Belief.PAYS))
    return build(replace(scenario, design=known))


def next_test(
    cell: Cell, placed: Collection[Cell], steps_left: int, beliefs: Beliefs, blocks: int, random: np.random.Generator
) -> list[Action]:
    """The actions that place a block where the chance a step is best that it pays; none if no unknown cell is left.

    ``cell`` is where the agent stands, ``placed`` where blocks do. Ties are broken at random.
    """
    size = len(beliefs.cells)
    ways = _ways(cell, placed, size)
    best: tuple[float, float] | None = None
    plan: list[Action] = []
    for stand, way in ways.items():
        target = front_of(stand)
        if not is_inside(target, size) or target in placed or beliefs.cells[target] in (Belief.PAYS, Belief.PAYS_NOT):
            continue
        if len(way) <= steps_left:
            rank = _chance(target, beliefs, blocks) / len(way), float(random.random())
            if best is None or rank > best:
                best, plan = rank, [*way[:-1], WITH_BLOCK[way[-1]]]
    return plan


def _ways(start: Cell, placed: Collection[Cell], size: int) -> Mapping[Cell, list[Action]]:
    """The shortest moves to every cell that can be reached, at least one: a block is placed after a move."""
    ways: dict[Cell, list[Action]] = {start: []}
    queue = deque([start])
    while queue:
        cell = queue.popleft()
        for action in WITH_BLOCK:
            there = moved(cell, action, placed, size)
            if there not in ways:
                ways[there] = [*ways[cell], action]
                queue.append(there)
    ways[start] = _in_place(start, placed, size)
    return ways


def _in_place(cell: Cell, placed: Collection[Cell], size: int) -> list[Action]:
    """Against what stops a move, or away and back."""
    blocked = next((action for action in WITH_BLOCK if moved(cell, action, placed, size) == cell), None)
    if blocked is not None:
        return [blocked]
    return next([there, back] for there in WITH_BLOCK for back in WITH_BLOCK if _are_opposite(there, back))


def _are_opposite(there: Action, back: Action) -> bool:
    return (STEP[there][0] + STEP[back][0], STEP[there][1] + STEP[back][1]) == (0, 0)


def _chance(target: Cell, beliefs: Beliefs, blocks: int) -> float:
    pays = beliefs.cells == Belief.PAYS
    left = blocks - int(pays.sum())
    unknown = int((beliefs.cells == Belief.UNKNOWN).sum() + (beliefs.cells == Belief.BELIEVED).sum())
    anywhere = left / max(unknown, 1)
    around = int(pays[max(target[0] - 1, 0) : target[0] + 2, max(target[1] - 1, 0) : target[1] + 2].sum())
    return max(anywhere, (0.0, BESIDE_ONE)[around] if around < 2 else BESIDE_MORE)
