"""Experience replay for many runs at once (paper, appendix: one million transitions, uniform)."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from mc_nested.arrays import Float64s, Int64s, Integers

FIRST_ROOM = 4096
"""Transitions per run that memory is allocated for at first; it doubles when full."""


class Transitions(NamedTuple):
    """Transitions side by side, an array of each part in the caller's shape.

    ``states`` (2, …) holds the index of every s and of every s' (state_space.py); ``discounts`` is the factor of the
    value of s': γ, or 0 where the episode terminated.
    """

    states: Integers
    actions: Integers
    rewards: NDArray[Any]
    discounts: NDArray[Any]


class Replay:
    """The last ``capacity`` transitions of each run; what a run samples depends on its own transitions only.

    Args:
        runs: how many runs.
        states: how many states there are.
        capacity: transitions kept per run; the oldest is overwritten.
    """

    def __init__(self, runs: int, states: int, capacity: int) -> None:
        self.capacity = capacity
        self.added = np.zeros(runs, dtype=np.int64)
        self._index_type = np.min_scalar_type(states)
        self._room = min(FIRST_ROOM, capacity)
        self._kept = self._memory(runs, self._room)

    def sizes(self) -> Int64s:
        """How many transitions each run holds, (runs,)."""
        return np.minimum(self.added, self.capacity)

    def add(self, rows: Int64s, transitions: Transitions) -> None:
        """Store one transition for each of the named runs (k,)."""
        if len(rows) and self.added[rows].max() >= self._room < self.capacity:
            self._grow()
        _store(rows, self.added, self.capacity, self._kept, transitions)

    def sample(self, rows: Int64s, uniforms: Float64s) -> Int64s:
        """Indices (k, batch) of transitions of the named runs (k,), uniformly, by numbers in [0, 1)."""
        sizes = self.sizes()[rows, None]
        # The product can round up to the size itself.
        return np.minimum((uniforms * sizes).astype(np.int64), np.maximum(sizes - 1, 0))

    def gather(self, rows: Int64s, indices: Int64s) -> Transitions:
        """The transitions at those indices (k, batch) of the named runs (k,); blank ones of a run that holds none."""
        drawn = Transitions(
            states=np.empty((2, *indices.shape), dtype=np.int64),
            actions=np.empty(indices.shape, dtype=np.int64),
            rewards=np.empty(indices.shape, dtype=np.float32),
            discounts=np.empty(indices.shape, dtype=np.float32),
        )
        _gather(rows, indices, self._kept, drawn)
        return drawn

    def added_since(self, marks: Int64s) -> dict[str, NDArray[Any]]:
        """What was added to each run since it had added so many (runs,): by name, run after run, oldest first.

        What has been overwritten since is left out.
        """
        begins = np.maximum(marks, self.added - self.sizes())
        counts = self.added - begins
        spans = self._spans(begins, counts)
        found = {
            name: np.concatenate([kept[run, span] for run, span in spans])
            for name, kept in self._kept._asdict().items()
        }
        return {"begins": begins, "counts": counts, **found}

    def extend(self, added: Mapping[str, NDArray[Any]]) -> None:
        """Add what ``added_since`` returned; KeyError or ValueError if the shape differs."""
        begins, counts = added["begins"], added["counts"]
        while self._room < min(int((begins + counts).max(initial=0)), self.capacity):
            self._grow()
        spans = self._spans(begins, counts)
        ends = np.cumsum([span.stop - span.start for _, span in spans])[:-1]
        for name, kept in self._kept._asdict().items():
            for (run, span), part in zip(spans, np.split(added[name], ends), strict=True):
                kept[run, span] = part
        self.added[:] = begins + counts

    def forget_since(self, marks: Int64s) -> None:
        """Forget what was added to each run since it had added so many (runs,).

        What it had overwritten is gone: a full run holds the transitions before it twice instead.
        """
        for run in np.flatnonzero((self.added > marks) & (self.added > self.capacity)):
            forgotten = np.arange(marks[run], self.added[run])
            for kept in self._kept:
                kept[run, forgotten % self.capacity] = kept[run, (forgotten - len(forgotten)) % self.capacity]
        self.added[:] = marks

    def _spans(self, begins: Int64s, counts: Int64s) -> list[tuple[int, slice]]:
        """Where each run's transitions from ``begins`` on are, oldest first: two spans, since they may wrap around."""
        spans = []
        for run, (begin, count) in enumerate(zip(begins % self.capacity, counts, strict=True)):
            behind = max(begin + count - self.capacity, 0)
            spans += [(run, slice(int(begin), int(begin + count - behind))), (run, slice(0, int(behind)))]
        return spans

    def _grow(self) -> None:
        room = min(2 * self._room, self.capacity)
        larger = self._memory(len(self.added), room)
        for old, new in zip(self._kept, larger, strict=True):
            new[:, : self._room] = old
        self._kept, self._room = larger, room

    def _memory(self, runs: int, room: int) -> Transitions:
        return Transitions(
            states=np.zeros((runs, room, 2), dtype=self._index_type),
            actions=np.zeros((runs, room), dtype=np.uint8),
            rewards=np.zeros((runs, room), dtype=np.float32),
            discounts=np.zeros((runs, room), dtype=np.float32),
        )


@njit(cache=True, error_model="numpy")
def _store(rows: Int64s, added: Int64s, capacity: int, kept: Transitions, new: Transitions) -> None:
    for at in range(len(rows)):
        row = rows[at]
        index = added[row] % capacity
        kept.states[row, index, 0] = new.states[0, at]
        kept.states[row, index, 1] = new.states[1, at]
        kept.actions[row, index] = new.actions[at]
        kept.rewards[row, index] = new.rewards[at]
        kept.discounts[row, index] = new.discounts[at]
        added[row] += 1


@njit(cache=True, error_model="numpy")
def _gather(rows: Int64s, indices: Int64s, kept: Transitions, drawn: Transitions) -> None:
    for at in range(len(rows)):
        row = rows[at]
        for column in range(indices.shape[1]):
            index = indices[at, column]
            drawn.states[0, at, column] = kept.states[row, index, 0]
            drawn.states[1, at, column] = kept.states[row, index, 1]
            drawn.actions[at, column] = kept.actions[row, index]
            drawn.rewards[at, column] = kept.rewards[row, index]
            drawn.discounts[at, column] = kept.discounts[row, index]
