"""Experience replay for many runs at once (paper, appendix: one million transitions, uniform)."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Float64s, Int64s, Integers
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.states import States

FIRST_ROOM = 4096
"""Transitions per run that memory is allocated for at first; it doubles when full."""


class Transitions(NamedTuple):
    """Transitions side by side, an array of each part in the caller's shape.

    ``states`` (2, …) holds every s and every s', as ``States`` gives them encoded; ``discounts`` is the factor of the
    value of s': γ, or 0 where the episode terminated.
    """

    states: Integers
    actions: Integers
    rewards: NDArray[Any]
    discounts: NDArray[Any]


class ReplayMark(NamedTuple):
    """A moment that a replay can be taken back to: the counts (runs,), and what the next additions overwrite.

    ``overwritten`` are k transitions, each at a run's place; the arrays of both are (k,).
    """

    added: Int64s
    steps: int
    runs: Int64s
    places: Int64s
    overwritten: Transitions


class Replay:
    """The last ``capacity`` transitions of each run; what a run samples depends on its own transitions only.

    Args:
        states: what the runs see and do, a row a run.
        capacity: transitions kept per run; the oldest is overwritten.
    """

    def __init__(self, states: States, capacity: int) -> None:
        self.capacity = capacity
        self.added = np.zeros(states.rows, dtype=np.int64)
        self._shape, self._state_type = states.shape, np.min_scalar_type(states.highest)
        self._action_type = np.min_scalar_type(states.actions - 1)
        self._room = min(FIRST_ROOM, capacity)
        self._kept = self._memory(states.rows, self._room)
        self._taken_back_to: list[Int64s] = []

    def sizes(self) -> Int64s:
        """Return how many transitions each run holds, (runs,)."""
        return np.minimum(self.added, self.capacity)

    def bytes_held(self) -> Int64s:
        """Return the bytes of the transitions that each run holds, (runs,); room not yet filled doesn't count."""
        held: Int64s = self.sizes() * sum(kept[0, 0].nbytes for kept in self._kept)
        return held

    def add(self, rows: Int64s, transitions: Transitions) -> None:
        """Store one transition for each of the named runs (k,)."""
        if _store(rows, self.added, self.capacity, tuple(self._kept), tuple(transitions)):
            self._make_room_for(self._room + 1)

    def add_several(self, row: int, transitions: Transitions) -> None:
        """Store transitions (k,) of one run, the oldest first."""
        rows = np.full(len(transitions.actions), row)
        self._make_room_for(int(self.added[row]) + len(rows) + 1)
        self.add(rows, transitions)

    def sample(self, rows: Int64s, uniforms: Float64s) -> Int64s:
        """Return indices (k, batch) of transitions of the named runs (k,), uniformly, by numbers in [0, 1)."""
        indices = np.empty(uniforms.shape, np.int64)
        _sample(rows, uniforms, self.added, self.capacity, indices)
        return indices

    def gather(self, rows: Int64s, indices: Int64s) -> Transitions:
        """Return the transitions at those indices (k, batch) of the named runs (k,).

        A run that holds none gives blank ones.
        """
        drawn = Transitions(
            states=np.empty((2, *indices.shape, *self._shape), self._state_type if self._shape else np.int64),
            actions=np.empty(indices.shape, dtype=np.int64),
            rewards=np.empty(indices.shape, dtype=np.float32),
            discounts=np.empty(indices.shape, dtype=np.float32),
        )
        _gather(rows, indices, tuple(self._kept), tuple(drawn))
        return drawn

    def marks(self) -> dict[str, Int64s]:
        """Return where a journal ends now, for ``added_since``: the counts (runs,), and how often it was taken back."""
        return {"added": self.added.copy(), "taken_back": np.array([len(self._taken_back_to)])}

    def added_since(self, marks: Mapping[str, Int64s] | None) -> dict[str, NDArray[Any]]:
        """Return what was added since those marks, for ``extend``: by name, run after run, oldest first.

        Without marks, that is everything. What was overwritten since is left out. Where the replay was taken back to
        before the marks, it begins there.
        """
        oldest = self.added - self.sizes()
        begins = oldest if marks is None else np.maximum(self._known_since(marks), oldest)
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
        self._make_room_for(int((begins + counts).max(initial=0)) + 1)
        spans = self._spans(begins, counts)
        ends = np.cumsum([span.stop - span.start for _, span in spans])[:-1]
        for name, kept in self._kept._asdict().items():
            for (run, span), part in zip(spans, np.split(added[name], ends), strict=True):
                kept[run, span] = part
        self.added[:] = begins + counts

    def mark(self, steps: int) -> ReplayMark:
        """Mark this moment, for ``take_back`` after at most so many additions a run."""
        counts = self.added[:, None] + np.arange(steps)
        overwriting = (counts >= self.capacity) & (counts - self.capacity < self.added[:, None])
        runs, places = np.nonzero(overwriting)[0], counts[overwriting] % self.capacity
        overwritten = Transitions(*(kept[runs, places] for kept in self._kept))
        return ReplayMark(self.added.copy(), steps, runs, places, overwritten)

    def take_back(self, mark: ReplayMark) -> None:
        """Hold exactly what was held at that mark; ValueError if more was added since than it was made for."""
        if (self.added - mark.added).max(initial=0) > mark.steps:
            raise ValueError(f"more than {mark.steps} additions since the mark")
        for kept, before in zip(self._kept, mark.overwritten, strict=True):
            kept[mark.runs, mark.places] = before
        self.added[:] = mark.added
        self._taken_back_to.append(mark.added)

    def _known_since(self, marks: Mapping[str, Int64s]) -> Int64s:
        """Return from which count on each run's transitions may differ from those at the marks, (runs,)."""
        lowest: Int64s = np.min([marks["added"], *self._taken_back_to[int(marks["taken_back"][0]) :]], axis=0)
        # The forgotten transitions had overwritten the oldest, which are held again, so a journal brings those, too.
        overwrote = (marks["added"] > self.added) & (marks["added"] > self.capacity)
        return np.where(overwrote, 0, lowest)

    def _spans(self, begins: Int64s, counts: Int64s) -> list[tuple[int, slice]]:
        """Return where each run's transitions from ``begins`` on are, oldest first: two spans, since they may wrap."""
        spans = []
        for run, (begin, count) in enumerate(zip(begins % self.capacity, counts, strict=True)):
            behind = max(begin + count - self.capacity, 0)
            spans += [(run, slice(int(begin), int(begin + count - behind))), (run, slice(0, int(behind)))]
        return spans

    def _make_room_for(self, added: int) -> None:
        """Make room for so many additions to a run, as far as the capacity allows."""
        room = self._room
        while room < min(added, self.capacity):
            room = min(2 * room, self.capacity)
        if room > self._room:
            larger = self._memory(len(self.added), room)
            for old, new in zip(self._kept, larger, strict=True):
                new[:, : self._room] = old
            self._kept, self._room = larger, room

    def _memory(self, runs: int, room: int) -> Transitions:
        return Transitions(
            states=np.zeros((runs, room, 2, *self._shape), dtype=self._state_type),
            actions=np.zeros((runs, room), dtype=self._action_type),
            rewards=np.zeros((runs, room), dtype=np.float32),
            discounts=np.zeros((runs, room), dtype=np.float32),
        )


@compiled()
def _store(rows: Int64s, added: Int64s, capacity: int, memory: tuple[Any, ...], given: tuple[Any, ...]) -> bool:
    """Do ``Replay.add`` for Transitions, where there is room; return whether a run fills its room now.

    Compiled code takes over a plain tuple in a third of the time that a named one takes.
    """
    kept, new = Transitions(*memory), Transitions(*given)
    full = False
    for at in range(len(rows)):
        row = rows[at]
        index = added[row] % capacity
        kept.states[row, index, 0] = new.states[0, at]
        kept.states[row, index, 1] = new.states[1, at]
        kept.actions[row, index] = new.actions[at]
        kept.rewards[row, index] = new.rewards[at]
        kept.discounts[row, index] = new.discounts[at]
        added[row] += 1
        full = full or added[row] == kept.actions.shape[1]
    return full


@compiled()
def _sample(rows: Int64s, uniforms: Float64s, added: Int64s, capacity: int, indices: Int64s) -> None:
    for at in range(len(rows)):
        size = min(added[rows[at]], capacity)
        for column in range(uniforms.shape[1]):
            # The product can round up to the size itself.
            indices[at, column] = min(int(uniforms[at, column] * size), max(size - 1, 0))


@compiled()
def _gather(rows: Int64s, indices: Int64s, memory: tuple[Any, ...], wanted: tuple[Any, ...]) -> None:
    kept, drawn = Transitions(*memory), Transitions(*wanted)
    for at in range(len(rows)):
        row = rows[at]
        for column in range(indices.shape[1]):
            index = indices[at, column]
            drawn.states[0, at, column] = kept.states[row, index, 0]
            drawn.states[1, at, column] = kept.states[row, index, 1]
            drawn.actions[at, column] = kept.actions[row, index]
            drawn.rewards[at, column] = kept.rewards[row, index]
            drawn.discounts[at, column] = kept.discounts[row, index]
