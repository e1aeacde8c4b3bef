"""The claim about more episodes: (f)."""

from collections.abc import Sequence

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.studies.claims.contests import HIERARCHICAL, NESTED, UNSOLVED, Curves
from mc_nested.studies.inference import mostly, share_interval
from mc_nested.studies.results import Results
from mc_nested.studies.verdicts import Claim, Evidence, Verdict

SOLVED = (
    "Exact binomial tests of the share of trials whose final greedy episode scores the optimum. Holds: it is above one "
    "half, so a trial is more likely than not to get there. Does not hold: it is below."
)


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
