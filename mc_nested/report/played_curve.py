"""The curve of a training whose every episode is real: score against episodes played, and against game time."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from mc_nested.arrays import Float64s
from mc_nested.report.curve import MEAN, OPTIMUM
from mc_nested.report.game_time import ACTION_S, RESET_S
from mc_nested.report.played import Played

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
