"""Q-values by the cell and the cells built, which is all that the learnt game depends on: a table that grows, compiled.

The learnt game has no chance in it. So a value here, what the best continuation found so far brings, stays true. Each
state has a name: random bits for the agent's cell and for each cell built, combined by exclusive or (Zobrist, 1970).
Open addressing finds its row.
"""

from typing import NamedTuple

import numpy as np
from numpy.random import Generator

from mc_nested.arrays import Float32s, Int64s
from mc_nested.compiled import compiled

NAME_BITS = 62
"""Random bits of a name: two of a practice's states share one less than once in a million practices."""

FULL = 0.75
"""Above this share of rows in use, finding a row takes long."""


class BuiltValues(NamedTuple):
    """``names`` (room,) of the rows' states, 0 where none is; their ``values`` (room, actions), 0 where none was tried.

    ``here`` and ``built`` (cells,) are the random bits of the agent's cell and of a cell built; ``held`` (1,) counts
    the rows in use. ``room`` is a power of 2.
    """

    names: Int64s
    values: Float32s
    here: Int64s
    built: Int64s
    held: Int64s


def empty_values(room: int, actions: int, cells: int) -> BuiltValues:
    """Return a table with so many rows, a power of 2, for an arena with so many cells, the border included.

    The table is not yet begun.
    """
    names, values = np.zeros(room, np.int64), np.zeros((room, actions), np.float32)
    return BuiltValues(names, values, np.zeros(cells, np.int64), np.zeros(cells, np.int64), np.zeros(1, np.int64))


def begin_values(table: BuiltValues, random: Generator) -> None:
    """Forget everything, and draw names for another game."""
    forget(table)
    for names in (table.here, table.built):
        names[:] = random.integers(1, 1 << NAME_BITS, len(names))


@compiled(nogil=True)
def forget(table: BuiltValues) -> None:
    """Empty the table."""
    table.names[:] = 0
    table.held[0] = 0


@compiled(nogil=True)
def is_full(table: BuiltValues) -> bool:
    """Return whether too few rows are free for another episode."""
    full: bool = table.held[0] > FULL * len(table.names)
    return full


@compiled(nogil=True)
def row_of(table: BuiltValues, name: int) -> int:
    """Return the row of the state with that name; a new one, with values of 0, if it has none."""
    last = len(table.names) - 1
    row = name & last
    while table.names[row] != 0 and table.names[row] != name:
        row = (row + 1) & last
    if table.names[row] == 0:
        table.names[row] = name
        table.values[row] = 0.0
        table.held[0] += 1
    return row
