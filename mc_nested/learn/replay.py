"""Uniform experience replay for many runs at once (paper, appendix: one million transitions, no priority)."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

FIRST_ROOM = 4096
"""Transitions a run that memory is taken for at first; it doubles as it fills."""


class Transitions(NamedTuple):
    """Transitions side by side, the leading axes being the caller's: whole states of small integers, as observed."""

    states: NDArray[np.integer[Any]]
    actions: NDArray[np.integer[Any]]
    rewards: NDArray[np.floating[Any]]
    next_states: NDArray[np.integer[Any]]
    terminated: NDArray[np.bool_]


class Replay:
    """The last ``capacity`` transitions of each run; a run's draws depend on its own transitions only.

    Args:
        runs: how many runs.
        width: integers in a state; each must fit 16 bits.
        capacity: transitions kept of each run; the oldest gives way.
    """

    def __init__(self, runs: int, width: int, capacity: int) -> None:
        self.capacity = capacity
        self.added = np.zeros(runs, dtype=np.int64)
        self._room = min(FIRST_ROOM, capacity)
        self._kept = self._memory(runs, width, self._room)

    def sizes(self) -> NDArray[np.int64]:
        """How many transitions each run holds, (runs,)."""
        return np.minimum(self.added, self.capacity)

    def add(self, rows: NDArray[np.int64], transitions: Transitions) -> None:
        """Store one transition for each of the named runs; leading axis (k,)."""
        if len(rows) and self.added[rows].max() >= self._room < self.capacity:
            self._grow()
        places = rows * self._room + self.added[rows] % self.capacity
        for kept, new in zip(self._kept, transitions, strict=True):
            _flat(kept)[places] = new
        self.added[rows] += 1

    def sample(self, rows: NDArray[np.int64], uniforms: NDArray[np.float64]) -> Transitions:
        """Draw from each of the named runs (k,) what the numbers in [0, 1) point at, (k, batch), with replacement."""
        sizes = self.sizes()[rows, None]
        places = rows[:, None] * self._room + np.minimum((uniforms * sizes).astype(np.int64), sizes - 1)
        return Transitions(*(_flat(kept).take(places, axis=0) for kept in self._kept))

    def state(self) -> dict[str, NDArray[Any]]:
        """Everything a later draw depends on, by name, copied; memory not yet filled left out."""
        filled = int(self.sizes().max(initial=0))
        return {"added": self.added, **{name: kept[:, :filled].copy() for name, kept in self._kept._asdict().items()}}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        filled = state["actions"].shape[1]
        while self._room < filled:
            self._grow()
        self.added[:] = state["added"]
        for name, kept in self._kept._asdict().items():
            kept[:, :filled] = state[name]

    def _grow(self) -> None:
        room = min(2 * self._room, self.capacity)
        runs, _, width = self._kept.states.shape
        larger = self._memory(runs, width, room)
        for old, new in zip(self._kept, larger, strict=True):
            new[:, : self._room] = old
        self._kept, self._room = larger, room

    @staticmethod
    def _memory(runs: int, width: int, room: int) -> Transitions:
        return Transitions(
            states=np.zeros((runs, room, width), dtype=np.int16),
            actions=np.zeros((runs, room), dtype=np.int16),
            rewards=np.zeros((runs, room), dtype=np.float32),
            next_states=np.zeros((runs, room, width), dtype=np.int16),
            terminated=np.zeros((runs, room), dtype=np.bool_),
        )


def _flat(kept: NDArray[Any]) -> NDArray[Any]:
    return kept.reshape(-1, *kept.shape[2:])
