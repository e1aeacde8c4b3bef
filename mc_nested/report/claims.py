"""The paper's claims about its three agents (from section 5.2 on): what is measured for each, and the test."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.report.inference import Tails, ahead, alike, difference_interval, mostly, share_interval
from mc_nested.report.measures import Curve, curves_of
from mc_nested.report.results import Cost, Results
from mc_nested.report.verdicts import Claim, Evidence, JudgedClaim, Verdict, judged

NESTED, HIERARCHICAL, SINGLE = "nested", "hierarchical", "single"

LINE = "line"
UNSOLVED = ("zigzag", "diamond")
"""The paper's scenarios 1, and 2 and 3, which it left unsolved."""

MARGIN = 1.0
"""Scores that differ by less than one block count as alike."""

MEASURES: Mapping[str, Callable[[Curve], Float64s]] = {
    "early score": lambda curve: curve.early,
    "final score": lambda curve: curve.final,
    "spread": lambda curve: curve.spread,
}

OUTPERFORMED = (
    "outperformed the deep hierarchical framework, as well as, the deep non-hierarchical single agent framework in "
    "terms of"
)

AHEAD = (
    "Permutation tests of the difference of the means. Holds: it is above 0. Does not hold: it is below one block "
    "(so behind, or level), and not shown to be above 0."
)
ALIKE = (
    "Two one-sided permutation tests with a margin of one block. Holds: the means differ by less. Does not hold: they "
    "differ by more."
)
STEADIER = (
    "Permutation tests of the difference of the means of each trial's standard deviation over its evaluations in the "
    "last third of the training. Holds: it is below 0. Does not hold: it is above 0."
)
CHEAPER = (
    "Counted, not tested. Holds: the nested agent's are fewer in every scenario. Does not hold: in any they are not."
)
CHEAPER_THAN = {
    HIERARCHICAL: (
        "we only had to train two DDQN models, compared with three for the deep hierarchical framework",
        "6",
    ),
    SINGLE: (f"{OUTPERFORMED} training stability, converged score, and computational expense", "5.2"),
}
"""What the paper says about the nested agent's costs compared with another's, and in which section."""

SOLVED = (
    "Exact binomial tests of the share of trials whose final greedy episode scores the optimum. Holds: it is above one "
    "half, so a trial is more likely than not to get there. Does not hold: it is below."
)

Contest = Callable[[Float64s, Float64s], Tails]


def judge(results: Results, longer: Results | None = None) -> tuple[JudgedClaim, ...]:
    """Every claim with its verdict; ``longer``: the same experiment with ten times the episodes, for claim (f)."""
    curves = curves_of(results)
    costs = {(cost.agent, cost.scenario): cost for cost in results.costs}
    return judged(
        (
            ahead_on_the_line(curves),
            alike_on_the_unsolved(curves),
            above_single(curves, results.scenarios),
            steadier(curves, results.scenarios),
            cheaper("e1", HIERARCHICAL, costs, results.scenarios),
            cheaper("e2", SINGLE, costs, results.scenarios),
            solved_in_the_end(results, longer),
        )
    )


def ahead_on_the_line(curves: Mapping[tuple[str, str], Curve]) -> Claim:
    """Claim (a)."""
    return Claim(
        "a",
        "nested is ahead of hierarchical on the line, early and at the end",
        "much better performance early on ... and was ultimately able to achieve a greater converged score",
        "5.2",
        AHEAD,
        tuple(
            _contest(curves, LINE, measure, (NESTED, HIERARCHICAL), _ahead_by_score)
            for measure in ("early score", "final score")
        ),
    )


def alike_on_the_unsolved(curves: Mapping[tuple[str, str], Curve]) -> Claim:
    """Claim (b)."""
    return Claim(
        "b",
        "nested and hierarchical are alike on the zigzag and the diamond",
        "the performance of the deep nested agent and hierarchical agent were comparable",
        "5.2",
        ALIKE,
        tuple(
            _contest(curves, scenario, measure, (NESTED, HIERARCHICAL), _alike_in_score)
            for scenario in UNSOLVED
            for measure in ("early score", "final score")
        ),
    )


def above_single(curves: Mapping[tuple[str, str], Curve], scenarios: Sequence[str]) -> Claim:
    """Claim (c)."""
    return Claim(
        "c",
        "nested and hierarchical are above single on every scenario",
        "outperformed the deep non-hierarchical single agent framework in all scenarios",
        "5.2",
        AHEAD,
        tuple(
            _contest(curves, scenario, "final score", (agent, SINGLE), _ahead_by_score)
            for scenario in scenarios
            for agent in (NESTED, HIERARCHICAL)
        ),
    )


def steadier(curves: Mapping[tuple[str, str], Curve], scenarios: Sequence[str]) -> Claim:
    """Claim (d)."""
    return Claim(
        "d",
        "nested trains more stably than hierarchical and single",
        f"{OUTPERFORMED} training stability",
        "5.2",
        STEADIER,
        tuple(
            _contest(curves, scenario, "spread", (NESTED, other), _less_spread)
            for scenario in scenarios
            for other in (HIERARCHICAL, SINGLE)
        ),
    )


def cheaper(letter: str, other: str, costs: Mapping[tuple[str, str], Cost], scenarios: Sequence[str]) -> Claim:
    """Claim (e), against one of the other agents: networks and parameters of a trial."""
    paper, section = CHEAPER_THAN[other]
    return Claim(
        letter,
        f"nested needs fewer networks and parameters than {other}",
        paper,
        section,
        CHEAPER,
        tuple(evidence for of in ("networks", "parameters") for evidence in _counts(costs, scenarios, of, other)),
    )


def solved_in_the_end(results: Results, longer: Results | None) -> Claim:
    """Claim (f), decided by ``longer``; the shares of ``results`` are shown beside it."""
    runs = [(run, curves_of(run)) for run in (results, longer) if run]
    return Claim(
        "f",
        "more episodes bring the zigzag and the diamond to the optimum",
        "with more training the deep nested agent model and the deep hierarchical agent model should be able to obtain "
        "the optimal solution",
        "7.1 (appendix)",
        SOLVED,
        tuple(_share_solved(runs, agent, scenario) for scenario in UNSOLVED for agent in (NESTED, HIERARCHICAL)),
    )


def trials_solved(final: Float64s, optimum: float) -> int:
    """How many of the final scores (trials,) are the optimum."""
    return int(np.count_nonzero(final >= optimum))


def _ahead_by_score(left: Float64s, right: Float64s) -> Tails:
    return ahead(left, right, MARGIN)


def _alike_in_score(left: Float64s, right: Float64s) -> Tails:
    return alike(left, right, MARGIN)


def _less_spread(left: Float64s, right: Float64s) -> Tails:
    # Without a margin: the paper gives no unit for a spread, as a block is for a score.
    return ahead(right, left, 0.0)


def _contest(
    curves: Mapping[tuple[str, str], Curve], scenario: str, measure: str, agents: tuple[str, str], contest: Contest
) -> Evidence:
    what = f"{scenario}, {measure}"
    absent = [agent for agent in agents if (agent, scenario) not in curves]
    if absent:
        return Evidence(what, counted=Verdict.NOT_RUN, missing=f"{' and '.join(absent)} not trained there")
    left, right = (MEASURES[measure](curves[agent, scenario]) for agent in agents)
    if not len(left) or not len(right):
        return Evidence(what, missing="too few evaluations for this measure")
    means = float(left.mean()), float(right.mean())
    figures = (*zip(agents, means, strict=True), ("difference", means[0] - means[1]))
    if len(left) < 2:
        return Evidence(what, figures, missing="a single trial can't be tested")
    return Evidence(what, figures, difference_interval(left, right), contest(left, right))


def _counts(costs: Mapping[tuple[str, str], Cost], scenarios: Sequence[str], of: str, other: str) -> list[Evidence]:
    counted: dict[tuple[int, int], list[str]] = {}
    for scenario in scenarios:
        if (NESTED, scenario) in costs and (other, scenario) in costs:
            ours, theirs = (int(getattr(costs[agent, scenario], of)) for agent in (NESTED, other))
            counted.setdefault((ours, theirs), []).append(scenario)
    return [
        Evidence(
            f"{', '.join(alike)}, {of} of a trial",
            ((NESTED, ours), (other, theirs), ("ratio", ours / theirs)),
            counted=Verdict.HOLDS if ours < theirs else Verdict.FAILS,
        )
        for (ours, theirs), alike in counted.items()
    ] or [Evidence(f"{of} of a trial", counted=Verdict.NOT_RUN, missing="not trained")]


def _share_solved(
    runs: Sequence[tuple[Results, Mapping[tuple[str, str], Curve]]], agent: str, scenario: str
) -> Evidence:
    what = f"{scenario}, {agent}, trials at the optimum"
    if len(runs) < 2:
        return Evidence(what, counted=Verdict.NOT_RUN, missing="needs a second run with ten times the episodes")
    if any((agent, scenario) not in curves for _, curves in runs):
        return Evidence(what, counted=Verdict.NOT_RUN, missing="not trained")
    finals = [curves[agent, scenario].final for _, curves in runs]
    if not all(len(final) for final in finals):
        return Evidence(what, missing="too few evaluations for this measure")
    solved = [trials_solved(final, run.optimum[scenario]) for final, (run, _) in zip(finals, runs, strict=True)]
    figures = tuple(
        (f"share after {run.episodes:,} episodes", count / run.trials)
        for count, (run, _) in zip(solved, runs, strict=True)
    )
    decisive = solved[-1], runs[-1][0].trials
    return Evidence(what, figures, share_interval(*decisive), mostly(*decisive))
