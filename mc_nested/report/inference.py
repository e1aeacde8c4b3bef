"""Tests and intervals over trials, as pure functions: the same trials give the same figures to the bit.

The trials of two agents are independent samples: a shared seed gives both the same random numbers, but they are spent
on other networks and other choices, so nothing pairs them. The tests permute trials between the agents. With equally
many trials of both, they tolerate unequal spreads well.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats

from mc_nested.arrays import Float64s
from mc_nested.report.curve import bootstrap_interval

ALPHA = 0.05
"""The significance level of the verdicts, over all tests together."""

RESAMPLES = 9_999
"""Bootstrap resamples, and permutations where there are more ways than these to split the trials; else all of them."""


class Interval(NamedTuple):
    """A 95 % interval."""

    low: float
    high: float


class Tails(NamedTuple):
    """The two p-values of a claim: a small ``claim`` speaks for it, a small ``against`` speaks against it."""

    claim: float
    against: float


def exceeds(left: Float64s, right: Float64s) -> float:
    """One-sided p of a permutation test that the mean of ``left`` is above that of ``right``; at least two of both."""
    test = stats.permutation_test(
        (left, right),
        _difference,
        n_resamples=RESAMPLES,
        vectorized=True,
        alternative="greater",
        rng=np.random.default_rng(0),
    )
    return float(test.pvalue)


def ahead(left: Float64s, right: Float64s, margin: float) -> Tails:
    """Whether ``left`` is ahead. For: the difference is above 0. Against: it is below ``margin``.

    Both can hold, for a lead smaller than the margin: then it is ahead.
    """
    return Tails(exceeds(left, right), exceeds(right, left - margin))


def alike(left: Float64s, right: Float64s, margin: float) -> Tails:
    """Whether the means differ by less than ``margin``. For: two one-sided tests. Against: they differ by more."""
    within = max(exceeds(left + margin, right), exceeds(right + margin, left))
    beyond = min(exceeds(left - margin, right), exceeds(right - margin, left))
    return Tails(within, min(1.0, 2 * beyond))


def mostly(successes: int, trials: int) -> Tails:
    """Whether a trial is more likely than not to succeed: exact binomial tests, above one half and below."""
    above = stats.binomtest(successes, trials, 0.5, alternative="greater").pvalue
    below = stats.binomtest(successes, trials, 0.5, alternative="less").pvalue
    return Tails(float(above), float(below))


def difference_interval(left: Float64s, right: Float64s) -> Interval:
    """Percentile bootstrap interval of the difference of the means; at least two trials of both."""
    test = stats.bootstrap(
        (left, right),
        _difference,
        n_resamples=RESAMPLES,
        vectorized=True,
        method="percentile",
        rng=np.random.default_rng(0),
    )
    return Interval(float(test.confidence_interval.low), float(test.confidence_interval.high))


def mean_interval(trials: Float64s) -> Interval | None:
    """Percentile bootstrap interval of the mean over trials (trials,); None for fewer than two."""
    if len(trials) < 2:
        return None
    low, high = bootstrap_interval(trials[:, None])
    return Interval(float(low[0]), float(high[0]))


def share_interval(successes: int, trials: int) -> Interval:
    """Clopper and Pearson's exact interval of a share."""
    interval = stats.binomtest(successes, trials).proportion_ci(method="exact")
    return Interval(float(interval.low), float(interval.high))


def holm(p_values: Sequence[float]) -> list[float]:
    """Holm's adjusted p-values: compared with α, they keep the chance of any false rejection among all below α."""
    adjusted = [0.0] * len(p_values)
    largest = 0.0
    for rank, index in enumerate(sorted(range(len(p_values)), key=lambda index: p_values[index])):
        largest = max(largest, min(1.0, (len(p_values) - rank) * p_values[index]))
        adjusted[index] = largest
    return adjusted


def _difference(left: Float64s, right: Float64s, axis: int = -1) -> Float64s:
    difference: Float64s = left.mean(axis=axis) - right.mean(axis=axis)
    return difference
