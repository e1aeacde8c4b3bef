"""The claims about training stability: (d)."""

from collections.abc import Sequence

from mc_nested.studies.claims.contests import (
    HIERARCHICAL,
    NESTED,
    OUTPERFORMED,
    SINGLE,
    SPREAD,
    Curves,
    contest_of,
    less,
)
from mc_nested.studies.verdicts import Claim

STEADIER = (
    "Sign-flip tests of the mean difference, within pairs of trials, of the standard deviation over the evaluations in "
    "the last third of the training. Holds: it is below 0. Does not hold: it is above 0."
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
