"""Every claim of the paper about its three agents, with its verdict.

Scores (a) to (c) and (g), how steady they are (d), what more episodes bring (f). Costs: networks and parameters (e),
what replays hold (h). Seconds (i) depend on what is compiled first, on the size of batches and on what else the machine
does: they are judged where the agents are timed by turns (scripts/benches/costs.py).
"""

from collections.abc import Mapping, Sequence

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.studies.claims.contests import (
    EARLY,
    FINAL,
    HIERARCHICAL,
    LAST_TEN,
    LINE,
    NESTED,
    OUTPERFORMED,
    SINGLE,
    SPREAD,
    UNSOLVED,
    Curves,
    ahead_by_score,
    alike_in_score,
    compared,
    contest_of,
    less,
)
from mc_nested.studies.inference import mostly, share_interval
from mc_nested.studies.results import Cost, Results
from mc_nested.studies.verdicts import Claim, Evidence, JudgedClaim, Verdict, judged


def judge(results: Results, longer: Results | None = None) -> tuple[JudgedClaim, ...]:
    """Judge every claim; ``longer`` is the same experiment with ten times the episodes, for claim (f)."""
    curves, costs = results.curves, results.costs
    claims = (
        *ahead_on_the_line(curves),
        alike_on_the_unsolved(curves),
        *above_single(curves, results.scenarios),
        *steadier(curves, results.scenarios),
        *fewer_parts(costs, results.scenarios),
        solved_in_the_end(results, longer),
        ahead_of_single_early(curves, results.scenarios),
        smaller_replays(costs, results.scenarios),
    )
    return tuple(judged(claim) for claim in claims)


AHEAD = (
    "Sign-flip tests of the mean difference within pairs of trials. Holds: it is above 0; by less than a block: it is "
    "also shown to be less. Does not hold: it is below 0. Undecided, within a block: less than a block either way is "
    "all that is shown."
)
ALIKE = (
    "Sign-flip tests of the mean difference within pairs of trials. Holds: it is less than a block either way. Does "
    "not hold: it is more than a block."
)

STEADIER = (
    "Sign-flip tests of the mean difference, within pairs of trials, of the standard deviation over the evaluations in "
    "the last third of the training. Holds: it is below 0. Does not hold: it is above 0."
)
SOLVED = (
    "Exact binomial tests of the share of trials whose final greedy episode scores the optimum. Holds: it is above one "
    "half, so a trial is more likely than not to get there. Does not hold: it is below."
)

MEASURED = {EARLY: "early", FINAL: "at the end", LAST_TEN: "at the end, by the mean of the last ten evaluations"}


def ahead_on_the_line(curves: Curves) -> list[Claim]:
    """Return claims (a1) to (a3), a measure each."""
    converged = "was ultimately able to achieve a greater converged score"
    papers = {EARLY: "much better performance early on", FINAL: converged, LAST_TEN: converged}
    return [
        Claim(
            f"a{number}",
            f"nested is ahead of hierarchical on the line {MEASURED[measure]}",
            paper,
            "5.2",
            AHEAD,
            (contest_of(curves, LINE, measure, (NESTED, HIERARCHICAL), ahead_by_score),),
        )
        for number, (measure, paper) in enumerate(papers.items(), start=1)
    ]


def alike_on_the_unsolved(curves: Curves) -> Claim:
    """Return claim (b)."""
    return Claim(
        "b",
        "nested and hierarchical are alike on the zigzag and the diamond",
        "the performance of the deep nested agent and hierarchical agent were comparable",
        "5.2",
        ALIKE,
        tuple(
            contest_of(curves, scenario, measure, (NESTED, HIERARCHICAL), alike_in_score)
            for scenario in UNSOLVED
            for measure in (EARLY, FINAL, LAST_TEN)
        ),
    )


def above_single(curves: Curves, scenarios: Sequence[str]) -> list[Claim]:
    """Return claims (c1) to (c4): an agent and a measure each."""
    contests = [(agent, measure) for measure in (FINAL, LAST_TEN) for agent in (NESTED, HIERARCHICAL)]
    return [
        Claim(
            f"c{number}",
            f"{agent} is above single on every scenario {MEASURED[measure]}",
            "outperformed the deep non-hierarchical single agent framework in all scenarios",
            "5.2",
            AHEAD,
            tuple(contest_of(curves, scenario, measure, (agent, SINGLE), ahead_by_score) for scenario in scenarios),
        )
        for number, (agent, measure) in enumerate(contests, start=1)
    ]


def ahead_of_single_early(curves: Curves, scenarios: Sequence[str]) -> Claim:
    """Return claim (g)."""
    return Claim(
        "g",
        "nested is ahead of single early on every scenario",
        "This decreases training time in complex environments and leads to significantly better performance",
        "3",
        AHEAD,
        tuple(contest_of(curves, scenario, EARLY, (NESTED, SINGLE), ahead_by_score) for scenario in scenarios),
    )


def steadier(curves: Curves, scenarios: Sequence[str]) -> list[Claim]:
    """Return claims (d1) and (d2), against one of the other agents each."""
    return [
        Claim(
            f"d{number}",
            f"nested trains more stably than {other} on every scenario",
            f"{OUTPERFORMED} training stability",
            "5.2",
            STEADIER,
            tuple(contest_of(curves, scenario, SPREAD, (NESTED, other), less) for scenario in scenarios),
        )
        for number, other in enumerate((HIERARCHICAL, SINGLE), start=1)
    ]


def solved_in_the_end(results: Results, longer: Results | None) -> Claim:
    """Return claim (f), decided by ``longer``; the shares of ``results`` are shown beside it."""
    runs = [run for run in (results, longer) if run]
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
    """Return how many of the final scores (trials,) are the optimum."""
    return int(np.count_nonzero(final >= optimum))


def _share_solved(runs: Sequence[Results], agent: str, scenario: str) -> Evidence:
    what = f"{scenario}, {agent}, trials at the optimum"
    if len(runs) < 2:
        return Evidence(what, missing="needs a second run with ten times the episodes")
    if any((agent, scenario) not in run.curves for run in runs):
        return Evidence(what, missing="not trained")
    finals = [run.curves[agent, scenario].final for run in runs]
    if not all(len(final) for final in finals):
        return Evidence(what, missing="too few evaluations for this measure")
    solved = [trials_solved(final, run.optimum[scenario]) for final, run in zip(finals, runs, strict=True)]
    figures = tuple(
        (f"share after {run.episodes:,} episodes", count / run.trials) for count, run in zip(solved, runs, strict=True)
    )
    decisive = solved[-1], runs[-1].trials
    return Evidence(what, figures, share_interval(*decisive), mostly(*decisive))


FEWER = (
    "Counted, not tested. Holds: the nested agent's are fewer in every scenario. Does not hold: in any they are not."
)
FEWER_THAN = {
    HIERARCHICAL: (
        "we only had to train two DDQN models, compared with three for the deep hierarchical framework",
        "6",
    ),
    SINGLE: (f"{OUTPERFORMED} training stability, converged score, and computational expense", "5.2"),
}
"""What the paper says about the nested agent's costs compared with another's, and in which section."""

SMALLER = (
    "Sign-flip tests of the mean difference, within pairs of trials, of what a trial's replays hold at its end, all "
    "its agents' together, in 10⁶ bytes. Holds: it is below 0. Does not hold: it is above 0. A step is kept once, "
    "whoever made it, so this grows with the steps that were played; memory for networks is in claim (e1)."
)

MEGA = 1e6

UNMEASURED = "not measured: practised in a learnt game"

Costs = Mapping[tuple[str, str], Cost]
"""The costs of every agent and scenario."""


def fewer_parts(costs: Costs, scenarios: Sequence[str]) -> list[Claim]:
    """Return claims (e1) and (e2), against one of the other agents each: networks and parameters of a trial."""
    return [
        Claim(
            f"e{number}",
            f"nested needs fewer networks and parameters than {other}",
            paper,
            section,
            FEWER,
            tuple(evidence for of in ("networks", "parameters") for evidence in _counts(costs, scenarios, of, other)),
        )
        for number, (other, (paper, section)) in enumerate(FEWER_THAN.items(), start=1)
    ]


def smaller_replays(costs: Costs, scenarios: Sequence[str]) -> Claim:
    """Return claim (h)."""
    return Claim(
        "h",
        "nested holds less in its replays than hierarchical on every scenario",
        "without having to add more agents, which leads to reduced memory consumption",
        "4.1",
        SMALLER,
        tuple(_replays(costs, scenario) for scenario in scenarios),
    )


def _counts(costs: Costs, scenarios: Sequence[str], of: str, other: str) -> list[Evidence]:
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
    ] or [Evidence(f"{of} of a trial", missing="not trained")]


def _replays(costs: Costs, scenario: str) -> Evidence:
    what, agents = f"{scenario}, replays of a trial, MB", (NESTED, HIERARCHICAL)
    if any((agent, scenario) not in costs for agent in agents):
        return Evidence(what, missing="not trained")
    left, right = (np.array(costs[agent, scenario].replay_bytes, dtype=np.float64) / MEGA for agent in agents)
    if not len(left) or not len(right):
        return Evidence(what, missing=UNMEASURED)
    return compared(what, agents, (left, right), less)
