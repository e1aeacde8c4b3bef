"""A line of a claim about what the paper didn't try, with the effect that says how many trials would decide it."""

from collections.abc import Mapping
from functools import partial

from mc_nested.arrays import Float64s
from mc_nested.studies.claims.contests import MARGIN, ONE_TRIAL, Pair, ahead_by_score, compared
from mc_nested.studies.inference import contrast, mostly, no_worse, share_interval
from mc_nested.studies.power import MeanEffect, ShareEffect
from mc_nested.studies.verdicts import Evidence


def above(what: str, names: tuple[str, str], pair: Pair) -> Evidence:
    """Return whether the first scores above the second; the opposite is that it is less than a block above."""
    lead = _difference(pair)
    return compared(what, names, pair, ahead_by_score, partial(MeanEffect, lead, MARGIN - lead))


def not_behind(what: str, names: tuple[str, str], pair: Pair) -> Evidence:
    """Return whether the first scores less than a block below the second; the opposite is that it is further below."""
    lead = _difference(pair)
    effect = partial(MeanEffect, lead + MARGIN, -lead - MARGIN)
    return compared(what, names, pair, lambda left, right: no_worse(left, right, MARGIN), effect)


def mostly_at_the_optimum(what: str, optimum: float, scores: Float64s) -> Evidence:
    """Return whether a trial is more likely than not to score the optimum."""
    reached, trials = int((scores >= optimum).sum()), len(scores)
    figures = (("trials", trials), ("share at the optimum", reached / trials))
    return Evidence(
        what, figures, share_interval(reached, trials), mostly(reached, trials), effect=ShareEffect(reached / trials)
    )


def lead_grows(what: str, leads: Mapping[int, Pair]) -> Evidence:
    """Return whether the first's lead on the second is larger at the highest of these numbers than at the lowest."""
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


def _difference(pair: Pair) -> float:
    return float(pair[0].mean() - pair[1].mean())
