"""The learning curve: score against episode, the mean over the trials with a 95 % interval (paper, Figure 5).

Where every episode is real, it is each trial's episodes in the order they were played, by number and by game time.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from scipy.special import stdtrit

from mc_nested.arrays import Bools, Float64s
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.report.game_time import ACTION_S, RESET_S, minutes_of

MEAN, OPTIMUM = "#1f5f8b", "#3a7d44"


def draw_curve(path: Path, title: str, episodes: Sequence[int], scores: Float64s, optimum: float) -> None:
    """Write a PNG of greedy scores (trials, evaluations) at those episodes, with the optimum as a line."""
    figure = Figure(figsize=(8, 4.5), dpi=120, layout="constrained")
    axes = figure.subplots()
    axes.axhline(optimum, color=OPTIMUM, linestyle="--", linewidth=1.2, label=f"optimum {optimum:g}")
    trials = len(scores)
    if len(episodes):
        if trials > 1:
            low, high = t_interval(scores, optimum)
            axes.fill_between(episodes, low, high, color=MEAN, alpha=0.2, linewidth=0, label="95 % interval")
        label = f"mean of {trials} trials" if trials > 1 else "one trial"
        marker = "o" if len(episodes) == 1 else None
        axes.plot(episodes, scores.mean(axis=0), color=MEAN, linewidth=1.6, marker=marker, label=label)
    axes.set_title(title, parse_math=False)  # users name scenarios, so dollar signs may appear
    axes.set(xlabel="training episodes", ylabel="score of a greedy episode")
    axes.grid(alpha=0.25)
    axes.legend(loc="lower right", frameon=False)
    figure.savefig(path, format="png", metadata={"Software": None})


def t_interval(scores: Float64s, highest: float = np.inf) -> tuple[Float64s, Float64s]:
    """Return Student's t interval (95 %) of the mean of two trials or more (trials, evaluations), cut at ``highest``.

    No mean can be above the highest score, so the cut costs no coverage. NaN where half of the trials or more are at
    it: of such trials the interval would hold the mean far less often than it says (studies/inference.py: coverage).
    Where all trials agree it has no width: that says that none of them differed, not that no other would.
    """
    mean = scores.mean(axis=0)
    half = stdtrit(len(scores) - 1, 0.975) * scores.std(axis=0, ddof=1) / np.sqrt(len(scores))
    half = np.where((scores >= highest).mean(axis=0) < 0.5, half, np.nan)
    return mean - half, np.minimum(mean + half, highest)


def align_trials(evaluations: Sequence[tuple[int, int, float]], trials: int) -> tuple[list[int], Float64s]:
    """Return episodes and scores (trials, evaluations) from (trial, episode, score) rows.

    A trial that finished early keeps its last score, that of the policy it keeps; episodes that some trial has not
    reached yet are left out.
    """
    by_trial: list[dict[int, float]] = [{} for _ in range(trials)]
    for trial, episode, score in evaluations:
        by_trial[trial][episode] = score
    if not all(by_trial):
        return [], np.zeros((trials, 0))
    first = max(min(scores) for scores in by_trial)
    episodes = sorted({episode for scores in by_trial for episode in scores if episode >= first})
    scores = np.empty((trials, len(episodes)))
    for trial, own in enumerate(by_trial):
        last = own[min(own)]
        for column, episode in enumerate(episodes):
            last = own.get(episode, last)
            scores[trial, column] = last
    return episodes, scores


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
