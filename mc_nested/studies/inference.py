"""Tests and intervals over trials, as pure functions: the same trials give the same figures to the bit.

Trials of two agents with one number are a pair. They share the seed's random numbers, and nested and hierarchical the
first weights of the main network, too: on the zigzag their early scores are correlated
(tests/studies/test_pairs.py). So what is tested is the difference within each pair. Where the agents don't differ, it
is as likely to be above 0 as below: a sign-flip test (Fisher, 1935) asks how many choices of the signs give as high a
mean. The intervals are Student's t.
"""

import itertools
from collections.abc import Sequence
from functools import cache
from typing import NamedTuple

import numpy as np
from scipy import stats

from mc_nested.arrays import Float64s
from mc_nested.report.curve import t_interval

ALPHA = 0.05
"""The significance level of each claim's verdict."""

RESAMPLES = 9_999
"""Choices of the signs where there are more than these, else all; resamples of a bootstrap."""

SIMULATED = 2_000
"""Experiments from which an interval's coverage is told."""

DECIMALS = 10
"""Of a difference: pairs that differ by rounding alone are the same."""


class Interval(NamedTuple):
    """A 95 % interval."""

    low: float
    high: float


class Tails(NamedTuple):
    """The p-values of a claim.

    A small ``claim`` speaks for it, a small ``against`` speaks against it, a small ``small`` says that the difference
    is less than a margin either way; None where there is no margin.
    """

    claim: float
    against: float
    small: float | None = None


def exceeds(differences: Float64s, than: float = 0.0) -> float:
    """Return the one-sided p of a sign-flip test that the mean of the differences (pairs,) is above ``than``.

    Exact where all choices of the signs are gone through. Differences that are all ``than`` give 1.
    """
    beyond = np.round(differences - than, DECIMALS)
    # A tenth of what makes a difference: sums in another order tie.
    as_high = _signs(len(beyond)) @ beyond >= beyond.sum() - 0.1 * 10.0**-DECIMALS
    return float(as_high.mean())


@cache
def _signs(pairs: int) -> Float64s:
    """Return choices of the signs (choices, pairs): all, or so many drawn ones; the first changes none."""
    if 2**pairs <= RESAMPLES + 1:
        return np.array(list(itertools.product((1.0, -1.0), repeat=pairs)))
    signs = np.random.default_rng(0).choice([-1.0, 1.0], (RESAMPLES + 1, pairs))
    signs[0] = 1.0
    return signs


def within(differences: Float64s, margin: float) -> float:
    """Return the p that the mean of the differences (pairs,) is less than ``margin`` either way, by two tests."""
    return max(exceeds(differences, -margin), exceeds(-differences, -margin))


def ahead(differences: Float64s, margin: float | None = None) -> Tails:
    """Test whether the mean of the differences (pairs,) is above 0, or below; and whether it is small."""
    small = None if margin is None else within(differences, margin)
    return Tails(exceeds(differences), exceeds(-differences), small)


def alike(differences: Float64s, margin: float) -> Tails:
    """Test whether the mean of the differences (pairs,) is less than ``margin`` either way, or more."""
    beyond = min(exceeds(differences, margin), exceeds(-differences, margin))
    return Tails(within(differences, margin), min(1.0, 2 * beyond))


def no_worse(differences: Float64s, margin: float) -> Tails:
    """Test whether the mean of the differences (pairs,) is above -``margin``, or below."""
    return Tails(exceeds(differences, -margin), exceeds(-differences, margin))


def mostly(successes: int, trials: int) -> Tails:
    """Test whether a trial is more likely than not to succeed: exact binomial tests, above one half and below."""
    above = stats.binomtest(successes, trials, 0.5, alternative="greater").pvalue
    below = stats.binomtest(successes, trials, 0.5, alternative="less").pvalue
    return Tails(float(above), float(below))


def mean_interval(trials: Float64s, highest: float = np.inf) -> Interval | None:
    """Return Student's t interval of the mean over trials (trials,), cut at ``highest``.

    None for fewer than two, and where half of them or more are at the highest score (t_interval). Without width where
    no trial differs from the others.
    """
    if len(trials) < 2:
        return None
    low, high = t_interval(trials[:, None], highest)
    return None if np.isnan(low[0]) else Interval(float(low[0]), float(high[0]))


def coverage(trials: Float64s, highest: float = np.inf) -> Float64s:
    """Return how often such an interval holds the mean of trials (trials, measures), (measures,).

    The share of SIMULATED experiments of as many trials, drawn from these, whose intervals hold the mean of these.
    NaN where there is no interval.
    """
    drawn = np.random.default_rng(0).integers(0, len(trials), (len(trials), SIMULATED))
    held = np.empty(trials.shape[1])
    for at, own in enumerate(trials.T):
        low, high = t_interval(own[drawn], highest)
        given = ~np.isnan(low)
        holds = (low <= own.mean() + 1e-9) & (own.mean() - 1e-9 <= high)
        held[at] = holds[given].mean() if given.any() and not np.isnan(t_interval(own[:, None], highest)[0]) else np.nan
    return held


def share_interval(successes: int, trials: int) -> Interval:
    """Return Clopper and Pearson's exact interval of a share."""
    interval = stats.binomtest(successes, trials).proportion_ci(method="exact")
    return Interval(float(interval.low), float(interval.high))


def percentiles(resampled: Sequence[float] | Float64s) -> Interval:
    """Return the middle 95 % of a bootstrap's resamples, which may be infinite."""
    # No interpolation: there is nothing between a number and infinity.
    low, high = np.percentile(resampled, [2.5, 97.5], method="inverted_cdf")
    return Interval(float(low), float(high))


def holm(p_values: Sequence[float]) -> list[float]:
    """Return Holm's adjusted p-values: compared with α, they keep the chance of any false rejection below α."""
    adjusted = [0.0] * len(p_values)
    largest = 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=lambda index: p_values[index])):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[index]))
        adjusted[index] = largest
    return adjusted
