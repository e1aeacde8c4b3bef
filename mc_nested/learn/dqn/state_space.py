"""A learner's states, enumerated: an index for each possible state, and the features that a network takes for it.

A state is a few small integers. All possible states are enumerated once, with their features in a table. A replay then
stores one index per state, and a batch is encoded by one table lookup.
"""

from collections.abc import Sequence

import numpy as np

from mc_nested.arrays import Float32s, Int64s, Integers
from mc_nested.learn.dqn.networks import Sizes


class StateSpace:
    """What the rows of a learner see and do.

    ``table`` (…, inputs + 1) has a row of features for each state of each kind of learner, each ending in a 1.
    ``cells`` is how many pairs (x, y) of the first two integers there are; ``strides`` (width,) is what each integer
    counts for in a state's index.

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
        self.strides = np.append(radix[:0:-1].cumprod()[::-1], 1)
        every = np.stack(np.unravel_index(np.arange(self.count), radix), axis=1)
        kinds, kind_of = np.unique(highest, axis=0, return_inverse=True)
        self.cells = int(radix[:2].prod())
        self.table = np.concatenate([_encoded(encoding, every, radix, kind) for kind in kinds])
        self.inputs = self.table.shape[1] - 1
        self._first = kind_of.reshape(-1) * self.count

    def index(self, states: Integers) -> Int64s:
        """The index (…) of each state (…, width)."""
        indices: Int64s = np.einsum("...w,w->...", states, self.strides)
        return indices

    def network(self, hidden: Sequence[int]) -> Sizes:
        """The widths of a network for these states and actions."""
        return (self.inputs, *hidden, self.actions)

    def first_of(self, rows: Int64s) -> Int64s:
        """Where in ``table`` the states of the named rows (k,) begin, (k,)."""
        return self._first[rows]

    def features_of(self, row: int) -> Float32s:
        """The features of every state for that row's network, by index: (states, inputs + 1), the last a 1."""
        first = self._first[row]
        return self.table[first : first + self.count]


def _encoded(encoding: str, states: Integers, radix: Int64s, highest: Int64s) -> Float32s:
    if encoding == "one-hot":
        return one_hot(states, radix)
    return one_hot_cell(states, radix) if encoding == "cell" else scaled(states, highest)


def scaled(states: Integers, highest: Int64s) -> Float32s:
    """Each integer of the states (…, width) scaled to [-1, 1] (TASK.md), followed by a 1.

    A part of the state that has one value only (a single material) becomes 0.
    """
    values = (2.0 * states - highest) / np.maximum(highest, 1)
    return np.concatenate((values, np.ones((*values.shape[:-1], 1))), axis=-1).astype(np.float32)


def one_hot(states: Integers, radix: Int64s) -> Float32s:
    """Each integer of the states (…, width) as a 1 among as many numbers as it has values, followed by a 1."""
    parts = [np.eye(values, dtype=np.float32)[states[..., part]] for part, values in enumerate(radix)]
    return np.concatenate((*parts, np.ones((*states.shape[:-1], 1), np.float32)), axis=-1)


def one_hot_cell(states: Integers, radix: Int64s) -> Float32s:
    """The first two integers of the states (…, width) as a 1 among all their pairs, the others one-hot, then a 1."""
    cells = np.eye(int(radix[:2].prod()), dtype=np.float32)[states[..., 0] * radix[1] + states[..., 1]]
    return np.concatenate((cells, one_hot(states[..., 2:], radix[2:])), axis=-1)
