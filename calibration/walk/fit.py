"""How a player walks, fitted to holds that were followed on the screen: the push of a tick, and what it leaves.

A hold of so many seconds is felt by a whole number of ticks, that number or one more or less. So each hold is laid
beside the paths of so many ticks (FACTS: Walking), and goes with the one it lies nearest; push and inertia are those
with which all of them lie near. Every place seen on the way counts, not only the last one.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import fmin

from mc_nested.errors import NotConfirmedError
from mc_nested.live.walk import STANDSTILL, TICK_S, Gait

Numbers = NDArray[np.float64]

SPOILED = 0.01
"""Blocks off its path at which a hold is no hold of whole ticks: lag, a lost key or a push came in between."""

MORE_OR_LESS = 2
"""Ticks that a hold may be felt longer or shorter than it was."""

FEWEST = 8
"""Holds of a gait that a fit needs, three times as many as it has unknowns."""

_INERTIAS = np.arange(0.30, 0.96, 0.02)
_SPEEDS = np.arange(0.92, 1.181, 0.01)
"""Where a fit begins to look: what a tick leaves, and the steady step as a part of what the holds cover a tick. That is
less than a steady step, since the last of the coasting doesn't happen."""

_FIRST, _GUESSES = 20, 6
"""Holds that are enough for first guesses, and how many of those are followed up."""

_OUTLIER = 0.02
"""Blocks beyond which a place that fits no path counts no more than this."""


@dataclass(frozen=True)
class Track:
    """A hold from rest: its gait, how long the key was down, and the places seen, in blocks along its way.

    ``covered`` grows; its last is where the player came to a stop.
    """

    gait: Gait
    held_s: float
    covered: tuple[float, ...]


@dataclass(frozen=True)
class Pace:
    """Blocks that a tick of a held key adds to a step, and what a tick leaves of one."""

    push: float
    inertia: float

    @property
    def steady(self) -> float:
        """Blocks a tick of somebody who walks on and on."""
        return self.push / (1 - self.inertia)

    def path(self, ticks: int) -> tuple[float, ...]:
        """The place after each tick of a hold from rest, in blocks from its beginning, until standstill."""
        places, place, step = [0.0], 0.0, 0.0
        while len(places) <= ticks or step >= STANDSTILL:
            step = (step if step >= STANDSTILL else 0.0) + (self.push if len(places) <= ticks else 0.0)
            place += step
            places.append(place)
            step *= self.inertia
        return tuple(places)

    def covered(self, ticks: int) -> float:
        """Blocks that a hold of so many ticks covers until standstill."""
        return self.path(ticks)[-1]


@dataclass(frozen=True)
class Matched:
    """A track beside the path that it lies nearest: its ticks, and how far off its places and its end lie, in blocks.

    ``at_tick`` says after how many ticks each of its places was reached.
    """

    track: Track
    ticks: int
    at_tick: tuple[int, ...]
    off: float
    end_off: float

    @property
    def is_spoiled(self) -> bool:
        """Whether it is no hold of whole ticks."""
        return self.ticks == 0 or self.off > SPOILED or abs(self.end_off) > SPOILED


def matched(track: Track, pace: Pace) -> Matched:
    """The path of whole ticks that a track lies nearest; positive where it ended farther than that."""
    asked = round(track.held_s / TICK_S)
    ways = [_beside(track, pace, ticks) for ticks in range(max(0, asked - MORE_OR_LESS), asked + MORE_OR_LESS + 1)]
    return min(ways, key=lambda way: way.off)


def fit(tracks: Sequence[Track], inertia: float | None = None) -> Pace:
    """The pace of tracks of one gait; with an ``inertia`` that is known, only the push is looked for.

    Spoiled tracks are left out of it.

    Raises:
        NotConfirmedError: fewer than ``FEWEST`` of the tracks are holds of whole ticks.
    """
    if len(tracks) < FEWEST:
        raise NotConfirmedError(_too_few(len(tracks)))
    few = _Held(tracks[:: max(1, len(tracks) // _FIRST)])
    guesses = _first_guesses(few, _steady_in(tracks), inertia)
    pace = min((_refined(few, guess, inertia) for guess in guesses), key=_Held(tracks).cost)
    good = [track for track in tracks if not matched(track, pace).is_spoiled]
    if len(good) < FEWEST:
        raise NotConfirmedError(_too_few(len(good)))
    return _refined(_Held(good), pace, inertia)


def rms(values: Sequence[float]) -> float:
    """The root of the mean square."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else 0.0


def _beside(track: Track, pace: Pace, ticks: int) -> Matched:
    path = np.array(pace.path(ticks))
    seen = np.array(track.covered)
    nearest = np.abs(seen[:, np.newaxis] - path).argmin(1)
    end_off = float(seen[-1] - path[-1])
    off = rms([*(seen - path[nearest]), end_off])
    return Matched(track, ticks, tuple(int(index) for index in nearest), off, end_off)


def _steady_in(tracks: Sequence[Track]) -> float:
    """Blocks that the longer holds cover a tick."""
    longer = sorted(tracks, key=lambda track: track.held_s)[len(tracks) // 3 :]
    return float(np.median([track.covered[-1] / track.held_s * TICK_S for track in longer]))


def _first_guesses(held: "_Held", steady: float, inertia: float | None) -> list[Pace]:
    """The best few of a grid around a steady step, each with an inertia of its own."""
    inertias = _INERTIAS if inertia is None else (inertia,)
    paces = [
        min((Pace(float(steady * speed * (1 - left)), float(left)) for speed in _SPEEDS), key=held.cost)
        for left in inertias
    ]
    return sorted(paces, key=held.cost)[:_GUESSES]


def _refined(held: "_Held", pace: Pace, inertia: float | None) -> Pace:
    def pace_of(unknown: Numbers) -> Pace:
        left = min(0.99, max(0.01, float(unknown[1]))) if inertia is None else inertia
        return Pace(float(unknown[0]) * (1 - left), left)

    def cost(unknown: Numbers) -> float:
        return held.cost(pace_of(unknown))

    start = [pace.steady, pace.inertia] if inertia is None else [pace.steady]
    found = fmin(cost, start, xtol=1e-6, ftol=1e-10, disp=False)
    return pace_of(np.asarray(found, np.float64))


class _Held:
    """Tracks laid out for comparing all of them with a pace at once."""

    def __init__(self, tracks: Sequence[Track]) -> None:
        asked = np.array([round(track.held_s / TICK_S) for track in tracks])
        self._candidates = np.maximum(0, asked[:, np.newaxis] + np.arange(-MORE_OR_LESS, MORE_OR_LESS + 1))
        self._most = int(self._candidates.max())
        self._places = np.concatenate([np.array(track.covered) for track in tracks])
        lengths = [len(track.covered) for track in tracks]
        self._owner = np.repeat(np.arange(len(tracks)), lengths)
        self._starts = np.cumsum([0, *lengths[:-1]])
        self._ends = np.array([track.covered[-1] for track in tracks])

    def cost(self, pace: Pace) -> float:
        """Mean square, each place capped, of what lies between the tracks and the paths that they lie nearest."""
        paths = [pace.path(ticks) for ticks in range(self._most + 1)]
        longest = max(len(path) for path in paths)
        # A path stays where it ends.
        table = np.array([[*path, *[path[-1]] * (longest - len(path))] for path in paths])
        rows = table[self._candidates[self._owner]]
        off = np.abs(rows - self._places[:, np.newaxis, np.newaxis]).min(2)
        squares = np.minimum(off, _OUTLIER) ** 2
        of_places = np.add.reduceat(squares, self._starts, axis=0)
        ends = np.minimum(np.abs(table[self._candidates, -1] - self._ends[:, np.newaxis]), _OUTLIER) ** 2
        return float((of_places + ends).min(1).sum() / (len(self._places) + len(self._ends)))


def _too_few(count: int) -> str:
    return (
        f"only {count} holds of one gait could be followed, {FEWEST} are needed: does the game lag, or did something "
        "push you? Close other programs, and calibrate again"
    )
