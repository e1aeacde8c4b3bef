"""States as numbers: what a learner's rows see, numbered, and the features that a network takes for each number.

A state is a few small integers; all of a learner's possible states are enumerated once, with their features in a table.
A replay then keeps one number a state, and a batch is encoded by one look into the table.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.learn.networks import Floats, Sizes

Ints = NDArray[np.int64]


class StateSpace:
    """What the rows of a learner see and do.

    ``table`` (…, inputs + 1) has a line of features for each state of each kind of row, each line ending in a 1.

    Args:
        highest: the highest value of each integer of a state, (rows, width); the lowest is 0.
        actions: how many actions there are.
        encoding: how a network takes a state: each integer ``scaled`` to [-1, 1], or ``one-hot``.
    """

    def __init__(self, highest: Ints, actions: int, encoding: str = "scaled") -> None:
        self.actions = actions
        self.rows = len(highest)
        radix = highest.max(axis=0) + 1
        self.count = int(radix.prod())
        self._place_values = np.append(radix[:0:-1].cumprod()[::-1], 1)
        every = np.stack(np.unravel_index(np.arange(self.count), radix), axis=1)
        kinds, kind_of = np.unique(highest, axis=0, return_inverse=True)
        self.table = np.concatenate(
            [scaled(every, kind) if encoding == "scaled" else one_hot(every, radix) for kind in kinds]
        )
        self.inputs = self.table.shape[1] - 1
        self._first = kind_of.reshape(-1) * self.count

    def number(self, states: NDArray[np.integer[Any]]) -> Ints:
        """The number (…) of each state (…, width)."""
        numbers: Ints = np.einsum("...w,w->...", states, self._place_values)
        return numbers

    def network(self, hidden: Sequence[int]) -> Sizes:
        """The widths of a network for these states and actions."""
        return (self.inputs, *hidden, self.actions)

    def first_of(self, rows: Ints) -> Ints:
        """Where in ``table`` the states of the named rows (k,) begin, (k,)."""
        return self._first[rows]

    def features_of(self, row: int) -> Floats:
        """What that row's network takes for every state, by its number: (states, inputs + 1), the last a 1."""
        first = self._first[row]
        return self.table[first : first + self.count]


def scaled(states: NDArray[np.integer[Any]], highest: Ints) -> Floats:
    """Each integer of the states (…, width) scaled to [-1, 1] (README: the task), and behind them a 1.

    A part of the state that has one value only (a single material) comes out as 0.
    """
    values = (2.0 * states - highest) / np.maximum(highest, 1)
    return np.concatenate((values, np.ones((*values.shape[:-1], 1))), axis=-1).astype(np.float32)


def one_hot(states: NDArray[np.integer[Any]], radix: Ints) -> Floats:
    """Each integer of the states (…, width) as a 1 among as many numbers as it has values, and behind them a 1."""
    parts = [np.eye(values, dtype=np.float32)[states[..., part]] for part, values in enumerate(radix)]
    return np.concatenate((*parts, np.ones((*states.shape[:-1], 1), np.float32)), axis=-1)
