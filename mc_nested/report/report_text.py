"""report.md: the final scores, Figure 5, and each of the paper's claims with what was measured and its verdict."""

from collections.abc import Sequence

import numpy as np

from mc_nested.report.claim_text import claim_section, claims_table, method
from mc_nested.report.claims.costs import MEGA
from mc_nested.report.claims.longer import trials_solved
from mc_nested.report.inference import mean_interval, share_interval
from mc_nested.report.markdown import NONE, interval, mean, table
from mc_nested.report.measures import Curve, curves_of, early_limit
from mc_nested.report.results import Cost, Results
from mc_nested.report.verdicts import JudgedClaim

EXPLAINED = """\
Final: the score of the policy that a trial keeps. Last ten: the mean of a trial's last ten evaluations. Early: the mean
over the first {early:,} episodes. Spread: a trial's standard deviation over the evaluations of the last third. All are
means over the trials. At the optimum: trials whose final score is."""

SCORES = (
    "scenario",
    "agent",
    "final score",
    "95 % interval",
    "last ten",
    "95 % interval",
    "at the optimum",
    "95 % interval",
    "early",
    "spread",
)


def report_text(results: Results, claims: Sequence[JudgedClaim], longer: Results | None = None) -> str:
    """The report as Markdown; ``claims`` and ``longer`` as in ``judge``.

    The same results give the same text. ``Cost.seconds`` is only in lines that name seconds: the only lines that differ
    if the same experiment is repeated.
    """
    parts = [
        "# The paper's experiment, repeated",
        _what_was_run(results, longer),
        _scores(results),
        "![Score of a greedy episode against training episodes, a panel for each scenario](figure5.png)",
        "## The paper's claims",
        claims_table(claims),
        *(claim_section(judged) for judged in claims),
        "## Costs",
        _costs(results),
        "## How it was computed",
        method(claims, results.trials, results.keeps_best),
    ]
    return "\n\n".join(parts) + "\n"


def _what_was_run(results: Results, longer: Results | None) -> str:
    trials = f"{results.trials} trials" if results.trials > 1 else "one trial"
    further = f" A second run, of {longer.episodes:,} episodes, is there for claim (f) alone." if longer else ""
    return (
        f"Preset `{results.preset}`, seed {results.seed}: {trials} of {results.episodes:,} episodes for each agent and "
        f"scenario, a greedy evaluation every {results.evaluate_every} episodes.{further}"
    )


def _scores(results: Results) -> str:
    curves = curves_of(results)
    rows = []
    for scenario in results.scenarios:
        for agent in results.agents:
            curve, optimum = curves[agent, scenario], results.optimum[scenario]
            rows.append(
                (
                    scenario,
                    agent,
                    f"**{mean(curve.final)}** of {optimum:g}",
                    interval(mean_interval(curve.final, optimum)),
                    mean(curve.last_ten),
                    interval(mean_interval(curve.last_ten, optimum)),
                    *_solved(curve, optimum),
                    mean(curve.early),
                    mean(curve.spread),
                )
            )
    return f"{table(SCORES, rows)}\n\n{EXPLAINED.format(early=early_limit(results.episodes))}"


def _solved(curve: Curve, optimum: float) -> tuple[str, str]:
    trials = len(curve.final)
    if not trials:
        return NONE, NONE
    count = trials_solved(curve.final, optimum)
    return f"{count} of {trials}", interval(share_interval(count, trials))


def _costs(results: Results) -> str:
    by_agent = {agent: [cost for cost in results.costs if cost.agent == agent] for agent in results.agents}
    reference = {cost.scenario: cost for cost in by_agent.get("nested", [])}
    rows = [
        (
            cost.scenario,
            cost.agent,
            *(_ratio(cost, reference.get(cost.scenario), of) for of in COUNTS),
            mean(np.array(cost.replay_bytes) / MEGA),
        )
        for scenario in results.scenarios
        for agent in results.agents
        for cost in by_agent[agent]
        if cost.scenario == scenario
    ]
    header = (
        "scenario",
        "agent",
        "networks",
        "parameters",
        "updates, all trials",
        "steps, all trials",
        "replays, MB a trial",
    )
    seconds = ", ".join(f"{agent} {sum(cost.seconds for cost in own):.1f}" for agent, own in by_agent.items() if own)
    return (
        f"{table(header, rows)}\n\nIn brackets: times the nested agent's. Networks and parameters are one trial's, "
        f"target networks not counted.\n\nSeconds of training, which another run won't repeat: {seconds}."
    )


COUNTS = ("networks", "parameters", "updates", "env_steps")


def _ratio(cost: Cost, reference: Cost | None, of: str) -> str:
    count = getattr(cost, of)
    if reference is None or reference is cost or not getattr(reference, of):
        return f"{count:,}"
    return f"{count:,} ({count / getattr(reference, of):.2f})"
