"""report.md: the final scores, Figure 5, and each of the paper's claims with what was measured and its verdict."""

from collections.abc import Sequence
from math import comb

from mc_nested.arrays import Float64s
from mc_nested.report.claims import trials_solved
from mc_nested.report.inference import ALPHA, RESAMPLES, Interval, Tails, mean_interval, share_interval
from mc_nested.report.measures import Curve, curves_of, early_limit
from mc_nested.report.results import Cost, Results
from mc_nested.report.verdicts import Evidence, Finding, JudgedClaim

METHOD = """\
- A claim holds if all its lines do, and does not hold if any of them doesn't, at α = {alpha:g}. Holm's correction is
  over all {tests} one-sided tests of this report: one for and one against in each line that has a p.
- The trials of two agents are independent samples: the seed that they share gives them the same random numbers, but
  they spend them on other networks and other choices, so nothing pairs them.
- Permutation tests go through all splits of the trials where there are at most {splits:,}, else through {resamples:,}
  drawn with a fixed seed, which makes {smallest} the smallest p.
- The intervals of means and differences are percentile bootstraps over the trials, with a fixed seed; with few trials
  they are somewhat narrow. Those of shares are exact. None is corrected for being one of many: an interval without 0
  can occur beside an undecided test.
- Greedy episodes don't vary by chance: a final score is one episode. What varies is the training, so the unit is the
  trial.
- A small spread is no merit in an agent that is stuck: read it together with the final score.
- Undecided means that these trials don't show it, not that there is no difference."""

TOO_FEW_TRIALS = """
- With {trials} trials no permutation test can come below {smallest}, which is too much for {tests} tests: all of them
  stay undecided, whatever was measured. Train more trials."""

NONE = "-"


def report_text(results: Results, claims: Sequence[JudgedClaim], longer: Results | None = None) -> str:
    """The report as Markdown; ``claims`` and ``longer`` as in ``judge``.

    The same results give the same text. ``Cost.seconds`` is only in the line that begins with "Seconds": the only line
    that differs if the same experiment is repeated.
    """
    parts = [
        "# The paper's experiment, repeated",
        _what_was_run(results, longer),
        _scores(results),
        "![Score of a greedy episode against training episodes, a panel for each scenario](figure5.png)",
        "## The paper's claims",
        _table(
            ("claim", "", "verdict"),
            [(f"({judged.claim.letter})", judged.claim.title, f"**{judged.verdict.value}**") for judged in claims],
        ),
        *(_claim(judged) for judged in claims),
        "## Costs",
        _costs(results),
        "## How it was computed",
        _method(results, claims),
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
                    f"**{_mean(curve.final)}** of {optimum:g}",
                    _interval(mean_interval(curve.final)),
                    *_solved(curve, optimum),
                    _mean(curve.early),
                    _mean(curve.spread),
                )
            )
    header = ("scenario", "agent", "final score", "95 % interval", "at the optimum", "95 % interval", "early", "spread")
    early = f"Early: the mean over the first {early_limit(results.episodes):,} episodes."
    spread = (
        "Spread: a trial's standard deviation over the evaluations of the last third. All are means over the trials."
    )
    return f"{_table(header, rows)}\n\n{early} {spread}"


def _solved(curve: Curve, optimum: float) -> tuple[str, str]:
    trials = len(curve.final)
    if not trials:
        return NONE, NONE
    count = trials_solved(curve.final, optimum)
    return f"{count} of {trials}", _interval(share_interval(count, trials))


def _claim(judged: JudgedClaim) -> str:
    claim = judged.claim
    rows = [
        (
            finding.evidence.what,
            _figures(finding.evidence),
            _interval(finding.evidence.interval),
            _tails(finding.evidence.tails),
            _tails(finding.adjusted),
            _verdict(finding),
        )
        for finding in judged.findings
    ]
    header = ("", "measured", "95 % interval", "p, for / against", "after Holm", "verdict")
    return (
        f"### ({claim.letter}) {claim.title}: {judged.verdict.value}\n\n"
        f'The paper, section {claim.section}: "{claim.paper}".\n\n'
        f"{_table(header, rows)}\n\n{claim.rule}"
    )


def _costs(results: Results) -> str:
    by_agent = {agent: [cost for cost in results.costs if cost.agent == agent] for agent in results.agents}
    reference = {cost.scenario: cost for cost in by_agent.get("nested", [])}
    rows = [
        (cost.scenario, cost.agent, *(_ratio(cost, reference.get(cost.scenario), of) for of in COUNTS))
        for scenario in results.scenarios
        for agent in results.agents
        for cost in by_agent[agent]
        if cost.scenario == scenario
    ]
    header = ("scenario", "agent", "networks", "parameters", "updates, all trials", "steps, all trials")
    seconds = ", ".join(f"{agent} {sum(cost.seconds for cost in own):.1f}" for agent, own in by_agent.items() if own)
    return (
        f"{_table(header, rows)}\n\nIn brackets: times the nested agent's. Networks and parameters are one trial's, "
        f"target networks not counted.\n\nSeconds of training, the one figure that another run won't repeat: {seconds}."
    )


COUNTS = ("networks", "parameters", "updates", "env_steps")


def _ratio(cost: Cost, reference: Cost | None, of: str) -> str:
    count = getattr(cost, of)
    if reference is None or reference is cost or not getattr(reference, of):
        return f"{count:,}"
    return f"{count:,} ({count / getattr(reference, of):.2f})"


def _method(results: Results, claims: Sequence[JudgedClaim]) -> str:
    tests = 2 * sum(finding.evidence.tails is not None for judged in claims for finding in judged.findings)
    text = METHOD.format(
        alpha=ALPHA, tests=tests, splits=RESAMPLES + 1, resamples=RESAMPLES, smallest=_p(1 / (RESAMPLES + 1))
    )
    smallest = _smallest_p(results.trials)
    if results.trials > 1 and smallest * tests >= ALPHA:
        text += TOO_FEW_TRIALS.format(trials=results.trials, smallest=_p(smallest), tests=tests)
    return text


def _smallest_p(trials: int) -> float:
    """The p-value of a permutation test that finds no other split of the trials as extreme."""
    return max(1 / comb(2 * trials, trials), 1 / (RESAMPLES + 1))


def _figures(evidence: Evidence) -> str:
    return ", ".join(
        f"{name} {value:,}" if isinstance(value, int) else f"{name} {_two(value)}" for name, value in evidence.figures
    )


def _verdict(finding: Finding) -> str:
    missing = finding.evidence.missing
    return f"{finding.verdict.value}: {missing}" if missing else finding.verdict.value


def _mean(trials: Float64s) -> str:
    return _two(float(trials.mean())) if len(trials) else NONE


def _interval(interval: Interval | None) -> str:
    return f"{_two(interval.low)} to {_two(interval.high)}" if interval else NONE


def _tails(tails: Tails | None) -> str:
    return f"{_p(tails.claim)} / {_p(tails.against)}" if tails else NONE


def _p(p: float) -> str:
    if p < 0.00005:
        return "< 0.0001"
    return f"{p:.4f}" if p < 0.99995 else "1"


def _two(value: float) -> str:
    return f"{round(value, 2) + 0.0:.2f}"  # + 0.0: no minus before a zero


def _table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    lines = [header, ["---"] * len(header), *rows]
    # Users name scenarios, so bars may appear.
    return "\n".join(f"| {' | '.join(cell.replace('|', chr(92) + '|') for cell in line)} |" for line in lines)
