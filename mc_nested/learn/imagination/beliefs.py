"""Where a block pays, as far as is known, and what is taken optimistically where it isn't.

Each cell's tries are counted, the later ones for more: one odd outcome is outvoted, two in a row are believed, so that
a design changed in mid-training is unlearnt. As long as fewer paying cells are known than there are blocks, an unknown
cell is taken to pay (R-max; Brafman and Tennenholtz, 2002), and more than what is known, since trying it teaches: first
what lies beside a paying cell, where designs go on; everything, if nothing unknown lies there.

Who has no learnt game to practise in goes by ``candidates``. As long as too few paying cells are known, every block
tries a cell: one beside a paying cell, or else one in the middle of what is unknown, since a design that goes on from
cell to cell is met there soonest.
"""

from collections.abc import Collection
from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from mc_nested.arena.action import Cell
from mc_nested.arrays import Bools, Float32s, Float64s, Int8s, Int64s
from mc_nested.learn.imagination.experience import UNTOLD
from mc_nested.learn.imagination.learnt_rules import FADES

FAR_FROM_PAYING, KNOWN_TO_PAY = 0.2, 0.05
"""While exploring, what is imagined for an unknown cell that isn't beside a paying one, and for one known to pay; for
an unknown cell beside a paying one it is 1."""

AROUND = 2
"""How far around a cell it is counted what is unknown."""


class Belief(IntEnum):
    """What is thought of a cell."""

    UNKNOWN = 0
    BELIEVED = 1
    PAYS = 2
    PAYS_NOT = 3


TO_FIND = Belief.BELIEVED, Belief.UNKNOWN, Belief.PAYS, Belief.PAYS_NOT
"""What is tried while cells are to be found, in this order: where nothing is left, what paid nothing is tried again."""


@dataclass(frozen=True)
class Beliefs:
    """What is thought of every cell.

    ``cells`` (size, size) holds a Belief for each, ``pay`` (size, size) what is imagined to be paid there.
    ``explores``: fewer paying cells are known than an episode has blocks. ``most``: what the best episode could earn.
    """

    cells: Int8s
    pay: Float32s
    explores: bool
    most: float


def evidence_of(steps: Int64s, lands: Cell, size: int) -> Float64s:
    """Return how much says of each cell that it doesn't pay, and that it does, (2, size, size); 0 before any try.

    ``steps`` are transitions (steps, 9) (experience.py); blocks land at ``lands`` from the agent.
    """
    evidence = np.zeros((2, size, size))
    told = (steps[:, 2] > steps[:, 6]) & (steps[:, 7] != UNTOLD)
    for x, y, paid in steps[told][:, [4, 5, 7]].tolist():
        count_try(evidence, (x + lands[0], y + lands[1]), paid)
    return evidence


def count_try(evidence: Float64s, cell: Cell, paid: int) -> None:
    """Add to the evidence (2, size, size) that a block in that cell was ``paid``, 1, or wasn't, 0."""
    size = evidence.shape[1]
    if 0 <= cell[0] < size and 0 <= cell[1] < size:
        evidence[:, cell[0], cell[1]] *= FADES
        evidence[paid, cell[0], cell[1]] += 1.0


def believe(
    evidence: Float64s,
    lands: Cell,
    blocks: int,
    optimism: bool = True,
    neighbours: bool = True,
    elsewhere: Collection[Cell] = (),
    walls: Bools | None = None,
) -> Beliefs:
    """Return what evidence (2, size, size) says of every cell, if blocks land at ``lands`` from the agent.

    Without ``optimism`` what is unknown isn't taken to pay; without ``neighbours`` all that is unknown is alike.
    Cells that are probed ``elsewhere``, in other games, are taken to pay nothing, unless no other unknown cell is left.
    ``walls`` (size, size) pay nothing.
    """
    size = evidence.shape[1]
    tried = evidence.any(axis=0)
    free = np.ones((size, size), dtype=np.bool_) if walls is None else ~walls
    unknown = ~tried & _reached(lands, size) & free
    left = unknown.copy()
    left[tuple(np.array(list(elsewhere), dtype=np.int64).reshape(-1, 2).T)] = False
    if left.any():
        unknown = left
    pays = free & (evidence[1] > evidence[0])
    explores = int(pays.sum()) < blocks
    believed = _beside(pays) & unknown & explores & neighbours
    cells = np.where(pays, Belief.PAYS, np.where(tried | ~free, Belief.PAYS_NOT, Belief.UNKNOWN)).astype(np.int8)
    cells[believed] = Belief.BELIEVED
    pay = pays.astype(np.float32)
    if explores and optimism:
        pay[pays] = KNOWN_TO_PAY
        pay[unknown] = FAR_FROM_PAYING if believed.any() else 1.0
        pay[believed] = 1.0
    most = float(np.sort(pay, axis=None)[::-1][:blocks].sum(dtype=np.float64))
    return Beliefs(cells, pay, explores, most)


def candidates(beliefs: Beliefs, buildable: Bools, cell: Cell, blocks: int) -> frozenset[Cell]:
    """Return the cells where the next blocks should land; none if nothing that pays can be built any more.

    Args:
        beliefs: what is thought of every cell.
        buildable: the cells where a block can land now, (size, size).
        cell: where the agent stands.
        blocks: how many are left.
    """
    for belief in TO_FIND if beliefs.explores else (Belief.PAYS,):
        found = buildable & (beliefs.cells == belief)
        if found.any():
            if belief is Belief.UNKNOWN:
                found = _spread((beliefs.cells == belief) & (beliefs.pay > 0), found, cell, blocks)
            return frozenset((x, y) for x, y in np.argwhere(found).tolist())
    return frozenset()


def _reached(lands: Cell, size: int) -> Bools:
    """Return the cells that a block can land in from inside the arena."""
    reached = np.zeros((size, size), dtype=np.bool_)
    right, forward = lands
    reached[max(right, 0) : size + min(right, 0), max(forward, 0) : size + min(forward, 0)] = True
    return reached


def _beside(cells: Bools) -> Bools:
    """Return the cells with one of these among the eight around them."""
    beside: Bools = sliding_window_view(np.pad(cells, 1), (3, 3)).max((2, 3))
    return beside


def _spread(unknown: Bools, open_cells: Bools, cell: Cell, most: int) -> Bools:
    """Return at most so many of the open cells: each has the most unknown cells around it, but for those before it.

    Of several it is the nearest.
    """
    size = len(unknown)
    around = sliding_window_view(np.pad(unknown, AROUND), (2 * AROUND + 1,) * 2).sum((2, 3))
    away = np.abs(np.indices((size, size)) - np.array(cell)[:, None, None]).sum(0)
    value = np.pad(np.where(open_cells, around - away / (2 * size), -np.inf), AROUND, constant_values=-np.inf)
    chosen = np.zeros_like(open_cells)
    for _ in range(min(most, int(open_cells.sum()))):
        x, y = divmod(int(value.argmax()), size + 2 * AROUND)
        chosen[x - AROUND, y - AROUND] = True
        value[x, y] = -np.inf
        value[x - AROUND : x + AROUND + 1, y - AROUND : y + AROUND + 1] -= 1
    return chosen
