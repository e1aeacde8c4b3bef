"""The claims about scores: (a) to (c), and (g)."""

from collections.abc import Sequence

from mc_nested.studies.claims.contests import (
    EARLY,
    FINAL,
    HIERARCHICAL,
    LAST_TEN,
    LINE,
    NESTED,
    SINGLE,
    UNSOLVED,
    Curves,
    ahead_by_score,
    alike_in_score,
    contest_of,
)
from mc_nested.studies.verdicts import Claim

AHEAD = (
    "Sign-flip tests of the mean difference within pairs of trials. Holds: it is above 0; by less than a block: it is "
    "also shown to be less. Does not hold: it is below 0. Undecided, within a block: less than a block either way is "
    "all that is shown."
)
ALIKE = (
    "Sign-flip tests of the mean difference within pairs of trials. Holds: it is less than a block either way. Does "
    "not hold: it is more than a block."
)

MEASURED = {
    EARLY: "early",
    FINAL: "at the end",
    LAST_TEN: "at the end, by the mean of the last ten evaluations",
}


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
