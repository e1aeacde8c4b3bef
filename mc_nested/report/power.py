"""How many trials would decide a claim, if what was measured were so: with a power of 0.8, at the level of its verdict.

An estimate from few trials is rough, and so is the number that follows from it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy import stats
from scipy.special import comb

from mc_nested.arrays import Float64s, Int64s
from mc_nested.report.inference import ALPHA

POWER = 0.8

MOST_TRIALS = 1000
"""Nobody trains more."""


class Effect(Protocol):
    """How large is what a line of a claim says, and how often so many trials would show it."""

    @property
    def speaks_for(self) -> bool:
        """Whether it is as the claim says."""

    def power_for(self, trials: Int64s, alpha: float) -> Float64s:
        """The chance that a test at that level shows it, for each number of trials (n,)."""

    def power_against(self, trials: Int64s, alpha: float) -> Float64s:
        """The chance that a test at that level shows its opposite, for each number of trials (n,)."""


@dataclass(frozen=True)
class MeanEffect:
    """A sum of means beside what it is tested against, by Welch's t.

    Args:
        above: how far it is above what it has to be above.
        below: how far it is below what it has to be below for the opposite.
        spreads: the standard deviation of each group's trials, times its weight in the sum.
    """

    above: float
    below: float
    spreads: tuple[float, ...]

    @property
    def speaks_for(self) -> bool:
        return self.above > 0

    def power_for(self, trials: Int64s, alpha: float) -> Float64s:
        return self._power(self.above, trials, alpha)

    def power_against(self, trials: Int64s, alpha: float) -> Float64s:
        return self._power(self.below, trials, alpha)

    def _power(self, distance: float, trials: Int64s, alpha: float) -> Float64s:
        # A permutation test can't be below the share of one split among all.
        is_possible = 1 / comb(2 * trials, trials) < alpha
        parts = np.array([spread**2 for spread in self.spreads])
        if not parts.sum():
            return np.where(is_possible, float(distance > 0), 0.0)
        freedom = parts.sum() ** 2 / (parts**2).sum() * (trials - 1)
        distances = distance / np.sqrt(parts.sum() / trials)
        found = stats.nct.sf(stats.t.ppf(1 - alpha, freedom), freedom, distances)
        # So far out that the power is 0 or 1, scipy's noncentral t isn't finite.
        power: Float64s = np.where(is_possible, np.where(np.isfinite(found), found, distance > 0), 0.0)
        return power


@dataclass(frozen=True)
class ShareEffect:
    """A share of trials beside one half, by the exact binomial test."""

    share: float

    @property
    def speaks_for(self) -> bool:
        return self.share > 0.5

    def power_for(self, trials: Int64s, alpha: float) -> Float64s:
        return _shown(self.share, trials, alpha)

    def power_against(self, trials: Int64s, alpha: float) -> Float64s:
        return _shown(1 - self.share, trials, alpha)


def deciding_trials(effects: Sequence[Effect]) -> int | None:
    """How many trials of each agent would decide a claim of these lines; None if more than MOST_TRIALS, or no line.

    If all lines speak for it: so many that all of them are shown. Otherwise so many that the opposite of one is, at
    the level that is left to each by Bonferroni's correction. The lines are taken to be independent.
    """
    if not effects:
        return None
    trials = np.arange(2, MOST_TRIALS + 1)
    if all(effect.speaks_for for effect in effects):
        power = np.prod([effect.power_for(trials, ALPHA) for effect in effects], axis=0)
    else:
        level = ALPHA / len(effects)
        against = [effect.power_against(trials, level) for effect in effects if not effect.speaks_for]
        power = 1 - np.prod([1 - each for each in against], axis=0)
    enough = np.flatnonzero(power >= POWER)
    return int(trials[enough[0]]) if len(enough) else None


def _shown(share: float, trials: Int64s, alpha: float) -> Float64s:
    """The chance that so many trials, each a success with that probability, show that it is above one half."""
    least = stats.binom.isf(alpha, trials, 0.5) + 1  # successes: with fewer, p is alpha or more
    return np.asarray(stats.binom.sf(least - 1, trials, share), dtype=np.float64)
