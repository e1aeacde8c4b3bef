"""States: what a learner's rows see and do, as a replay keeps it. Numbered (StateSpace), or planes of bytes or bits.

A numbered state is a few small integers. All possible states are enumerated once: an index for each, and the features
that a network takes for it. A replay then stores one index per state, and a batch is encoded by table lookups: what a
network takes for (x, y) is in one table, what it takes for the rest in another, so that both stay small where there is
an input for each cell.
"""

import math
from collections.abc import Sequence
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Float32s, Int64s, Integers

WANTED, OCCUPIED, AGENT, LOSES = range(4)
"""What agents with objectives see: the objective, or all cells still to build; what stands; and where the agent is.

The main agent also sees which cells to build would lose another one if a block stood there.
"""

REACH_PLANES, ORDER_PLANES = 3, 4
"""The nested agent's planes, and the main agent's."""

NONE, MANY = -1e6, 32.0
"""To the main agent, the value of a cell that isn't to be built, and how many cells to build count as 1."""

Sees = Literal["everything", "objective", "surroundings"]
"""What the nested agent is shown of the objective and of what stands: both, or that one alone."""


class PlaneStates(NamedTuple):
    """Planes of whole numbers from 0 to 255, kept as they are; or of bits, of which a byte keeps eight.

    Args:
        rows: how many rows there are.
        actions: how many actions there are.
        planes: (planes, height, width).
        are_bits: whether they are bits.
    """

    rows: int
    actions: int
    planes: tuple[int, ...]
    are_bits: bool = False

    @property
    def highest(self) -> int:
        return 255

    @property
    def shape(self) -> tuple[int, ...]:
        return (-(-math.prod(self.planes) // 8),) if self.are_bits else self.planes

    def encoded(self, states: NDArray[Any]) -> NDArray[Any]:
        if not self.are_bits:
            return states
        return np.packbits(states.reshape(*states.shape[: -len(self.planes)], -1), axis=-1)


class StateParts(NamedTuple):
    """The features of states in two parts: (kinds x cells, …) for x and y, (kinds x rest, …) for the others and a 1.

    There are ``a_cell`` states for each cell, and ``a_kind`` for each kind of learner.
    """

    cells: Float32s
    rest: Float32s
    a_cell: int
    a_kind: int


class StateSpace:
    """What the rows of a learner see and do.

    ``cells`` is how many pairs (x, y) of the first two integers there are, and ``rest`` how many combinations of the
    others; ``strides`` (width,) is what each integer counts for in a state's index.

    Args:
        highest: the highest value of each integer of a state, (rows, width); the lowest is 0.
        actions: how many actions there are.
        encoding: how a network sees a state: each integer ``scaled`` to [-1, 1]; each ``one-hot``; or an input for each
            ``cell`` (x, y) and for each value of the other integers.
    """

    def __init__(self, highest: Int64s, actions: int, encoding: str = "scaled") -> None:
        self.actions = actions
        self.rows = len(highest)
        radix = highest.max(axis=0) + 1
        self.count = int(radix.prod())
        # A replay keeps an index; the highest is that of no state, the first beyond them.
        self.highest, self.shape = self.count, ()
        self.strides = np.append(radix[:0:-1].cumprod()[::-1], 1)
        kinds, kind_of = np.unique(highest, axis=0, return_inverse=True)
        self.cells = int(radix[:2].prod())
        self.rest = self.count // self.cells
        self.parts = StateParts(
            np.concatenate([_of_cells(encoding, radix, kind) for kind in kinds]),
            np.concatenate([_of_rest(encoding, radix, kind) for kind in kinds]),
            self.rest,
            self.count,
        )
        self.inputs = self.parts.cells.shape[1] + self.parts.rest.shape[1] - 1
        self._first = kind_of.reshape(-1) * self.count

    def encoded(self, states: Integers) -> Int64s:
        """Return the index (…) of each state (…, width), which is all that a replay keeps of it."""
        indices: Int64s = states @ self.strides
        return indices

    def network(self, hidden: Sequence[int]) -> tuple[int, ...]:
        """Return the widths of a network for these states and actions."""
        return (self.inputs, *hidden, self.actions)

    @cached_property
    def table(self) -> Float32s:
        """A row of features for each state of each kind of learner, each ending in a 1: (…, inputs + 1)."""
        width = self.parts.rest.shape[1]
        rest = np.tile(self.parts.rest.reshape(-1, self.rest, width), (1, self.cells, 1)).reshape(-1, width)
        return np.hstack((np.repeat(self.parts.cells, self.rest, axis=0), rest))

    def first_of(self, rows: Int64s) -> Int64s:
        """Return where in ``table`` the states of the named rows (k,) begin, (k,)."""
        return self._first[rows]

    def rest_of(self, row: int) -> Float32s:
        """Return the features of every combination of the integers after x and y for that row's network, then a 1."""
        first = self._first[row] // self.cells
        return self.parts.rest[first : first + self.rest]

    def features_of(self, row: int) -> Float32s:
        """Return the features of every state for that row's network, by index: (states, inputs + 1), the last a 1."""
        first = self._first[row]
        return self.table[first : first + self.count]


States = StateSpace | PlaneStates
"""What the rows of a learner see and do.

Of states (…) a replay keeps what ``encoded`` gives: whole numbers from 0 to ``highest``, (…, *shape).
"""


def numbered(states: States) -> StateSpace:
    """Return those states, whose indices something else is to know; TypeError if they aren't numbered."""
    if not isinstance(states, StateSpace):
        raise TypeError("only numbered states have indices")
    return states


def _of_cells(encoding: str, radix: Int64s, highest: Int64s) -> Float32s:
    """Return what a network takes for x and y, for each pair of them."""
    pairs = _every(radix[:2])
    if encoding == "cell":
        return np.eye(len(pairs), dtype=np.float32)
    return (one_hot(pairs, radix[:2]) if encoding == "one-hot" else scaled(pairs, highest[:2]))[:, :-1]


def _of_rest(encoding: str, radix: Int64s, highest: Int64s) -> Float32s:
    """Return what a network takes for the integers after x and y, for each combination of them, followed by a 1."""
    rest = _every(radix[2:])
    return scaled(rest, highest[2:]) if encoding == "scaled" else one_hot(rest, radix[2:])


def _every(radix: Int64s) -> Int64s:
    """Return every combination of integers below these, in the order of their indices, (combinations, integers)."""
    count = int(radix.prod())
    if not len(radix):
        return np.empty((count, 0), np.int64)
    return np.stack(np.unravel_index(np.arange(count), radix), axis=1)


def scaled(states: Integers, highest: Int64s) -> Float32s:
    """Return each integer of the states (…, width) scaled to [-1, 1] (docs/explanation/task.md), followed by a 1.

    A part of the state that has one value only (a single material) becomes 0.
    """
    values = (2.0 * states - highest) / np.maximum(highest, 1)
    return np.concatenate((values, np.ones((*values.shape[:-1], 1))), axis=-1).astype(np.float32)


def one_hot(states: Integers, radix: Int64s) -> Float32s:
    """Return each integer of the states (…, width) as a 1 among as many numbers as it has values, followed by a 1."""
    parts = [np.eye(values, dtype=np.float32)[states[..., part]] for part, values in enumerate(radix)]
    return np.concatenate((*parts, np.ones((*states.shape[:-1], 1), np.float32)), axis=-1)
