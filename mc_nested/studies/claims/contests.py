"""Two agents beside each other on a scenario, by one of the measures of a trial."""

from collections.abc import Callable, Mapping

from mc_nested.arrays import Float64s
from mc_nested.studies.inference import Tails, ahead, alike, difference_interval
from mc_nested.studies.measures import Curve
from mc_nested.studies.power import TestedEffect
from mc_nested.studies.verdicts import Evidence, Verdict

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

ONE_TRIAL = "a single trial can't be tested"

Contest = Callable[[Float64s, Float64s], Tails]


def ahead_by_score(left: Float64s, right: Float64s) -> Tails:
    """Return whether the first's score is above the second's."""
    return ahead(left, right, MARGIN)


def alike_in_score(left: Float64s, right: Float64s) -> Tails:
    """Return whether the scores differ by less than a block."""
    return alike(left, right, MARGIN)


def less(left: Float64s, right: Float64s) -> Tails:
    """Return whether the first has less of it. Without a margin: nothing is to it what a block is to a score."""
    return ahead(right, left, 0.0)


def contest_of(curves: Curves, scenario: str, measure: str, agents: tuple[str, str], contest: Contest) -> Evidence:
    """Return what that measure of the two agents says there."""
    what = f"{scenario}, {measure}"
    absent = [agent for agent in agents if (agent, scenario) not in curves]
    if absent:
        return Evidence(what, counted=Verdict.NOT_RUN, missing=f"{' and '.join(absent)} not trained there")
    left, right = (MEASURES[measure](curves[agent, scenario]) for agent in agents)
    if not len(left) or not len(right):
        return Evidence(what, missing="too few evaluations for this measure")
    return compared(what, agents, (left, right), contest)


def compared(
    what: str,
    agents: tuple[str, str],
    trials: Pair,
    contest: Contest,
    effect: Callable[[tuple[float, ...]], TestedEffect] | None = None,
) -> Evidence:
    """Return what the trials of both say, (trials,) each; at least one of each.

    ``effect``: from their spreads, the effect that says how many trials would decide it.
    """
    left, right = trials
    means = float(left.mean()), float(right.mean())
    figures = (*zip(agents, means, strict=True), ("difference", means[0] - means[1]))
    if len(left) < 2 or len(right) < 2:
        return Evidence(what, figures, missing=ONE_TRIAL)
    spreads = tuple(float(group.std(ddof=1)) for group in trials)
    tested = effect(spreads) if effect else None
    return Evidence(what, figures, difference_interval(left, right), contest(left, right), effect=tested)
