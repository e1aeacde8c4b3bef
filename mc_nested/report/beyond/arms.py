"""The results of an arm: trainings that are the same but for their trial."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.learn.experiments.job_training import Evaluated
from mc_nested.learn.experiments.jobs import Builders
from mc_nested.report.measures import LAST

Budget = Literal["steps", "updates"]
"""What two agents are given the same of."""


@dataclass(frozen=True)
class ArmResults:
    """What an arm's trials reached, and what they took.

    Args:
        topic: what it is about.
        name: who learned.
        scenario: the design's name.
        materials: how many there are to choose from.
        optimum: the design's highest score.
        episodes: of a training, at most.
        stops: whether a trial ends at its first greedy episode at the optimum.
        team: who shares an arena; None where an agent builds alone.
        trials: the greedy evaluations of each trial, in order.
        networks: of one trial.
        parameters: of one trial's networks, target networks not counted.
        updates: of all trials.
        env_steps: of all trials.
        seconds: of all trials, their share where others were trained at once.
        replay_bytes: that each trial's replays hold at its end.
    """

    topic: str
    name: str
    scenario: str
    materials: int
    optimum: float
    episodes: int
    stops: bool
    team: Builders | None
    trials: Sequence[Sequence[Evaluated]]
    networks: int
    parameters: int
    updates: int
    env_steps: int
    seconds: float
    replay_bytes: Sequence[int]

    @property
    def key(self) -> tuple[str, str, str]:
        """What no other arm has."""
        return self.topic, self.scenario, self.name

    @property
    def last_ten(self) -> Float64s:
        """Each trial's mean of its last ten greedy scores, (trials,)."""
        return np.array([np.mean([each.score for each in trial[-LAST:]]) for trial in self.trials])

    @property
    def best(self) -> Float64s:
        """Each trial's best greedy score, (trials,)."""
        return np.array([max(each.score for each in trial) for trial in self.trials])

    @property
    def final(self) -> Float64s:
        """Each trial's last greedy score, (trials,)."""
        return np.array([trial[-1].score for trial in self.trials])

    @property
    def episodes_to_optimum(self) -> list[int | None]:
        """The training episodes before each trial's first greedy episode at the optimum; None where there is none."""
        return [next((each.episode for each in trial if each.score >= self.optimum), None) for trial in self.trials]

    def spent(self, of: Budget) -> int:
        """The least that a trial had spent at its last evaluation."""
        return min(_spent(trial[-1], of) for trial in self.trials)

    def within(self, budget: int, of: Budget) -> Float64s:
        """As last_ten, of the evaluations until which no more was spent, (trials,); the first counts in any case."""
        return np.array([np.mean(self._until(trial, budget, of)[-LAST:]) for trial in self.trials])

    def early(self, budget: int, of: Budget) -> Float64s:
        """Each trial's mean greedy score until a third of the budget, (trials,); the first counts in any case."""
        return np.array([np.mean(self._until(trial, budget // 3, of)) for trial in self.trials])

    @staticmethod
    def _until(trial: Sequence[Evaluated], budget: int, of: Budget) -> list[float]:
        return [trial[0].score, *(each.score for each in trial[1:] if _spent(each, of) <= budget)]


Arms = dict[tuple[str, str, str], ArmResults]
"""Every arm by its key."""


def _spent(evaluated: Evaluated, of: Budget) -> int:
    found = evaluated.trained_steps if of == "steps" else evaluated.updates
    return found or 0
