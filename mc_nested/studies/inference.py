"""Tests and intervals over trials, as pure functions: the same trials give the same figures to the bit.

The trials of two agents are independent samples: a shared seed gives both the same random numbers, but they are spent
on other networks and other choices, so nothing pairs them. The tests permute trials between the agents, and compare
Welch's t, not the difference itself: so they keep their level where the spreads differ (Janssen, 1997). The intervals
are Welch's and Student's t: at ten trials they came nearest to their 95 % (tests/studies/test_coverage.py).
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from scipy import stats

from mc_nested.arrays import Float64s
from mc_nested.report.curve import t_interval

ALPHA = 0.05
"""The significance level of each claim's verdict."""

RESAMPLES = 9_999
"""Permutations where there are more ways than these to split the trials, else all; resamples of a bootstrap."""

DECIMALS = 10
"""Of a test's statistic: splits that differ by rounding alone tie."""


class Interval(NamedTuple):
    """A 95 % interval."""

    low: float
    high: float


class Tails(NamedTuple):
    """The two p-values of a claim: a small ``claim`` speaks for it, a small ``against`` speaks against it."""

    claim: float
    against: float


def exceeds(left: Float64s, right: Float64s) -> float:
    """Return the one-sided p of a permutation test that the mean of ``left``, of two or more, is above ``right``'s.

    Exact where all splits are gone through, and the two agents differ in nothing. Trials that are all the same give 1.
    """
    centre, scale = _centre_and_scale(left, right)
    test = stats.permutation_test(
        ((left - centre) / scale, (right - centre) / scale),
        studentised,
        n_resamples=RESAMPLES,
        vectorized=True,
        alternative="greater",
        rng=np.random.default_rng(0),
    )
    return float(test.pvalue)


def studentised(left: Float64s, right: Float64s, axis: int = -1) -> Float64s:
    """Return Welch's t of the difference of the means as t / sqrt(1 + t²), in [-1, 1]: in t's order, never infinite.

    1 or -1 where no trial differs from its agent's others, and 0 where the means are the same, too. For trials of the
    order of 1.
    """
    difference = left.mean(axis=axis) - right.mean(axis=axis)
    variance = left.var(axis=axis, ddof=1) / left.shape[axis] + right.var(axis=axis, ddof=1) / right.shape[axis]
    size = np.sqrt(difference**2 + variance)
    is_more = size > 10.0**-DECIMALS
    found: Float64s = np.round(np.where(is_more, difference, 0.0) / np.where(is_more, size, 1.0), DECIMALS)
    return found


def ahead(left: Float64s, right: Float64s, margin: float) -> Tails:
    """Test whether ``left`` is ahead. For: the difference is above 0. Against: it is below ``margin``.

    Both can hold, for a lead smaller than the margin: then it is ahead.
    """
    return Tails(exceeds(left, right), exceeds(right, left - margin))


def alike(left: Float64s, right: Float64s, margin: float) -> Tails:
    """Test whether the means differ by less than ``margin``: for it by two one-sided tests, against that it is more."""
    within = max(exceeds(left + margin, right), exceeds(right + margin, left))
    beyond = min(exceeds(left - margin, right), exceeds(right - margin, left))
    return Tails(within, min(1.0, 2 * beyond))


def mostly(successes: int, trials: int) -> Tails:
    """Test whether a trial is more likely than not to succeed: exact binomial tests, above one half and below."""
    above = stats.binomtest(successes, trials, 0.5, alternative="greater").pvalue
    below = stats.binomtest(successes, trials, 0.5, alternative="less").pvalue
    return Tails(float(above), float(below))


def no_worse(left: Float64s, right: Float64s, margin: float) -> Tails:
    """Test whether ``left`` is behind by less than ``margin``: for it above -margin, against it below."""
    return Tails(exceeds(left + margin, right), exceeds(right, left + margin))


def contrast(groups: Sequence[Float64s], weights: Sequence[float]) -> tuple[Tails, Interval]:
    """Test whether a weighted sum of the groups' means is above 0, or below; and its 95 % interval.

    Welch and Satterthwaite's t, since no permutation leaves a difference of differences as it was. At least two
    trials of each. Trials that are all the same give 1.
    """
    found = sum(weight * float(group.mean()) for weight, group in zip(weights, groups, strict=True))
    pairs = zip(weights, groups, strict=True)
    parts = [weight**2 * float(group.var(ddof=1)) / len(group) for weight, group in pairs]
    if not sum(parts):
        return Tails(1.0, 1.0), Interval(found, found)
    freedom = _freedom(parts, groups)
    error = sum(parts) ** 0.5
    half = float(stats.t.ppf(0.975, freedom)) * error
    tails = Tails(float(stats.t.sf(found / error, freedom)), float(stats.t.cdf(found / error, freedom)))
    return tails, Interval(found - half, found + half)


def _freedom(parts: Sequence[float], groups: Sequence[Float64s]) -> float:
    """Return Satterthwaite's degrees of freedom of a sum whose squared standard error has a part of each group."""
    return sum(parts) ** 2 / sum(part**2 / (len(group) - 1) for part, group in zip(parts, groups, strict=True))


def difference_interval(left: Float64s, right: Float64s) -> Interval:
    """Return Welch's t interval of the difference of the means; at least two trials of both.

    Without width where no trial differs from its agent's others.
    """
    difference = float(left.mean() - right.mean())
    parts = [float(trials.var(ddof=1)) / len(trials) for trials in (left, right)]
    if not sum(parts):
        return Interval(difference, difference)
    half = float(stats.t.ppf(0.975, _freedom(parts, (left, right)))) * sum(parts) ** 0.5
    return Interval(difference - half, difference + half)


def mean_interval(trials: Float64s, highest: float = np.inf) -> Interval | None:
    """Return Student's t interval of the mean over trials (trials,), cut at ``highest``; None for fewer than two.

    Without width where no trial differs from the others.
    """
    if len(trials) < 2:
        return None
    low, high = t_interval(trials[:, None], highest)
    return Interval(float(low[0]), float(high[0]))


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


def _centre_and_scale(left: Float64s, right: Float64s) -> tuple[float, float]:
    both = np.concatenate((left, right))
    centre = float(both.mean())
    # Where trials differ by rounding alone, that must not be scaled up to look like a difference.
    return centre, max(float(np.abs(both - centre).max()), 1e-5 * (1.0 + abs(centre)))
