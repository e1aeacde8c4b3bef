"""Prioritized experience replay, the paper's own future work (section 7; Schaul et al., 2016, proportional).

A transition is drawn with a probability proportional to (|TD error| + a little) ** α, and its part in the update is
weighted by (its probability · their number) ** -β, relative to the largest in the batch. A new transition has the
highest priority that its run has seen. Each run's priorities are the leaves of a tree of sums: a draw goes down the
levels, a new priority up.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.learn.networks import Floats

Ints = NDArray[np.int64]

A_LITTLE = 1e-3
"""What keeps a transition without any error from never being drawn again; Huber's losses here are of order 1."""


class Priorities:
    """The priorities of each run's transitions.

    Args:
        runs: how many runs.
        room: transitions of each run that there is room for at first; a power of two.
        alpha: how much priorities count: 0 draws uniformly.
        beta: how much of their bias the weights take back: 1 all of it.
    """

    def __init__(self, runs: int, room: int, alpha: float, beta: float) -> None:
        self._alpha, self._beta = alpha, beta
        self._highest = np.ones(runs)
        self._tree = np.zeros((runs, 2 * room))

    @property
    def room(self) -> int:
        """Transitions of each run that there is room for."""
        return self._tree.shape[1] // 2

    def add(self, rows: Ints, places: Ints) -> None:
        """A new transition of each of the named runs (k,), at its place in the replay (k,)."""
        while places.max(initial=0) >= self.room:
            self._grow()
        self._put(rows[:, None], places[:, None], self._highest[rows, None])

    def draw(self, rows: Ints, numbers: NDArray[np.float64]) -> Ints:
        """Places (k, batch) in proportion to the priorities of the named runs, one from each of ``batch`` equal parts.

        ``numbers`` in [0, 1), (k, batch), say where in its part. 0 where a run has none.
        """
        parts = numbers.shape[1]
        left = (np.arange(parts) + numbers) / parts * self._tree[rows, 1, None]
        node = np.ones_like(left, dtype=np.int64)
        across = rows[:, None]
        while node[0, 0] < self.room:
            node *= 2
            below = self._tree[across, node]
            # Rounding may leave a remainder where the right half holds nothing.
            goes_right = (left >= below) & (self._tree[across, node + 1] > 0)
            left -= np.where(goes_right, below, 0.0)
            node += goes_right
        return node - self.room

    def weights(self, rows: Ints, places: Ints, sizes: Ints) -> Floats:
        """The parts in the update of drawn places (k, batch), where the runs hold ``sizes`` (k,) transitions."""
        priorities = self._tree[rows[:, None], places + self.room]
        shares = priorities / np.maximum(self._tree[rows, 1, None], np.finfo(float).tiny)
        weights = np.maximum(shares * sizes[:, None], np.finfo(float).tiny) ** -self._beta
        normal: Floats = (weights / weights.max(axis=1, keepdims=True)).astype(np.float32)
        return normal

    def learnt(self, rows: Ints, places: Ints, errors: Floats) -> None:
        """The TD errors (k, batch) of what was drawn; of a place drawn twice, the last counts."""
        priorities = (np.abs(errors).astype(np.float64) + A_LITTLE) ** self._alpha
        self._highest[rows] = np.maximum(self._highest[rows], priorities.max(axis=1))
        self._put(rows[:, None], places, priorities)

    def state(self) -> dict[str, NDArray[Any]]:
        """Everything a later draw depends on, by name."""
        return {"leaves": self._tree[:, self.room :], "highest": self._highest}

    def load(self, state: dict[str, NDArray[Any]]) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        self._highest[:] = state["highest"]
        self._tree = _tree_over(state["leaves"])

    def _put(self, across: Ints, places: Ints, priorities: NDArray[np.float64]) -> None:
        node = places + self.room
        self._tree[across, node] = priorities
        while node[0, 0] > 1:
            node = node // 2
            self._tree[across, node] = self._tree[across, 2 * node] + self._tree[across, 2 * node + 1]

    def _grow(self) -> None:
        leaves = self._tree[:, self.room :]
        self._tree = _tree_over(np.concatenate((leaves, np.zeros_like(leaves)), axis=1))


def _tree_over(leaves: NDArray[np.float64]) -> NDArray[np.float64]:
    levels = [leaves]
    while levels[-1].shape[1] > 1:
        levels.append(levels[-1][:, 0::2] + levels[-1][:, 1::2])
    return np.concatenate([np.zeros((len(leaves), 1)), *reversed(levels)], axis=1)
