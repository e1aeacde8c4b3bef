"""The claims about scores: (a) to (c), (g), how steady they are, (d), and what more episodes bring, (f)."""

from collections.abc import Sequence

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
    contest_of,
    less,
)
from mc_nested.studies.inference import mostly, share_interval
from mc_nested.studies.results import Results
from mc_nested.studies.verdicts import Claim, Evidence, Verdict

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
    runs = [(run, run.curves) for run in (results, longer) if run]
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


def _share_solved(runs: Sequence[tuple[Results, Curves]], agent: str, scenario: str) -> Evidence:
    what = f"{scenario}, {agent}, trials at the optimum"
    if len(runs) < 2:
        return Evidence(what, counted=Verdict.NOT_JUDGED, missing="needs a second run with ten times the episodes")
    if any((agent, scenario) not in curves for _, curves in runs):
        return Evidence(what, counted=Verdict.NOT_JUDGED, missing="not trained")
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
