"""The learning curve: score against episode, the mean over the trials with a 95 % interval (paper, Figure 5)."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from scipy.special import stdtrit

from mc_nested.arrays import Float64s

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
