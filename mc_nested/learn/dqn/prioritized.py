"""Prioritized experience replay, the paper's own future work (section 7; Schaul et al., 2016, proportional).

A transition is drawn with a probability proportional to (|TD error| + SMALLEST_ERROR) ** α, and weighted in the update
by (its probability · number of transitions) ** -β, relative to the largest weight in the batch. A new transition gets
the highest priority that its run has seen. Each run's priorities are the leaves of a sum tree: sampling goes down the
levels, a new priority goes up.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Float32s, Float64s, Int64s

SMALLEST_ERROR = 1e-3
"""Added to every error, so that a transition without error can still be drawn; Huber losses here are of order 1."""


class Priorities:
    """The priorities of each run's transitions.

    Args:
        runs: how many runs.
        room: transitions per run that fit at first; a power of two.
        alpha: how much priorities count: 0 samples uniformly.
        beta: how much of their bias the weights correct: 1 all of it.
    """

    def __init__(self, runs: int, room: int, alpha: float, beta: float) -> None:
        self._alpha, self._beta = alpha, beta
        self._highest = np.ones(runs)
        self._tree = np.zeros((runs, 2 * room))

    @property
    def room(self) -> int:
        """Transitions per run that fit."""
        return self._tree.shape[1] // 2

    def add(self, rows: Int64s, indices: Int64s) -> None:
        """Add a new transition of each of the named runs (k,), at its index in the replay (k,)."""
        while indices.max(initial=0) >= self.room:
            leaves = self._tree[:, self.room :]
            self._tree = _tree_over(np.concatenate((leaves, np.zeros_like(leaves)), axis=1))
        self._put(rows[:, None], indices[:, None], self._highest[rows, None])

    def sample(self, rows: Int64s, numbers: Float64s, replaced: Int64s | None = None) -> Int64s:
        """Return indices (k, batch) in proportion to the priorities of the named runs, one from each of equal parts.

        ``numbers`` in [0, 1), (k, batch), say where in its part. The first ``replaced`` (k,) of each row will be
        replaced by others: there are as many parts as indices without them. 0 if a run has none.
        """
        batch = numbers.shape[1]
        skipped = np.zeros(len(rows), dtype=np.int64) if replaced is None else np.minimum(replaced, batch - 1)
        part = np.maximum(np.arange(batch) - skipped[:, None], 0)
        left = (part + numbers) / (batch - skipped[:, None]) * self._tree[rows, 1, None]
        node = np.ones_like(left, dtype=np.int64)
        across = rows[:, None]
        while node[0, 0] < self.room:
            node *= 2
            below = self._tree[across, node]
            # Rounding may leave a remainder although the right half is empty.
            goes_right = (left >= below) & (self._tree[across, node + 1] > 0)
            left -= np.where(goes_right, below, 0.0)
            node += goes_right
        return node - self.room

    def weights(self, rows: Int64s, indices: Int64s, sizes: Int64s) -> Float32s:
        """Return the weights of sampled transitions (k, batch); the runs hold ``sizes`` (k,) transitions."""
        priorities = self._tree[rows[:, None], indices + self.room]
        shares = priorities / np.maximum(self._tree[rows, 1, None], np.finfo(float).tiny)
        weights = np.maximum(shares * sizes[:, None], np.finfo(float).tiny) ** -self._beta
        normal: Float32s = (weights / weights.max(axis=1, keepdims=True)).astype(np.float32)
        return normal

    def update_priorities(self, rows: Int64s, indices: Int64s, errors: Float32s) -> None:
        """Set the priorities by the TD errors (k, batch) of what was sampled; of an index sampled twice, the last."""
        priorities = (np.abs(errors).astype(np.float64) + SMALLEST_ERROR) ** self._alpha
        self._highest[rows] = np.maximum(self._highest[rows], priorities.max(axis=1))
        self._put(rows[:, None], indices, priorities)

    def state(self) -> dict[str, NDArray[Any]]:
        """Return what a later draw depends on, by name."""
        return {"leaves": self._tree[:, self.room :], "highest": self._highest}

    def load(self, state: dict[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if the shape differs."""
        self._highest[:] = state["highest"]
        self._tree = _tree_over(state["leaves"])

    def _put(self, across: Int64s, indices: Int64s, priorities: Float64s) -> None:
        node = indices + self.room
        self._tree[across, node] = priorities
        while node[0, 0] > 1:
            node = node // 2
            self._tree[across, node] = self._tree[across, 2 * node] + self._tree[across, 2 * node + 1]


def _tree_over(leaves: Float64s) -> Float64s:
    levels = [leaves]
    while levels[-1].shape[1] > 1:
        levels.append(levels[-1][:, 0::2] + levels[-1][:, 1::2])
    return np.concatenate([np.zeros((len(leaves), 1)), *reversed(levels)], axis=1)
