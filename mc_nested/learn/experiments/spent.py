"""What each run had spent at each of its greedy evaluations: steps of training, and updates of all its networks."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Arrays, Int64s
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow


class Updated(Protocol):
    """The agents of some runs."""

    @property
    def updates_by_run(self) -> Int64s:
        """Updates of all of a run's networks, (runs,)."""


class Logged(Protocol):
    """A trainer, as far as it is counted here."""

    @property
    def agent(self) -> Updated: ...
    @property
    def episode_rows(self) -> Sequence[EpisodeRow]: ...
    @property
    def evaluation_rows(self) -> Sequence[EvaluationRow]: ...


class SpentSoFar:
    """Counts beside a trainer of so many runs.

    ``at``: (steps, updates) of each evaluation, in their order.
    """

    def __init__(self, runs: int) -> None:
        self.at: list[tuple[int, int]] = []
        self._steps = np.zeros(runs, dtype=np.int64)
        self._episodes = 0

    def count(self, trainer: Logged) -> None:
        """Count what the trainer did since the last call; to be called after each of its ticks.

        No run is updated while it is evaluated, and an evaluation takes a tick at least.
        """
        for episode in trainer.episode_rows[self._episodes :]:
            self._steps[episode.trial] += episode.steps
        self._episodes = len(trainer.episode_rows)
        if len(trainer.evaluation_rows) > len(self.at):
            updates = trainer.agent.updates_by_run
            for row in trainer.evaluation_rows[len(self.at) :]:
                self.at.append((int(self._steps[row.trial]), int(updates[row.trial])))

    def state(self) -> Arrays:
        """For a checkpoint."""
        return {"at": np.array(self.at, dtype=np.int64).reshape(-1, 2)}

    def load(self, state: Mapping[str, NDArray[Any]], trainer: Logged) -> None:
        """Go on from what ``state`` returned, beside the trainer as it was then."""
        self.at = [(int(steps), int(updates)) for steps, updates in state["at"]]
        self._steps[:] = 0
        self._episodes = 0
        self.count(trainer)
