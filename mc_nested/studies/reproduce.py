"""The paper's experiment: agents x scenarios x trials with one preset, some of them for longer; its claims judged."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import MaxNLocator, StrMethodFormatter

from mc_nested.errors import UserError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.preset import MOST
from mc_nested.report.curve import t_interval
from mc_nested.studies.arm import Arm
from mc_nested.studies.claim_text import claim_section, found_of, method, row_of
from mc_nested.studies.claims.contests import HIERARCHICAL, NESTED, UNSOLVED
from mc_nested.studies.claims.judge import MEGA, judge, trials_solved
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.inference import coverage, share_interval
from mc_nested.studies.results import Cost, Curve, Results, early_limit, results_of
from mc_nested.studies.study import Report, Study, StudyOptions, with_episodes
from mc_nested.studies.table import (
    NONE,
    Cells,
    Table,
    interval,
    interval_of_mean,
    markdown,
    markdown_of,
    mean,
    number_of_trials,
)
from mc_nested.studies.trial import Trial, greedy_table

LONGER_AGENTS, LONGER_SCENARIOS = (NESTED, HIERARCHICAL), UNSOLVED
"""The paper's appendix says that these would reach the optimum with more training."""

LONGER = "-longer"
"""Ends the names of the longer arms."""


def arms(options: StudyOptions) -> list[Arm]:
    """Return an arm of each agent, and of some that are trained for longer."""
    for name in options.agent:
        if name not in AGENT_SPECS:
            raise UserError(f"no agent {name!r}: choose one of {', '.join(AGENT_SPECS)}")
    preset = options.loaded_preset()
    agents = [agent for agent in AGENT_SPECS if agent in (options.agent or AGENT_SPECS)]
    usual = [Arm(agent, preset, options.scenarios, options.trials, agent, options.preset) for agent in agents]
    if not options.longer:
        return usual
    scenarios = [scenario for scenario in options.scenarios if scenario.name in LONGER_SCENARIOS]
    whose = [agent for agent in agents if agent in LONGER_AGENTS]
    if not (whose and scenarios):
        raise UserError(
            f"--longer is for {' and '.join(LONGER_AGENTS)} on {' and '.join(LONGER_SCENARIOS)}: "
            f"leave it out, or name one of each"
        )
    longer = with_episodes(preset, min(options.longer * preset.episodes, MOST))
    return usual + [Arm(agent + LONGER, longer, scenarios, options.trials, agent, options.preset) for agent in whose]


COLUMNS = ("agent", "scenario", "trial", "episode", "score", "material", "steps")


def report(config: StudyConfig, trials: Sequence[Trial]) -> Report:
    """Report the paper's Figure 5, and each of its claims with its verdict; the longer trainings decide claim (f)."""
    usual = [trial for trial in trials if not trial.arm.name.endswith(LONGER)]
    for_longer = [trial for trial in trials if trial.arm.name.endswith(LONGER)]
    results = results_of(usual, config.seed)
    longer = results_of(for_longer, config.seed) if for_longer else None
    tables = {"results.csv": greedy_table(usual, COLUMNS)}
    if for_longer:
        tables["results_longer.csv"] = greedy_table(for_longer, COLUMNS)
    return report_on(results, longer, tables)


def report_on(results: Results, longer: Results | None, tables: dict[str, Table]) -> Report:
    """Return the report of these results, and of those with ten times the episodes.

    The same results give the same report. Seconds are only in lines that name seconds: the only lines that differ if
    the same experiment is repeated.
    """
    claims = judge(results, longer)
    rows = [row_of(each) for each in claims]
    return Report(
        text=[
            "# The paper's experiment, repeated",
            _what_was_run(results, longer),
            _scores(results),
            "![Score of a greedy episode against training episodes, a panel for each scenario](figure5.png)",
            *_bands(results),
            "## The paper's claims",
            markdown(("claim", "", "verdict"), [(*about, f"**{words}**") for *about, words in rows]),
            *(claim_section(judged) for judged in claims),
            "## Costs",
            _costs(results),
            "## How it was computed",
            method(claims, results.trials, results.keeps_best),
        ],
        figure=figure5(results),
        tables=tables,
        found={"claims": [found_of(each) for each in claims]},
        shown=Table(("", "the paper's claim", "verdict"), rows),
    )


EXPLAINED = """\
Final: the score of the policy that a trial keeps. Last ten: the mean of a trial's last ten
evaluations, or of those in the last third of its training where these are fewer. Early: the mean
over the first {early:,} episodes. Spread: a trial's standard deviation over the evaluations of the last third. All are
means over the trials. At the optimum: trials whose final score is. Held: how often such an interval holds the mean, in
experiments of as many trials drawn from these."""

BANDS = """\
The bands are 95 % intervals of the mean. There is none where half of the trials or more are at the optimum. In
experiments drawn from each point's own trials, such an interval held the mean in {middle:.0f} % (median of all points;
{lowest:.0f} % at least)."""


def _what_was_run(results: Results, longer: Results | None) -> str:
    trials = number_of_trials(results.trials)
    further = f" A second run, of {longer.episodes:,} episodes, is there for claim (f) alone." if longer else ""
    return (
        f"Preset `{results.preset}`, seed {results.seed}: {trials} of {results.episodes:,} episodes for each agent and "
        f"scenario, a greedy evaluation every {results.evaluate_every} episodes.{further}"
    )


def _scores(results: Results) -> str:
    rows = []
    for scenario in results.scenarios:
        for agent in results.agents:
            curve, optimum = results.curves[agent, scenario], results.optimum[scenario]
            rows.append(
                (
                    ("scenario", scenario),
                    ("agent", agent),
                    ("final score", f"**{mean(curve.final)}** of {optimum:g}"),
                    ("95 % interval", interval_of_mean(curve.final, optimum)),
                    ("last ten", mean(curve.last_ten)),
                    ("95 % interval", interval_of_mean(curve.last_ten, optimum)),
                    *zip(("at the optimum", "95 % interval"), _solved(curve, optimum), strict=True),
                    ("early", mean(curve.early)),
                    ("spread", mean(curve.spread)),
                )
            )
    return f"{markdown_of(rows)}\n\n{EXPLAINED.format(early=early_limit(results.episodes))}"


def _bands(results: Results) -> list[str]:
    """Return how often the picture's bands hold the mean; nothing where there is none."""
    curves = [(curve, results.optimum[scenario]) for (_, scenario), curve in results.curves.items()]
    held = [coverage(curve.scores, optimum) for curve, optimum in curves if len(curve.scores) > 1]
    given = np.concatenate([own[~np.isnan(own)] for own in held] or [np.empty(0)])
    return [BANDS.format(middle=100 * np.median(given), lowest=100 * given.min())] if len(given) else []


def _solved(curve: Curve, optimum: float) -> tuple[str, str]:
    trials = len(curve.final)
    if not trials:
        return NONE, NONE
    count = trials_solved(curve.final, optimum)
    return f"{count} of {trials}", interval(share_interval(count, trials))


def _costs(results: Results) -> str:
    keys = [(agent, scenario) for scenario in results.scenarios for agent in results.agents]
    costs = {key: results.costs[key] for key in keys if key in results.costs}
    rows = [
        (("scenario", scenario), ("agent", agent), *cost_cells(cost, costs.get((NESTED, scenario))))
        for (agent, scenario), cost in costs.items()
    ]
    spent: dict[str, float] = {}
    for (agent, _), cost in costs.items():
        spent[agent] = spent.get(agent, 0.0) + cost.seconds
    seconds = ", ".join(f"{agent} {own:.1f}" for agent, own in spent.items())
    return (
        f"{markdown_of(rows)}\n\nIn brackets: times the nested agent's. Networks and parameters are one trial's, "
        f"target networks not counted.\n\nSeconds of training, which another run won't repeat: {seconds}. They count "
        "what is compiled first, and batches are of unequal size: so they aren't judged. `python scripts/bench.py "
        "costs` trains the agents by turns, and judges claims (i): nested takes fewer seconds than the others."
    )


def cost_cells(cost: Cost, reference: Cost | None = None) -> Cells:
    """Return the cells of a table, in brackets how many times the reference's a count is."""
    return (
        ("networks", _ratio(cost, reference, "networks")),
        ("parameters", _ratio(cost, reference, "parameters")),
        ("updates, all trials", _ratio(cost, reference, "updates")),
        ("steps, all trials", _ratio(cost, reference, "env_steps")),
        ("replays, MB a trial", mean(np.array(cost.replay_bytes) / MEGA)),
    )


def _ratio(cost: Cost, reference: Cost | None, of: str) -> str:
    count = getattr(cost, of)
    if reference is None or reference is cost or not getattr(reference, of):
        return f"{count:,}"
    return f"{count:,} ({count / getattr(reference, of):.2f})"


CURVES: dict[str, dict[str, Any]] = {
    "nested": {"color": "#0072B2", "linestyle": "-"},
    "hierarchical": {"color": "#D55E00", "linestyle": "-"},
    "single": {"color": "#009E73", "linestyle": (0, (4, 1.2))},
}
"""Okabe and Ito's colours, distinguishable with any colour vision."""

OPTIMUM: dict[str, Any] = {"color": "black", "linewidth": 0.8}
BUILDER: dict[str, Any] = {"color": "black", "linewidth": 2.6, "linestyle": (0, (1, 4))}
"""Wide dots, so that the line is visible even if the builder's score is the optimum."""

BAND = 0.18
"""Opacity of the intervals."""

ACROSS = 3
"""Panels beside each other at most."""


def figure5(results: Results) -> Figure:
    """Draw a panel for each scenario, greedy score against training episode, a curve for each agent.

    The same results give the same bytes with the same matplotlib.
    """
    columns = min(ACROSS, len(results.scenarios))
    rows = -(-len(results.scenarios) // columns)
    figure = Figure(figsize=(max(6.0, 4.3 * columns), 3.8 * rows + 0.5), dpi=160, layout="constrained")
    panels = list(figure.subplots(rows, columns, sharey=True, squeeze=False).flat)
    for axes, scenario in zip(panels, results.scenarios, strict=False):
        axes.axhline(results.optimum[scenario], zorder=1, **OPTIMUM)
        axes.axhline(results.builder[scenario], zorder=1, **BUILDER)
        for agent in results.agents:
            draw_curve(axes, results.curves[agent, scenario], results.optimum[scenario], CURVES[agent])
        axes.set_title(scenario, parse_math=False)  # users name scenarios, so dollar signs may appear
        axes.set_xlabel("training episodes")
        axes.set_xlim(0, results.episodes)
        axes.xaxis.set_major_locator(MaxNLocator(3, integer=True))
        axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))
        axes.grid(alpha=0.2)
        axes.spines[["top", "right"]].set_visible(False)
    for first in panels[::columns]:
        first.set_ylabel("score of a greedy episode")
    for unused in panels[len(results.scenarios) :]:
        unused.remove()
    figure.legend(handles=_legend(results), loc="outside lower center", ncols=2 * columns, frameon=False)
    return figure


def draw_curve(axes: Axes, curve: Curve, optimum: float, look: Mapping[str, Any], label: str | None = None) -> None:
    """Draw the mean over the trials with its interval; nothing where there was no evaluation."""
    if not len(curve.episodes):
        return
    if len(curve.scores) > 1:
        low, high = t_interval(curve.scores, optimum)
        axes.fill_between(curve.episodes, low, high, color=look["color"], alpha=BAND, linewidth=0)
    marker = "o" if len(curve.episodes) == 1 else ""
    axes.plot(curve.episodes, curve.scores.mean(axis=0), marker=marker, linewidth=1.5, label=label, **look)


def _legend(results: Results) -> list[Artist]:
    of = f"mean of {results.trials} trials" if results.trials > 1 else "one trial"
    curves: list[Artist] = [
        Line2D([], [], linewidth=1.5, label=f"{agent}, {of}", **CURVES[agent]) for agent in results.agents
    ]
    band = [Patch(color="black", alpha=BAND, linewidth=0, label="95 % interval")] if results.trials > 1 else []
    optimum = Line2D([], [], label="optimum", **OPTIMUM)
    builder = Line2D([], [], label="scripted builder", **BUILDER)
    return [*curves, *band, optimum, builder]


STUDY = Study(
    name="reproduce",
    what="Repeat the paper's experiment and test its claims. The defaults take some minutes on two cores.",
    options={
        "trials": 10,
        "episodes": None,
        "seed": 0,
        "scenario": None,
        "layer": None,
        "agent": None,
        "preset": "paper",
        "engine": None,
        "device": None,
        "longer": None,
    },
    arms=arms,
    report=report,
    files={"report": "report.md", "figure": "figure5.png", "table": "results.csv"},
    further_files=("figure5.svg",),
    folder="figure5",
)
