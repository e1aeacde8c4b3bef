"""How near each cell of an arena is to some sources, past all that stands in the way, and how that changes (slopes).

A source's nearness spreads from cell to cell, and shrinks by how well each cell is passed (value propagation: Nardelli
et al., 2018), until nothing changes any more: so a way may be as long as it must.
"""

import numpy as np

from mc_nested.arrays import Float32s, Int64s
from mc_nested.compiled import compiled

STEPS = np.array(((0, 1), (0, -1), (-1, 0), (1, 0)), np.int64)
"""To a cell's four neighbours."""

FROM_ITSELF = -1

SMALL, TINY = 1e-6, 1e-30
"""What networks add to a nearness before its logarithm, and the least that they divide by."""


@compiled()
def spread(sources: Float32s, passing: Float32s) -> tuple[Float32s, Int64s]:
    """Return how near each cell is (R, side, side), and which neighbour it has that from, x * side + y.

    It is FROM_ITSELF where that is its own source.

    Args:
        sources: (R, side, side), from 0 to 1.
        passing: how well one passes each cell, (R, side, side), from 0 to 1.
    """
    runs, side, _ = sources.shape
    near = sources.copy()
    via = np.full(sources.shape, FROM_ITSELF, np.int64)
    for run in range(runs):
        is_changed, backwards = True, False
        while is_changed or backwards:
            is_changed = is_changed and backwards
            for cell in range(side * side):
                x, y = divmod(side * side - 1 - cell if backwards else cell, side)
                best, neighbour = np.float32(0), FROM_ITSELF
                for step in range(len(STEPS)):
                    to_x, to_y = x + STEPS[step, 0], y + STEPS[step, 1]
                    if 0 <= to_x < side and 0 <= to_y < side and near[run, to_x, to_y] > best:
                        best, neighbour = near[run, to_x, to_y], to_x * side + to_y
                value = passing[run, x, y] * best
                if value > near[run, x, y]:
                    near[run, x, y], via[run, x, y] = value, neighbour
                    is_changed = True
            backwards = not backwards
    return near, via


@compiled()
def slopes(passing: Float32s, near: Float32s, via: Int64s, of_near: Float32s) -> tuple[Float32s, Float32s]:
    """Return the slopes of a loss in the sources and in ``passing``, from those in ``near``, each (R, side, side).

    ``near`` and ``via`` are what ``spread`` returned.
    """
    runs, side, _ = near.shape
    of_sources, of_passing = np.zeros_like(near), np.zeros_like(near)
    followers, waiting = np.empty(side * side, np.int64), np.empty(side * side, np.int64)
    for run in range(runs):
        own, back = of_near[run].copy().reshape(-1), via[run].reshape(-1)
        values, ways = near[run].reshape(-1), passing[run].reshape(-1)
        followers[:] = 0
        for cell in range(side * side):
            if back[cell] != FROM_ITSELF:
                followers[back[cell]] += 1
        ends = 0
        for cell in range(side * side):
            if not followers[cell]:
                waiting[ends] = cell
                ends += 1
        begins = 0
        while begins < ends:  # a cell when all that have their nearness from it are done
            cell = waiting[begins]
            begins += 1
            x, y = divmod(cell, side)
            before = back[cell]
            if before == FROM_ITSELF:
                of_sources[run, x, y] = own[cell]
                continue
            of_passing[run, x, y] = own[cell] * values[before]
            own[before] += own[cell] * ways[cell]
            followers[before] -= 1
            if not followers[before]:
                waiting[ends] = before
                ends += 1
    return of_sources, of_passing
