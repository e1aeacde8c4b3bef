"""Where the next blocks of an episode are worth most, by what is believed: they find the design, then they build it.

As long as too few paying cells are known, every block tries a cell: one beside a paying cell, or else one in the middle
of what is unknown, since a design that goes on from cell to cell is met there soonest.
"""

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from mc_nested.arena.action import Cell
from mc_nested.arrays import Bools
from mc_nested.learn.imagination.beliefs import Belief, Beliefs

AROUND = 2
"""How far around a cell it is counted what is unknown."""

TO_FIND = Belief.BELIEVED, Belief.UNKNOWN, Belief.PAYS, Belief.PAYS_NOT
"""What is tried while cells are to be found, in this order: where nothing is left, what paid nothing is tried again."""


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
