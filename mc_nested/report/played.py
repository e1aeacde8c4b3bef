"""The real episodes of a training in the order they were played: score, and minutes of game time until its end."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mc_nested.arrays import Bools, Float64s
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.report.game_time import minutes_of


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
