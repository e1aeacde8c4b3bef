"""What is measured per trial: its early score, its final score, the mean of its last ten, and its late spread."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mc_nested.arrays import Bools, Float64s, Int64s
from mc_nested.report.curve import align_trials
from mc_nested.studies.trial import Trial

EARLY_EPISODES = 1000
"""Early is the first 1,000 episodes, or the first third of a training of fewer than 3,000."""


LAST = 10
"""Evaluations whose mean stands beside the final score, which is a single one."""


def early_limit(episodes: int) -> int:
    """Return the last episode that counts as early in a training of that many."""
    return min(EARLY_EPISODES, episodes // 3)


@dataclass(frozen=True)
class Curve:
    """The greedy scores of an agent on a scenario.

    Args:
        episodes: training episodes before each evaluation, (evaluations,).
        scores: greedy scores, (trials, evaluations).
        trained: episodes of the whole training.
        keeps_best: whether the policy kept is the best, not the last.
    """

    episodes: Int64s
    scores: Float64s
    trained: int
    keeps_best: bool

    @property
    def final(self) -> Float64s:
        """The score of each trial's policy, the last or the best, (trials,); empty where not every was evaluated."""
        if not len(self.episodes):
            return np.empty(0)
        best: Float64s = self.scores.max(axis=1)
        return best if self.keeps_best else self.scores[:, -1]

    @property
    def last_ten(self) -> Float64s:
        """Each trial's mean over the last ten evaluations, (trials,); empty where none is late.

        Over those of the last third of the training where they are fewer.
        """
        late = self.scores[:, self._late()][:, -LAST:]
        return late.mean(axis=1) if late.shape[1] else np.empty(0)

    @property
    def early(self) -> Float64s:
        """Each trial's mean score over the early evaluations, (trials,); empty where there are none."""
        early = self.episodes <= early_limit(self.trained)
        return self.scores[:, early].mean(axis=1) if early.any() else np.empty(0)

    @property
    def spread(self) -> Float64s:
        """Each trial's standard deviation over the evaluations of the last third; empty where there are not two."""
        late = self._late()
        return self.scores[:, late].std(axis=1, ddof=1) if late.sum() > 1 else np.empty(0)

    def _late(self) -> Bools:
        return 3 * self.episodes > 2 * self.trained


def curve_of(trials: Sequence[Trial]) -> Curve:
    """Return the curve of an arm's trials on a scenario."""
    preset = trials[0].arm.preset
    rows = [(trial.number, row.episode, row.score) for trial in trials for row in trial.outcome.evaluations]
    episodes, scores = align_trials(rows, len(trials))
    return Curve(np.array(episodes, dtype=np.int64), scores, preset.episodes, preset.keep == "best")
