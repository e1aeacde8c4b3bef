"""The claims about costs: networks and parameters (e), and what replays hold (h).

Seconds (i) depend on what is compiled first, on the size of batches and on what else the machine does: they are judged
where the agents are timed by turns (scripts/benches/costs.py).
"""

from collections.abc import Mapping, Sequence

import numpy as np

from mc_nested.studies.claims.contests import HIERARCHICAL, NESTED, OUTPERFORMED, SINGLE, compared, less
from mc_nested.studies.results import Cost
from mc_nested.studies.verdicts import Claim, Evidence, Verdict

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
    ] or [Evidence(f"{of} of a trial", counted=Verdict.NOT_JUDGED, missing="not trained")]


def _replays(costs: Costs, scenario: str) -> Evidence:
    what, agents = f"{scenario}, replays of a trial, MB", (NESTED, HIERARCHICAL)
    if any((agent, scenario) not in costs for agent in agents):
        return Evidence(what, counted=Verdict.NOT_JUDGED, missing="not trained")
    left, right = (np.array(costs[agent, scenario].replay_bytes, dtype=np.float64) / MEGA for agent in agents)
    if not len(left) or not len(right):
        return Evidence(what, counted=Verdict.NOT_JUDGED, missing=UNMEASURED)
    return compared(what, agents, (left, right), less)
