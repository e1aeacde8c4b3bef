"""The results of an arm of what the paper didn't try: its trials on one design, and what they took."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from mc_nested.arrays import Float64s
from mc_nested.studies.arm import Arm
from mc_nested.studies.outcome import Evaluated
from mc_nested.studies.results import LAST
from mc_nested.studies.trial import Trial

Budget = Literal["steps", "updates"]
"""What two agents are given the same amount of."""


@dataclass(frozen=True)
class ArmResults:
    """The trials of an arm on a design."""

    trials: Sequence[Trial]

    @property
    def arm(self) -> Arm:
        """What they have in common."""
        return self.trials[0].arm

    @property
    def topic(self) -> str:
        """What it is about."""
        return self.arm.labels["topic"]

    @property
    def name(self) -> str:
        """Who learned."""
        return self.arm.labels["agent"]

    @property
    def scenario(self) -> str:
        """The design's name."""
        return self.trials[0].scenario.name

    @property
    def materials(self) -> int:
        """How many there are to choose from."""
        return len(self.trials[0].scenario.materials)

    @property
    def optimum(self) -> float:
        """The design's highest score."""
        return self.trials[0].scenario.optimum

    @property
    def stops(self) -> bool:
        """Whether a trial ends at its first greedy episode at the optimum."""
        return self.arm.stop_at_optimum

    @property
    def key(self) -> tuple[str, str, str]:
        """What no other arm has."""
        return self.topic, self.scenario, self.name

    @property
    def last_ten(self) -> Float64s:
        """Each trial's mean of its last ten greedy scores, (trials,)."""
        return np.array([np.mean(trial.scores[-LAST:]) for trial in self.trials])

    @property
    def best(self) -> Float64s:
        """Each trial's best greedy score, (trials,)."""
        return np.array([trial.best_score for trial in self.trials])

    @property
    def final(self) -> Float64s:
        """Each trial's last greedy score, (trials,)."""
        return np.array([trial.scores[-1] for trial in self.trials])

    def least_cost(self, of: Budget) -> int:
        """Return the least that a trial had spent at its last evaluation."""
        return min(_cost(trial.outcome.evaluations[-1], of) for trial in self.trials)

    def within(self, budget: int, of: Budget) -> Float64s:
        """Return last_ten of the evaluations until which no more was spent, (trials,); the first always counts."""
        return np.array([np.mean(self._until(trial, budget, of)[-LAST:]) for trial in self.trials])

    def early(self, budget: int, of: Budget) -> Float64s:
        """Return each trial's mean score until a third of the budget, (trials,); the first counts in any case."""
        return np.array([np.mean(self._until(trial, budget // 3, of)) for trial in self.trials])

    @staticmethod
    def _until(trial: Trial, budget: int, of: Budget) -> list[float]:
        first, *others = trial.outcome.evaluations
        return [first.score, *(each.score for each in others if _cost(each, of) <= budget)]


Arms = dict[tuple[str, str, str], ArmResults]
"""Every arm by its key."""


def _cost(evaluated: Evaluated, of: Budget) -> int:
    found = evaluated.trained_steps if of == "steps" else evaluated.updates
    return found or 0
