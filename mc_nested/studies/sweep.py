"""The sensitivity study: one choice at a time that the paper leaves open is made otherwise (sweep.toml)."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mc_nested.arena.scenario import Scenario
from mc_nested.learn.preset import Preset
from mc_nested.studies.arm import Arm
from mc_nested.studies.change import Change, shipped_changes
from mc_nested.studies.config import StudyConfig
from mc_nested.studies.inference import Interval, mean_interval
from mc_nested.studies.study import Report, Study, StudyOptions
from mc_nested.studies.table import Cells, markdown_of, number_of_trials
from mc_nested.studies.trial import Trial, on_each, optimum_of, trial_table

COLUMNS = (
    "agent",
    "choice",
    "value",
    "scenario",
    "trial",
    "final_score",
    "best_score",
    "mean_score",
    "episodes_to_optimum",
)


def arms(options: StudyOptions) -> list[Arm]:
    """Return the base of each agent, and the changes."""
    preset = options.loaded_preset()
    found = varied(preset, options.scenarios)
    return [
        each.arm(each.name if each.choice else f"base, {each.agent}", each.agent, options, preset) for each in found
    ]


def varied(preset: Preset, scenarios: Sequence[Scenario]) -> list[Change]:
    """Return the shipped changes that change anything here; the base of each agent comes first."""
    changes = [each for each in shipped_changes("sweep.toml") if each.differs([each.agent], preset, scenarios)]
    agents = list(dict.fromkeys(["nested", *(each.agent for each in changes)]))
    return [*(Change(agent=agent) for agent in agents), *changes]


@dataclass(frozen=True)
class Effect:
    """What a change does on a scenario: its trials, and how far their scores are from the base's, with intervals.

    A base's differences are 0, without an interval.
    """

    arm: Arm
    trials: Sequence[Trial]
    final: float
    mean: float
    final_difference: float
    mean_difference: float
    final_interval: Interval | None
    mean_interval: Interval | None

    @property
    def choice(self) -> str:
        """What was chosen otherwise; empty for a base."""
        return self.arm.labels["choice"]


def effects_on(trials: Sequence[Trial], scenario: str) -> list[Effect]:
    """Return every arm's effect on that scenario, in the order of the arms."""
    found = {name: own for (name, where), own in on_each(trials).items() if where == scenario}
    effects = []
    for own in found.values():
        arm = own[0].arm
        base = found[f"base, {arm.agent}"]
        final, base_final = (np.array([trial.outcome.score for trial in each]) for each in (own, base))
        mean, base_mean = (np.array([np.mean(trial.scores) for trial in each]) for each in (own, base))
        tested = bool(arm.labels["choice"]) and len(own) > 1
        effects.append(
            Effect(
                arm=arm,
                trials=own,
                final=float(final.mean()),
                mean=float(mean.mean()),
                final_difference=float(final.mean() - base_final.mean()),
                mean_difference=float(mean.mean() - base_mean.mean()),
                final_interval=mean_interval(final - base_final) if tested else None,
                mean_interval=mean_interval(mean - base_mean) if tested else None,
            )
        )
    return effects


LEGEND = """\
Final: the greedy score of the policy that a run keeps. Mean over the training: over all of a run's greedy evaluations,
so it is high where learning is early and steady. Both are means over the trials. Intervals are Student's t of
the difference from the same agent's base, trial by trial, and none is corrected for being one of many: of {many} some
{false:.0f} leave out 0 by chance alone. Best: the highest greedy score of any trial. At the
optimum: trials that ever reached it. Episodes to it: the median over those."""


def report(config: StudyConfig, trials: Sequence[Trial]) -> Report:
    """Report a table for each scenario with the effect of each change."""
    optimum = optimum_of(trials)
    effects = {scenario: effects_on(trials, scenario) for scenario in optimum}
    many = 2 * sum(effect.final_interval is not None for own in effects.values() for effect in own)
    base = trials[0].arm
    what = f"One choice at a time changed from the preset `{base.short_preset}`, seed {config.seed}"
    each = f"{number_of_trials(config.trials)} of {base.preset.episodes:,} episodes for each variant and scenario"
    tables = [
        f"## {scenario}, optimum {optimum[scenario]:g}\n\n{markdown_of([_line(effect) for effect in own])}"
        for scenario, own in effects.items()
    ]
    return Report(
        text=[
            "# What each choice does",
            f"{what}: {each}.",
            "![Differences from the base, a panel for each scenario](sweep.png)",
            *tables,
            LEGEND.format(many=many, false=0.05 * many).replace("\n", " "),
        ],
        figure=_figure(effects, optimum),
        tables={"sweep.csv": trial_table(trials, COLUMNS)},
    )


def _line(effect: Effect) -> Cells:
    is_base = not effect.choice
    reached = [trial.episodes_to_optimum for trial in effect.trials if trial.episodes_to_optimum is not None]
    return (
        ("agent", effect.arm.agent),
        ("choice", "**base**" if is_base else effect.choice),
        ("value", effect.arm.labels["value"]),
        ("final score", f"{effect.final:.2f}"),
        ("against the base", "" if is_base else _signed(effect.final_difference)),
        ("95 % interval", _interval(effect.final_interval)),
        ("mean over the training", f"{effect.mean:.2f}"),
        ("against the base", "" if is_base else _signed(effect.mean_difference)),
        ("95 % interval", _interval(effect.mean_interval)),
        ("best", f"{max(trial.best_score for trial in effect.trials):g}"),
        ("at the optimum", f"{len(reached)} of {len(effect.trials)}"),
        ("episodes to it", f"{median(reached):,.0f}" if reached else ""),
    )


def _interval(interval: Interval | None) -> str:
    return f"{_signed(interval.low)} to {_signed(interval.high)}" if interval else ""


def _signed(value: float) -> str:
    return f"{round(value, 2) + 0.0:+.2f}"  # + 0.0: no minus before a zero


FINAL, MEAN = "#0072B2", "#E69F00"
"""Okabe and Ito's colours, distinguishable with any colour vision."""

APART = 0.17
"""Between the two marks of a line, in lines."""


def _figure(effects: dict[str, list[Effect]], optimum: dict[str, float]) -> Figure:
    """Draw a panel for each scenario, a line for each change: how far its scores are from the base's."""
    changed = {scenario: [effect for effect in own if effect.choice] for scenario, own in effects.items()}
    lines = max(map(len, changed.values()), default=0)
    figure = Figure(figsize=(3.4 + 3.2 * len(effects), 1.6 + 0.3 * lines), dpi=140, layout="constrained")
    panels = figure.subplots(1, len(effects), sharey=True, squeeze=False)[0]
    for axes, (scenario, own) in zip(panels, changed.items(), strict=True):
        _draw(axes, own)
        base = next(effect for effect in effects[scenario] if not effect.choice)
        title = f"{scenario}\nbase {base.final:.1f}, mean {base.mean:.1f} of {optimum[scenario]:g}"
        axes.set_title(title, parse_math=False, fontsize=10)  # users name scenarios, so dollar signs may appear
        axes.set_xlabel("score above the base")
    names = [f"{effect.choice}: {effect.arm.labels['value']}" for effect in next(iter(changed.values()))]
    panels[0].set_yticks(range(lines), names)
    panels[0].set_ylim(lines - 0.5, -0.5)
    ends = "mean over the training; lines: 95 % intervals, filled: 0 is outside"
    marks = (("final score", FINAL, "o"), (ends, MEAN, "D"))
    legend = [Line2D([], [], color=color, marker=mark, markersize=4.5, label=label) for label, color, mark in marks]
    figure.legend(handles=legend, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _draw(axes: Axes, effects: Sequence[Effect]) -> None:
    axes.axvline(0, color="black", linewidth=0.8, zorder=1)
    for line, effect in enumerate(effects):
        _mark(axes, line - APART, effect.final_difference, effect.final_interval, FINAL, "o")
        _mark(axes, line + APART, effect.mean_difference, effect.mean_interval, MEAN, "D")
    axes.grid(axis="x", alpha=0.2)
    axes.tick_params(left=False)
    axes.spines[["top", "right", "left"]].set_visible(False)


def _mark(axes: Axes, line: float, difference: float, interval: Interval | None, color: str, marker: str) -> None:
    """Draw a mark with its interval, filled where that leaves out 0."""
    if interval:
        axes.plot([interval.low, interval.high], [line, line], color=color, linewidth=1.4, zorder=2)
    is_clear = interval is not None and (interval.low > 0 or interval.high < 0)
    face = color if is_clear else "white"
    axes.plot([difference], [line], marker=marker, markersize=4.5, color=color, markerfacecolor=face, zorder=3)


STUDY = Study(
    name="sweep",
    what="Vary each choice that the paper leaves open, one at a time. The defaults take some ten minutes on two cores.",
    options={"trials": 5, "episodes": 1000, "seed": 0, "scenario": None, "layer": None, "preset": "paper"},
    arms=arms,
    report=report,
    files={"table": "sweep.md", "plot": "sweep.png", "rows": "sweep.csv"},
)
