"""The fewest steps that build a whole design: exact search over every order of its blocks.

A state is (which blocks are placed, where the agent is). Only states without a wasted block count, so the blocks are
one of the 2^n subsets of the design; with parts, none that holds a block of a part before the earlier parts are whole.
For each subset, the cells that the agent can be in after t steps are a row of bits for each y. So one step of every
subset at once is a few shifts over an array of shape (2^n, size).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.builder import build
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Int64s

EXACT_UP_TO = 18
"""Blocks up to which the search is exact: beyond, time and memory double with each block."""

Rows = NDArray[np.unsignedinteger[Any]]
"""(2^n, size): a row of bits for each y of each subset of the blocks, bit x for the cell (x, y)."""


@dataclass(frozen=True)
class FewestSteps:
    """Steps of a full build: the fewest possible if ``exact``, otherwise the scripted builder's, an upper bound."""

    steps: int
    exact: bool


def fewest_steps(scenario: Scenario) -> FewestSteps:
    """Return the fewest steps that build the whole design, part after part, ignoring the step limit."""
    if scenario.blocks > EXACT_UP_TO:
        return FewestSteps(len(build(scenario)), exact=False)
    return FewestSteps(_search(scenario), exact=True)


def _search(scenario: Scenario) -> int:
    """Search breadth first from the start cell until the whole design is built."""
    blocks = sorted(scenario.design)
    free = _free_cells(blocks, scenario.size)
    out_of_turn = _out_of_turn(blocks, scenario)
    reached = np.zeros_like(free)
    reached[0, scenario.start[1]] = 1 << scenario.start[0]
    steps = 0
    while not reached[-1].any():
        moved = _after_one_move(reached, free)
        reached |= moved
        for index, (x, y) in enumerate(blocks):
            _place(moved, reached, index, x, y - 1)
        reached[out_of_turn] = 0
        steps += 1
    return steps


def _out_of_turn(blocks: list[Cell], scenario: Scenario) -> Int64s:
    """Return the subsets with a block of a part but not all of an earlier one, which never come up."""
    subsets = np.arange(1 << len(blocks))
    wrong = np.zeros(len(subsets), dtype=np.bool_)
    begun = np.zeros(len(subsets), dtype=np.bool_)
    for part in reversed(scenario.in_order):
        mask = sum(1 << index for index, cell in enumerate(blocks) if cell in part.cells)
        wrong |= begun & (subsets & mask != mask)
        begun |= subsets & mask != 0
    return np.flatnonzero(wrong)


def _free_cells(blocks: list[Cell], size: int) -> Rows:
    """Return rows in which bit x of [subset, y] is set where no block of the subset stands."""
    subsets = np.arange(1 << len(blocks))
    free: Rows = np.full((len(subsets), size), (1 << size) - 1, dtype=np.uint16 if size <= 16 else np.uint32)
    for index, (x, y) in enumerate(blocks):
        free[(subsets >> index) & 1 == 1, y] &= ~free.dtype.type(1 << x)
    return free


def _after_one_move(reached: Rows, free: Rows) -> Rows:
    """Return where the agent can be after exactly one move: in a free neighbour, or stopped where it was."""
    left, right = reached >> np.uint8(1), reached << np.uint8(1)
    back, forward = np.zeros_like(reached), np.zeros_like(reached)
    back[:, :-1], forward[:, 1:] = reached[:, 1:], reached[:, :-1]
    moved: Rows = ((left | right | back | forward) & free) | _stopped(reached, free)
    return moved


def _stopped(reached: Rows, free: Rows) -> Rows:
    """Return where a move can be stopped: cells with a block or the arena's edge on some side."""
    size = free.shape[1]
    full_row, edge = free.dtype.type((1 << size) - 1), free.dtype.type(1 | 1 << (size - 1))
    solid = ~free & full_row
    beside = (solid << 1) | (solid >> 1) | edge
    beside[:, 0] = beside[:, -1] = full_row
    beside[:, 1:] |= solid[:, :-1]
    beside[:, :-1] |= solid[:, 1:]
    stopped: Rows = reached & beside
    return stopped


def _place(moved: Rows, reached: Rows, index: int, x: int, y: int) -> None:
    """Place block ``index`` in every subset without it in which the agent moved to (x, y), right before it."""
    without = moved.reshape(-1, 2, 1 << index, moved.shape[1])[:, 0, :, y]
    with_block = reached.reshape(-1, 2, 1 << index, reached.shape[1])[:, 1, :, y]
    with_block |= without & reached.dtype.type(1 << x)
