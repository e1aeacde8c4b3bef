"""The fewest steps that build a whole design: exact search over every order of its blocks.

A state is (which blocks are placed, where the agent is). Only states without a wasted block count, so the blocks are
one of the 2^n subsets of the design. For each subset, the cells that the agent can be in after t steps are 15 rows of
15 bits. So one step of every subset at once is a few shifts over an array of shape (2^n, 15).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.builder import build
from mc_nested.arena.rules import SIZE
from mc_nested.arena.scenario import Scenario

EXACT_UP_TO = 18
"""Blocks up to which the search is exact: beyond, time and memory double with each block."""

Rows = NDArray[np.uint16]
"""(2^n, 15): a row of 15 bits for each y of each subset of the blocks."""

FULL_ROW = np.uint16((1 << SIZE) - 1)


@dataclass(frozen=True)
class FewestSteps:
    """Steps of a full build: the fewest possible if ``exact``, otherwise the scripted builder's, an upper bound."""

    steps: int
    exact: bool


def fewest_steps(scenario: Scenario) -> FewestSteps:
    """The fewest steps that build the whole design, ignoring the step limit."""
    if scenario.blocks > EXACT_UP_TO:
        return FewestSteps(len(build(scenario)), exact=False)
    return FewestSteps(_search(scenario), exact=True)


def _search(scenario: Scenario) -> int:
    """Breadth first from the start cell until the whole design is built."""
    blocks = sorted(scenario.design)
    free = _free_cells(blocks)
    reached = np.zeros_like(free)
    reached[0, scenario.start[1]] = 1 << scenario.start[0]
    steps = 0
    while not reached[-1].any():
        moved = _after_one_move(reached, free)
        reached |= moved
        for index, (x, y) in enumerate(blocks):
            _place(moved, reached, index, x, y - 1)
        steps += 1
    return steps


def _free_cells(blocks: list[tuple[int, int]]) -> Rows:
    """(2^n, 15) uint16: bit x of [subset, y] is set where no block of the subset stands."""
    subsets = np.arange(1 << len(blocks))
    free = np.full((len(subsets), SIZE), FULL_ROW, dtype=np.uint16)
    for index, (x, y) in enumerate(blocks):
        free[(subsets >> index) & 1 == 1, y] &= FULL_ROW & ~np.uint16(1 << x)
    return free


def _after_one_move(reached: Rows, free: Rows) -> Rows:
    """Where the agent can be after exactly one move: in a free neighbour, or stopped where it was."""
    left, right = reached >> 1, (reached << 1) & FULL_ROW
    back, forward = np.zeros_like(reached), np.zeros_like(reached)
    back[:, :-1], forward[:, 1:] = reached[:, 1:], reached[:, :-1]
    moved: Rows = ((left | right | back | forward) & free) | _stopped(reached, free)
    return moved


def _stopped(reached: Rows, free: Rows) -> Rows:
    """Where a move can be stopped: cells with a block or the arena's edge on some side."""
    solid = ~free & FULL_ROW
    edge = np.uint16(1 | 1 << (SIZE - 1))
    beside = ((solid << 1) | (solid >> 1) | edge) & FULL_ROW
    beside[:, 0] = beside[:, -1] = FULL_ROW
    beside[:, 1:] |= solid[:, :-1]
    beside[:, :-1] |= solid[:, 1:]
    stopped: Rows = reached & beside
    return stopped


def _place(moved: Rows, reached: Rows, index: int, x: int, y: int) -> None:
    """Place block ``index`` in every subset without it in which the agent moved to (x, y), right before it."""
    without = moved.reshape(-1, 2, 1 << index, SIZE)[:, 0, :, y]
    with_block = reached.reshape(-1, 2, 1 << index, SIZE)[:, 1, :, y]
    with_block |= without & np.uint16(1 << x)
