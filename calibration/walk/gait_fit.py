"""Fit a player's walk to holds that were followed on the screen: the push of a tick, and the inertia.

A hold of so many seconds is felt by a whole number of ticks, that number or one more or less. So each hold is compared
with the paths of so many ticks (FACTS: Walking) and matched with the nearest one. Push and inertia are those with which
all holds lie near their paths. Every position seen counts, not only the last one.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import fmin

from mc_nested.arrays import Float64s
from mc_nested.errors import NotConfirmedError
from mc_nested.live.model.kinematics import TICK_S, Gait, hold_path, hold_paths

OUTLIER_BLOCKS = 0.01
"""A hold so many blocks off its path isn't one of whole ticks: lag, a lost key or a push came in between."""

MORE_OR_LESS = 2
"""By how many ticks a hold may be felt longer or shorter than it was."""

FEWEST = 8
"""Holds of a gait that a fit needs, at least three times as many as it has unknowns."""

_INERTIAS = np.arange(0.30, 0.96, 0.02)
_SPEEDS = np.arange(0.92, 1.181, 0.01)
"""The grid of first guesses: the inertia, and the steady step relative to what the holds cover per tick. That is less
than a steady step, since the last part of the coasting doesn't happen."""

_FIRST, _GUESSES = 20, 6
"""Holds that are enough for first guesses, and how many of those guesses are refined."""

_OUTLIER = 0.02
"""Blocks at which the error of a position that fits no path is capped."""


@dataclass(frozen=True)
class HoldTrace:
    """A hold from rest: its gait, how long the key was down, and the positions seen, in blocks along its direction.

    ``covered`` grows; its last value is where the player came to a stop.
    """

    gait: Gait
    held_s: float
    covered: tuple[float, ...]


@dataclass(frozen=True)
class GaitModel:
    """Blocks that a held key adds to each tick's step, and the share of a step that is left after a tick."""

    push: float
    inertia: float

    @property
    def steady(self) -> float:
        """Blocks a tick of steady walking."""
        return self.push / (1 - self.inertia)

    def path(self, ticks: int) -> tuple[float, ...]:
        """Return the position after each tick of a hold from rest, in blocks from its beginning, until standstill."""
        return hold_path(ticks, self.push, self.inertia)

    def paths(self, most: int) -> list[tuple[float, ...]]:
        """Return the paths of the holds of 0 to ``most`` ticks."""
        return hold_paths(most, self.push, self.inertia)

    def covered(self, ticks: int) -> float:
        """Return the blocks that a hold of so many ticks covers until standstill."""
        return self.path(ticks)[-1]


@dataclass(frozen=True)
class MatchedHold:
    """A trace with the nearest path: the path's ticks, and the errors of its positions (RMS) and its end, in blocks.

    ``at_tick`` says after how many ticks each of its positions was reached.
    """

    trace: HoldTrace
    ticks: int
    at_tick: tuple[int, ...]
    rms_error: float
    end_error: float

    @property
    def is_outlier(self) -> bool:
        """Whether it is no hold of whole ticks."""
        return self.ticks == 0 or self.rms_error > OUTLIER_BLOCKS or abs(self.end_error) > OUTLIER_BLOCKS


def match_hold(trace: HoldTrace, model: GaitModel) -> MatchedHold:
    """Return the path of whole ticks nearest a trace; ``end_error`` is positive if the trace ended farther than it."""
    asked = round(trace.held_s / TICK_S)
    around = range(max(0, asked - MORE_OR_LESS), asked + MORE_OR_LESS + 1)
    return min((_match_path(trace, model, ticks) for ticks in around), key=lambda match: match.rms_error)


def fit_gait(traces: Sequence[HoldTrace], inertia: float | None = None) -> GaitModel:
    """Return the model of one gait's traces; with a known ``inertia`` only the push is fitted.

    Outliers are left out of the fit.

    Raises:
        NotConfirmedError: fewer than ``FEWEST`` of the traces are holds of whole ticks.
    """
    if len(traces) < FEWEST:
        raise NotConfirmedError(_too_few(len(traces)))
    few = _FitProblem(traces[:: max(1, len(traces) // _FIRST)])
    guesses = _first_guesses(few, _steady_in(traces), inertia)
    model = min((_refined(few, guess, inertia) for guess in guesses), key=_FitProblem(traces).cost)
    good = [trace for trace in traces if not match_hold(trace, model).is_outlier]
    if len(good) < FEWEST:
        raise NotConfirmedError(_too_few(len(good)))
    return _refined(_FitProblem(good), model, inertia)


def rms(values: Sequence[float]) -> float:
    """Return the root of the mean square; 0 for no values."""
    return float(np.sqrt(np.mean(np.square(values)))) if values else 0.0


def _match_path(trace: HoldTrace, model: GaitModel, ticks: int) -> MatchedHold:
    path = np.array(model.path(ticks))
    seen = np.array(trace.covered)
    nearest = np.abs(seen[:, np.newaxis] - path).argmin(1)
    end_error = float(seen[-1] - path[-1])
    rms_error = rms([*(seen - path[nearest]), end_error])
    return MatchedHold(trace, ticks, tuple(int(index) for index in nearest), rms_error, end_error)


def _steady_in(traces: Sequence[HoldTrace]) -> float:
    """Return the blocks that the longer holds cover per tick."""
    longer = sorted(traces, key=lambda trace: trace.held_s)[len(traces) // 3 :]
    return float(np.median([trace.covered[-1] / trace.held_s * TICK_S for trace in longer]))


def _first_guesses(problem: "_FitProblem", steady: float, inertia: float | None) -> list[GaitModel]:
    """Return the best few of a grid around a steady step, each with an inertia of its own."""
    inertias = _INERTIAS if inertia is None else (inertia,)
    models = [
        min((GaitModel(float(steady * speed * (1 - left)), float(left)) for speed in _SPEEDS), key=problem.cost)
        for left in inertias
    ]
    return sorted(models, key=problem.cost)[:_GUESSES]


def _refined(problem: "_FitProblem", model: GaitModel, inertia: float | None) -> GaitModel:
    def model_of(unknowns: Float64s) -> GaitModel:
        left = min(0.99, max(0.01, float(unknowns[1]))) if inertia is None else inertia
        return GaitModel(float(unknowns[0]) * (1 - left), left)

    def cost(unknowns: Float64s) -> float:
        return problem.cost(model_of(unknowns))

    start = [model.steady, model.inertia] if inertia is None else [model.steady]
    found = fmin(cost, start, xtol=1e-6, ftol=1e-10, disp=False)
    return model_of(np.asarray(found, np.float64))


class _FitProblem:
    """Traces laid out as arrays, to compare all of them with a model at once."""

    def __init__(self, traces: Sequence[HoldTrace]) -> None:
        asked = np.array([round(trace.held_s / TICK_S) for trace in traces])
        self._candidates = np.maximum(0, asked[:, np.newaxis] + np.arange(-MORE_OR_LESS, MORE_OR_LESS + 1))
        self._most = int(self._candidates.max())
        self._positions = np.concatenate([np.array(trace.covered) for trace in traces])
        lengths = [len(trace.covered) for trace in traces]
        self._of_positions = self._candidates[np.repeat(np.arange(len(traces)), lengths)]
        self._starts = np.cumsum([0, *lengths[:-1]])
        self._ends = np.array([trace.covered[-1] for trace in traces])

    def cost(self, model: GaitModel) -> float:
        """Return the mean square error, each position capped, between the traces and their nearest paths."""
        paths = model.paths(self._most)
        longest = max(map(len, paths))
        # A path stays where it ends.
        table = np.array([path + path[-1:] * (longest - len(path)) for path in paths])
        # This is done thousands of times: in place, and the nearest over the first axis, which is the quick one.
        off = np.take(table.T.copy(), self._of_positions, axis=1)
        np.abs(np.subtract(off, self._positions[:, np.newaxis], out=off), out=off)
        errors = off.min(0)
        squares = np.minimum(errors, _OUTLIER) ** 2
        of_positions = np.add.reduceat(squares, self._starts, axis=0)
        of_ends = np.minimum(np.abs(table[self._candidates, -1] - self._ends[:, np.newaxis]), _OUTLIER) ** 2
        return float((of_positions + of_ends).min(1).sum() / (len(self._positions) + len(self._ends)))


def _too_few(count: int) -> str:
    return (
        f"only {count} holds of one gait could be followed, {FEWEST} are needed: does the game lag, or did something "
        "push you? Close other programs, and calibrate again"
    )
