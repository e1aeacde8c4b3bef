"""States as numbers: what a learner's rows see, numbered, and the features that a network takes for each number.

A state is a few small integers; all of a learner's possible states are enumerated once, with their features in a table.
A replay then keeps one number a state, and a batch is encoded by one look into the table.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.learn.networks import Floats

Ints = NDArray[np.int64]


class StateSpace:
    """What the rows of a learner see and do.

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
        self._table = np.concatenate(
            [scaled(every, kind) if encoding == "scaled" else one_hot(every, radix) for kind in kinds]
        )
        self.inputs = self._table.shape[1] - 1
        self._first = kind_of.reshape(-1) * self.count

    def number(self, states: NDArray[np.integer[Any]]) -> Ints:
        """The number (…) of each state (…, width)."""
        numbers: Ints = np.einsum("...w,w->...", states, self._place_values)
        return numbers

    def inputs_for(self, numbers: NDArray[np.integer[Any]], rows: Ints) -> Floats:
        """What networks of the named rows (k,) take for numbered states (…, k, batch): (…, k, inputs + 1, batch)."""
        features = self._table.take(numbers + self._first[rows, None], axis=0)
        columns: Floats = features.swapaxes(-1, -2)
        return columns


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
