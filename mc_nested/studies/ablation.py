"""The ablation: the preset model-based with each part off in turn, beside the model-free preset tuned (ablation.toml).

The study takes no preset as an option: its parts belong to those two.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from mc_nested.arrays import Float64s
from mc_nested.learn.preset import load_preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.change import shipped_changes
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.inference import RESAMPLES, Interval, percentiles
from mc_nested.studies.profiles import played_by
from mc_nested.studies.study import Report, Study, StudyOptions, with_episodes
from mc_nested.studies.table import Cells, episodes, markdown_of, number_of_trials
from mc_nested.studies.trial import Trial, on_each, optimum_of, trial_table

MODEL_BASED = "model-based"

LIVE_EPISODES = 30
"""The most real episodes of a trial of model-based.

The whole preset needs half of them, and a part that fails to teach the networks uses up the whole budget of a practice
between every two of them.
"""

COLUMNS = ("part", "base", "scenario", "trial", "optimum", "best_score", "played_to_optimum", "updates")


def arms(options: StudyOptions) -> list[Arm]:
    """Return the shipped parts. A trial of what practises trains alone, since nothing is quicker in a batch."""
    found = []
    for part in shipped_changes("ablation.toml"):
        most = options.episodes or (LIVE_EPISODES if part.base == MODEL_BASED else None)
        preset = with_episodes(part.preset_from(load_preset(part.base)), most)
        found.append(
            Arm(
                name=part.choice,
                preset=preset,
                preset_name=part.base,
                scenarios=options.scenarios,
                trials=options.trials,
                labels={"part": part.choice, "base": part.base, "what": part.what},
                stop_at_optimum=True,
                together=1 if preset.imagination else options.trials,
            )
        )
    return found


@dataclass(frozen=True)
class PartMeasures:
    """One part on one scenario: episodes (trials,), infinite where never solved; no interval for one trial."""

    arm: Arm
    played: Float64s
    solved: int
    median: float
    interval: Interval | None
    worst: float
    best_score: float
    updates: float


def measures_of(trials: Sequence[Trial]) -> PartMeasures:
    """Return what a part comes to on one scenario."""
    played = played_by(trials)
    return PartMeasures(
        arm=trials[0].arm,
        played=played,
        solved=int(np.isfinite(played).sum()),
        median=float(np.median(played)),
        interval=_interval_of_median(played),
        worst=float(played.max()),
        best_score=max(trial.best_score for trial in trials),
        updates=float(np.median([trial.outcome.updates for trial in trials])),
    )


def _interval_of_median(played: Float64s) -> Interval | None:
    """Take a percentile bootstrap, always the same for the same trials."""
    if len(played) < 2:
        return None
    drawn = np.random.default_rng(0).integers(len(played), size=(RESAMPLES, len(played)))
    return percentiles(np.median(played[drawn], axis=1))


WHAT_IT_IS = """\
The preset `model-based` is double Q-learning alone: there is no imitation in it, of its own episodes or of anybody's.
The first line has all of its parts, and each of the next ones is without one, or with another value. `tuned` is the
model-free preset, which has no learnt game: excursions find the build, and it imitates its best episode."""

LEGEND = """\
Solved: trials with a greedy episode at the optimum. Median and worst: real episodes played until then, that one and the
other greedy ones included; a trial that was never there counts as infinite (∞). The interval is a percentile bootstrap
of the median over the trials; with few trials it is too narrow. Best score: the highest of any greedy episode. Updates:
of all networks of a trial until it was solved or given up. Given up after: that many training episodes."""


def report(config: StudyConfig, trials: Sequence[Trial]) -> Report:
    """Report a table for each scenario, with a line for each part that is off."""
    optimum = optimum_of(trials)
    parts = on_each(trials).items()
    found = {scenario: [measures_of(own) for (_, on), own in parts if on == scenario] for scenario in optimum}
    of_each = f"{number_of_trials(config.trials)} of each line on each design"
    tables = [
        f"## {scenario}, optimum {optimum[scenario]:g}\n\n{markdown_of([_line(part) for part in own])}"
        for scenario, own in found.items()
    ]
    return Report(
        text=[
            "# What each part of the learning does",
            f"Real episodes to the optimum: {of_each}, seed {config.seed}.",
            WHAT_IT_IS.replace("\n", " "),
            "![Episodes to the optimum, a panel for each design, a line for each part](ablation.png)",
            *tables,
            LEGEND.replace("\n", " "),
        ],
        figure=_figure(found),
        tables={"ablation.csv": trial_table(trials, COLUMNS)},
    )


def _line(measures: PartMeasures) -> Cells:
    interval = measures.interval if measures.interval and np.isfinite(measures.interval.low) else None
    ends = f" ({episodes(interval.low)} to {episodes(interval.high)})" if interval else ""
    return (
        ("what is off", measures.arm.name),
        ("what that means", measures.arm.labels["what"]),
        ("solved", f"{measures.solved} of {len(measures.played)}"),
        ("median (95 %)", f"{episodes(measures.median)}{ends}"),
        ("worst", episodes(measures.worst)),
        ("best score", f"{measures.best_score:g}"),
        ("updates, median", f"{measures.updates:,.0f}"),
        ("given up after", f"{measures.arm.preset.episodes:,}"),
    )


TRIAL, MEDIAN, WITHOUT = "#56B4E9", "#0072B2", "#D55E00"
"""Okabe and Ito's colours, distinguishable with any colour vision: a trial, a median, and a median of never."""

NEVER = 1.8
"""How far beyond the longest trial the line for "never" stands, as a factor."""

SPREAD = 0.28
"""How far the trials of a line lie apart from its middle at most, in lines."""


def _figure(found: dict[str, list[PartMeasures]]) -> Figure:
    """Draw a panel for each scenario, a line for each part that is off, a mark for each trial and its median."""
    parts = [part.arm.name for part in next(iter(found.values()))]
    size = (3.0 + 3.2 * len(found), 1.6 + 0.34 * len(parts))
    figure = Figure(figsize=size, dpi=140, layout="constrained")
    every_axes = figure.subplots(1, len(found), sharey=True, squeeze=False)[0]
    solved = [float(each) for own in found.values() for part in own for each in part.played[np.isfinite(part.played)]]
    never = NEVER * max([10.0, *solved])
    for axes, (scenario, own) in zip(every_axes, found.items(), strict=True):
        _draw(axes, own, never)
        axes.set_title(scenario, parse_math=False, fontsize=10)  # users name scenarios: dollar signs may appear
        axes.set_xlabel("real episodes to the optimum")
    every_axes[0].set_yticks(range(len(parts)), parts)
    every_axes[0].set_ylim(len(parts) - 0.5, -0.5)
    median: dict[str, Any] = {"marker": "|", "markersize": 11, "markeredgewidth": 2.4, "linestyle": ""}
    legend = [
        Line2D([], [], color=TRIAL, marker="o", markersize=4, linestyle="", label="a trial"),
        Line2D([], [], color=MEDIAN, label="the median", **median),
        Line2D([], [], color=WITHOUT, label="median: never", **median),
    ]
    figure.legend(handles=legend, loc="outside lower center", ncols=3, frameon=False)
    return figure


def _draw(axes: Axes, found: Sequence[PartMeasures], never: float) -> None:
    for line, measures in enumerate(found):
        if line and measures.arm.preset_name != found[line - 1].arm.preset_name:
            axes.axhline(line - 0.5, color="black", linewidth=0.6)
        _draw_line(axes, line, measures, never)
    axes.axvline(never, color="black", linewidth=0.8, linestyle=(0, (1, 3)))
    axes.text(never, 1.005, "never", transform=axes.get_xaxis_transform(), ha="right", va="bottom", fontsize=8)
    axes.set_xscale("log")
    axes.set_xlim(1, never)
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:,.0f}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(axis="x", alpha=0.2)
    axes.tick_params(left=False)
    axes.spines[["top", "right", "left"]].set_visible(False)


def _draw_line(axes: Axes, line: int, measures: PartMeasures, never: float) -> None:
    count = len(measures.played)
    heights = line + (np.linspace(-SPREAD, SPREAD, count) if count > 1 else np.zeros(1))
    shown = np.minimum(np.sort(measures.played), never)
    axes.plot(shown, heights, "o", markersize=4, color=TRIAL, markeredgewidth=0, clip_on=False)
    median = min(measures.median, never)
    color = MEDIAN if np.isfinite(measures.median) else WITHOUT
    axes.plot([median] * 2, [line - 0.36, line + 0.36], color=color, linewidth=2.4, clip_on=False)
    on_the_left = median > never / 3
    beside: dict[str, Any] = {"xytext": (-5 if on_the_left else 5, 0), "ha": "right" if on_the_left else "left"}
    label = episodes(measures.median)
    axes.annotate(label, (median, line), textcoords="offset points", fontsize=8, va="center", **beside)


STUDY = Study(
    name="ablation",
    what="Turn off each part of the preset model-based in turn, beside the preset tuned. The defaults take about an "
    "hour on two cores; a trial of model-based has 30 episodes at most unless --episodes says otherwise.",
    options={"trials": 10, "episodes": None, "seed": 0, "scenario": None, "layer": None},
    arms=arms,
    report=report,
    files={"table": "ablation.md", "plot": "ablation.png", "rows": "ablation.csv"},
)
