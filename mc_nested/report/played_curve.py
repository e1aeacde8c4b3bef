"""The curve of a training whose every episode is real: score against episodes played, and against game time.

The real episodes of a training in the order they were played: score, and minutes of game time until its end.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from mc_nested.arrays import Bools, Float64s
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.report.curve import MEAN, OPTIMUM
from mc_nested.report.game_time import ACTION_S, RESET_S, minutes_of


@dataclass(frozen=True)
class Played:
    """One trial's real episodes, each array (episodes,): score, whether it was an evaluation, minutes until its end."""

    scores: Float64s
    greedy: Bools
    minutes: Float64s


def played_by(episodes: Sequence[EpisodeRow], evaluations: Sequence[EvaluationRow], trials: int) -> list[Played]:
    """Return each trial's real episodes; an evaluation comes after the training episode whose number it has."""
    found = []
    for trial in range(trials):
        rows = [(row.episode, False, row.score, row.steps) for row in episodes if row.trial == trial]
        rows += [(row.episode, True, row.score, row.steps) for row in evaluations if row.trial == trial]
        rows.sort(key=lambda row: row[:2])
        steps = np.cumsum([row[3] for row in rows], dtype=np.int64)
        found.append(
            Played(
                scores=np.array([row[2] for row in rows], dtype=np.float64),
                greedy=np.array([row[1] for row in rows], dtype=np.bool_),
                minutes=np.array([minutes_of(at + 1, int(so_far)) for at, so_far in enumerate(steps)]),
            )
        )
    return found


EVALUATED = "#d1672a"


def draw_played_curve(path: Path, title: str, trials: Sequence[Played], optimum: float) -> None:
    """Write a PNG of every real episode's score, each trial a line: by its number above, by minutes played below."""
    figure = Figure(figsize=(8, 7), dpi=120, layout="constrained")
    above, below = figure.subplots(2, 1)
    for axes, by_time in ((above, False), (below, True)):
        axes.axhline(optimum, color=OPTIMUM, linestyle="--", linewidth=1.2, label=f"optimum {optimum:g}")
        for number, trial in enumerate(trials):
            along = trial.minutes if by_time else np.arange(1.0, len(trial.scores) + 1)
            _draw_trial(axes, along, trial, named=number == 0)
        axes.set(ylabel="score of the episode")
        axes.grid(alpha=0.25)
    above.set_title(title, parse_math=False)  # users name scenarios, so dollar signs may appear
    above.set_xlabel("real episodes")
    above.xaxis.set_major_locator(MaxNLocator(integer=True))
    below.set_xlabel(f"minutes of game time, at {ACTION_S:g} s an action and {RESET_S:g} s a reset")
    below.set_xlim(left=0)
    # The legend stands outside the plot: points may be anywhere in it.
    figure.legend(*above.get_legend_handles_labels(), loc="outside lower center", ncols=3, frameon=False)
    figure.savefig(path, format="png", metadata={"Software": None})


def _draw_trial(axes: Axes, along: Float64s, trial: Played, *, named: bool) -> None:
    """Draw one trial as a line with a point for each episode; only one trial has a name in the legend."""
    axes.plot(along, trial.scores, color=MEAN, linewidth=1.0, alpha=0.5)
    for kind, color, size, name in (
        (~trial.greedy, MEAN, 16, "an episode of training"),
        (trial.greedy, EVALUATED, 36, "a greedy evaluation"),
    ):
        axes.scatter(
            along[kind], trial.scores[kind], color=color, s=size, zorder=3, label=name if named else "_nolegend_"
        )
