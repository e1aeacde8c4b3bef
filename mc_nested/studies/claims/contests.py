"""Two agents beside each other on a scenario, by one of the measures of a trial."""

from collections.abc import Callable, Mapping
from functools import partial

from mc_nested.arrays import Float64s
from mc_nested.studies.inference import Tails, ahead, alike, coverage, mean_interval
from mc_nested.studies.power import TestedEffect
from mc_nested.studies.results import Curve
from mc_nested.studies.verdicts import Evidence

NESTED, HIERARCHICAL, SINGLE = "nested", "hierarchical", "single"

LINE = "line"
UNSOLVED = ("zigzag", "diamond")
"""The paper's scenario 1, and its scenarios 2 and 3, which it left unsolved."""

MARGIN = 1.0
"""Scores that differ by less than one block count as alike."""

EARLY, FINAL, LAST_TEN, SPREAD = "early score", "final score", "mean of the last ten", "spread"

MEASURES: Mapping[str, Callable[[Curve], Float64s]] = {
    EARLY: lambda curve: curve.early,
    FINAL: lambda curve: curve.final,
    LAST_TEN: lambda curve: curve.last_ten,
    SPREAD: lambda curve: curve.spread,
}

OUTPERFORMED = (
    "outperformed the deep hierarchical framework, as well as, the deep non-hierarchical single agent framework in "
    "terms of"
)

Curves = Mapping[tuple[str, str], Curve]
"""The curve of every agent and scenario."""

Pair = tuple[Float64s, Float64s]
"""A measure of two agents' trials, (trials,) each."""

Contest = Callable[[Float64s], Tails]
"""A test of the differences within pairs, (pairs,)."""

ahead_by_score: Contest = partial(ahead, margin=MARGIN)
"""Whether the first's score is above the second's."""

alike_in_score: Contest = partial(alike, margin=MARGIN)
"""Whether the scores differ by less than a block."""


def less(differences: Float64s) -> Tails:
    """Return whether the first has less of it. Without a margin: nothing is to it what a block is to a score."""
    return ahead(-differences)


def contest_of(curves: Curves, scenario: str, measure: str, agents: tuple[str, str], contest: Contest) -> Evidence:
    """Return what that measure of the two agents says there."""
    what = f"{scenario}, {measure}"
    absent = [agent for agent in agents if (agent, scenario) not in curves]
    if absent:
        return Evidence(what, missing=f"{' and '.join(absent)} not trained there")
    left, right = (MEASURES[measure](curves[agent, scenario]) for agent in agents)
    if not len(left) or not len(right):
        return Evidence(what, missing="too few evaluations for this measure")
    return compared(what, agents, (left, right), contest)


def compared(
    what: str,
    agents: tuple[str, str],
    trials: Pair,
    contest: Contest,
    effect: Callable[[float, float], TestedEffect] | None = None,
) -> Evidence:
    """Return what the trials of both say, (trials,) each; at least one of each.

    ``effect``: of the mean and the spread of the differences, what says how many trials would decide it.
    """
    left, right = paired(trials)
    differences, means = left - right, (float(left.mean()), float(right.mean()))
    difference = means[0] - means[1]
    figures = (*zip(agents, means, strict=True), ("difference", difference))
    if len(differences) < 2:
        return Evidence(what, figures, missing="a single trial can't be tested")
    return Evidence(
        what,
        figures,
        mean_interval(differences),
        contest(differences),
        effect=effect(difference, float(differences.std(ddof=1))) if effect else None,
        coverage=float(coverage(differences[:, None])[0]),
    )


def paired(trials: Pair) -> Pair:
    """Return the trials of both that have a partner, (pairs,) each: those of one number are a pair."""
    left, right = trials
    pairs = min(len(left), len(right))
    return left[:pairs], right[:pairs]
