"""How many trials would decide a claim if the measured effect were true: with a power of 0.8, at the verdict's level.

An estimate from few trials is rough, and so is the number that follows from it.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import stats

from mc_nested.arrays import Float64s, Int64s
from mc_nested.studies.inference import ALPHA

POWER = 0.8

MOST_TRIALS = 1000
"""The most trials that are considered: nobody trains more."""


@dataclass(frozen=True)
class MeanEffect:
    """A mean difference within pairs beside what it is tested against, by Student's t.

    A sign-flip test decides, which few trials don't allow. Without spread that is sure from enough trials on.

    Args:
        above: how far it is above what it is tested against, negative if it is below.
        spread: the standard deviation of the differences.
    """

    above: float
    spread: float

    @property
    def opposite(self) -> "MeanEffect":
        """The same, seen from the opposite of what is tested."""
        return MeanEffect(-self.above, self.spread)

    def power(self, trials: Int64s, alpha: float) -> Float64s:
        """Return the chance that a test at that level shows it, for each number of trials (n,)."""
        # No p can be below the share of one choice of the signs among all.
        is_possible = 0.5**trials < alpha
        if not self.spread:
            return np.where(is_possible, float(self.above > 0), 0.0)
        distances = self.above / (self.spread / np.sqrt(trials))
        found = stats.nct.sf(stats.t.ppf(1 - alpha, trials - 1), trials - 1, distances)
        # So far out that the power is 0 or 1, scipy's noncentral t isn't finite.
        return np.where(is_possible, np.where(np.isfinite(found), found, self.above > 0), 0.0)


@dataclass(frozen=True)
class ShareEffect:
    """A share of trials beside one half, by the exact binomial test."""

    share: float

    @property
    def opposite(self) -> "ShareEffect":
        """The share of the other trials."""
        return ShareEffect(1 - self.share)

    def power(self, trials: Int64s, alpha: float) -> Float64s:
        """Return the chance that it is shown to be above one half, as ``MeanEffect.power``."""
        least = stats.binom.isf(alpha, trials, 0.5) + 1  # successes: with fewer, p is alpha or more
        return np.asarray(stats.binom.sf(least - 1, trials, self.share), dtype=np.float64)


TestedEffect = MeanEffect | ShareEffect
"""How large is what a line of a claim says."""


def deciding_trials(effects: Sequence[TestedEffect]) -> int | None:
    """Return from how many trials of each agent on a claim of these lines is decided; None if more than MOST_TRIALS.

    It is decided where all lines are shown, or the opposite of any is, at the level that is left to each by
    Bonferroni's correction. The lines are taken to be independent. None, too, of no line.
    """
    if not effects:
        return None
    trials = np.arange(2, MOST_TRIALS + 1)
    shown = np.prod([effect.power(trials, ALPHA) for effect in effects], axis=0)
    level = ALPHA / len(effects)
    opposed = 1 - np.prod([1 - effect.opposite.power(trials, level) for effect in effects], axis=0)
    # A share's power rises in a saw-tooth: the number counts from where the power stays above.
    too_few = np.flatnonzero(np.minimum(shown + opposed, 1.0) < POWER)
    if not len(too_few):
        return int(trials[0])
    return int(trials[too_few[-1]]) + 1 if too_few[-1] + 1 < len(trials) else None
