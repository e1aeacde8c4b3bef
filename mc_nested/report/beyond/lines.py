"""A line of a claim, with the effect from which it follows how many trials would decide it."""

from collections.abc import Callable, Mapping

from mc_nested.arrays import Float64s
from mc_nested.report.beyond.arms import ArmResults
from mc_nested.report.claims.contests import MARGIN
from mc_nested.report.inference import (
    Tails,
    ahead,
    contrast,
    difference_interval,
    mostly,
    no_worse,
    share_interval,
)
from mc_nested.report.power import MeanEffect, ShareEffect
from mc_nested.report.verdicts import Evidence

ONE_TRIAL = "a single trial can't be tested"

Pair = tuple[Float64s, Float64s]
"""A measure of two agents' trials, (trials,) each."""


def above(what: str, names: tuple[str, str], pair: Pair) -> Evidence:
    """Whether the first scores above the second; the opposite is that it is less than a block above."""
    difference = _difference(pair)
    return _compared(what, names, pair, ahead, (difference, MARGIN - difference))


def not_behind(what: str, names: tuple[str, str], pair: Pair) -> Evidence:
    """Whether the first scores less than a block below the second; the opposite is that it is further below."""
    difference = _difference(pair)
    return _compared(what, names, pair, no_worse, (difference + MARGIN, -difference - MARGIN))


def mostly_at_the_optimum(what: str, arm: ArmResults, scores: Float64s) -> Evidence:
    """Whether a trial is more likely than not to score the optimum."""
    reached, trials = int((scores >= arm.optimum).sum()), len(scores)
    figures = (("trials", trials), ("share at the optimum", reached / trials))
    return Evidence(
        what, figures, share_interval(reached, trials), mostly(reached, trials), effect=ShareEffect(reached / trials)
    )


def lead_grows(what: str, leads: Mapping[int, Pair]) -> Evidence:
    """Whether the first's lead on the second is larger at the highest of these numbers than at the lowest."""
    low, high = min(leads), max(leads)
    figures = tuple((f"lead with {number}", _difference(pair)) for number, pair in leads.items())
    change = _difference(leads[high]) - _difference(leads[low])
    figures = (*figures, ("change", change))
    groups, weights = (*leads[high], *leads[low]), (1.0, -1.0, -1.0, 1.0)
    if min(map(len, groups)) < 2:
        return Evidence(what, figures, missing=ONE_TRIAL)
    tails, interval = contrast(groups, weights)
    spreads = tuple(float(group.std(ddof=1)) for group in groups)
    return Evidence(what, figures, interval, tails, effect=MeanEffect(change, -change, spreads, is_permuted=False))


def _compared(
    what: str,
    names: tuple[str, str],
    pair: Pair,
    test: Callable[[Float64s, Float64s, float], Tails],
    distances: tuple[float, float],
) -> Evidence:
    """``distances``: how far the difference is above what the claim says, and below what its opposite says."""
    left, right = pair
    figures = ((names[0], float(left.mean())), (names[1], float(right.mean())), ("difference", _difference(pair)))
    if min(len(left), len(right)) < 2:
        return Evidence(what, figures, missing=ONE_TRIAL)
    effect = MeanEffect(*distances, tuple(float(group.std(ddof=1)) for group in pair))
    return Evidence(what, figures, difference_interval(left, right), test(left, right, MARGIN), effect=effect)


def _difference(pair: Pair) -> float:
    return float(pair[0].mean() - pair[1].mean())
