"""Experience replay for many runs at once (paper, appendix: one million transitions, uniform)."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

FIRST_ROOM = 4096
"""Transitions a run that memory is taken for at first; it doubles as it fills."""


class Transitions(NamedTuple):
    """Transitions side by side, an array of each part in the caller's shape.

    ``states`` (2, …) holds every s and every s', as numbers (states.py); ``discounts`` is what the value of s' counts:
    γ, or 0 where the episode terminated.
    """

    states: NDArray[np.integer[Any]]
    actions: NDArray[np.integer[Any]]
    rewards: NDArray[Any]
    discounts: NDArray[Any]


class Replay:
    """The last ``capacity`` transitions of each run; a run's draws depend on its own transitions only.

    Args:
        runs: how many runs.
        states: how many states there are: the numbers below it.
        capacity: transitions kept of each run; the oldest gives way.
    """

    def __init__(self, runs: int, states: int, capacity: int) -> None:
        self.capacity = capacity
        self.added = np.zeros(runs, dtype=np.int64)
        self._number = np.min_scalar_type(states)
        self._room = min(FIRST_ROOM, capacity)
        self._kept = self._memory(runs, self._room)

    def sizes(self) -> NDArray[np.int64]:
        """How many transitions each run holds, (runs,)."""
        return np.minimum(self.added, self.capacity)

    def add(self, rows: NDArray[np.int64], transitions: Transitions) -> None:
        """Store one transition for each of the named runs (k,)."""
        if len(rows) and self.added[rows].max() >= self._room < self.capacity:
            self._grow()
        _store(rows, self.added, self.capacity, self._kept, transitions)

    def draw(self, rows: NDArray[np.int64], uniforms: NDArray[np.float64]) -> NDArray[np.int64]:
        """Places that the numbers in [0, 1) point at, (k, batch), each of the named runs' (k,) as likely as another."""
        sizes = self.sizes()[rows, None]
        # The product can round up to the size itself.
        return np.minimum((uniforms * sizes).astype(np.int64), np.maximum(sizes - 1, 0))

    def at(self, rows: NDArray[np.int64], places: NDArray[np.int64]) -> Transitions:
        """The transitions at those places (k, batch) of the named runs (k,); blank ones of a run that holds none."""
        drawn = Transitions(
            states=np.empty((2, *places.shape), dtype=np.int64),
            actions=np.empty(places.shape, dtype=np.int64),
            rewards=np.empty(places.shape, dtype=np.float32),
            discounts=np.empty(places.shape, dtype=np.float32),
        )
        _gather(rows, places, self._kept, drawn)
        return drawn

    def added_since(self, marks: NDArray[np.int64]) -> dict[str, NDArray[Any]]:
        """What was added to each run since it had added so many (runs,), by name, oldest first and run behind run.

        What has already given way is left out.
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
        """Take back what ``added_since`` gave; KeyError or ValueError where it is of another shape."""
        begins, counts = added["begins"], added["counts"]
        while self._room < min(int((begins + counts).max(initial=0)), self.capacity):
            self._grow()
        spans = self._spans(begins, counts)
        ends = np.cumsum([span.stop - span.start for _, span in spans])[:-1]
        for name, kept in self._kept._asdict().items():
            for (run, span), part in zip(spans, np.split(added[name], ends), strict=True):
                kept[run, span] = part
        self.added[:] = begins + counts

    def forget_since(self, marks: NDArray[np.int64]) -> None:
        """Forget what was added to each run since it had added so many (runs,).

        What had given way for it is gone: a full run holds its last ones before twice instead.
        """
        for run in np.flatnonzero((self.added > marks) & (self.added > self.capacity)):
            forgotten = np.arange(marks[run], self.added[run])
            for kept in self._kept:
                kept[run, forgotten % self.capacity] = kept[run, (forgotten - len(forgotten)) % self.capacity]
        self.added[:] = marks

    def _spans(self, begins: NDArray[np.int64], counts: NDArray[np.int64]) -> list[tuple[int, slice]]:
        """Where each run's transitions from ``begins`` on lie, oldest first: in two spans where they wrap round."""
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
            states=np.zeros((runs, room, 2), dtype=self._number),
            actions=np.zeros((runs, room), dtype=np.uint8),
            rewards=np.zeros((runs, room), dtype=np.float32),
            discounts=np.zeros((runs, room), dtype=np.float32),
        )


@njit(cache=True, error_model="numpy")
def _store(
    rows: NDArray[np.int64], added: NDArray[np.int64], capacity: int, kept: Transitions, new: Transitions
) -> None:
    for at in range(len(rows)):
        row = rows[at]
        place = added[row] % capacity
        kept.states[row, place, 0] = new.states[0, at]
        kept.states[row, place, 1] = new.states[1, at]
        kept.actions[row, place] = new.actions[at]
        kept.rewards[row, place] = new.rewards[at]
        kept.discounts[row, place] = new.discounts[at]
        added[row] += 1


@njit(cache=True, error_model="numpy")
def _gather(rows: NDArray[np.int64], places: NDArray[np.int64], kept: Transitions, drawn: Transitions) -> None:
    for at in range(len(rows)):
        row = rows[at]
        for column in range(places.shape[1]):
            place = places[at, column]
            drawn.states[0, at, column] = kept.states[row, place, 0]
            drawn.states[1, at, column] = kept.states[row, place, 1]
            drawn.actions[at, column] = kept.actions[row, place]
            drawn.rewards[at, column] = kept.rewards[row, place]
            drawn.discounts[at, column] = kept.discounts[row, place]
