"""k independent single agents in one arena: each has the paper's ten actions, and one of them chooses the material.

A world is cleared for one material, so that one choice has to count: that of builder 0, at the first tick, which is
when the appendix's single agent has to make it. It earns the material's p. If it chooses none then, the episode ends
with score 0, as the paper's does. What the others do at that tick does nothing, and neither does a material action at
any other time. Each sees (x, y, b, m) and earns r_N for its own blocks. With one builder it is the paper's single
agent (arena/single.py).
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.error import ResetNeeded
from numpy.typing import NDArray

from mc_nested.arena.cooperative.team_env import TeamEnv, TeamStep
from mc_nested.arena.game import Resumable
from mc_nested.arena.vector import NO_ACTION
from mc_nested.arrays import Arrays, Int64s


class SingleTeamEnv:
    """A team's arena as its single agents see it: 0 to M - 1 choose a material, the rest are the eight actions."""

    def __init__(self, within: TeamEnv) -> None:
        self.team = within.team
        self._within = within
        self._chosen = 0
        self._ticks = 0
        self._running = False
        self._observations = self._start()

    def reset(self, material: int) -> Int64s:  # noqa: ARG002 - builder 0 chooses it at the first tick
        """Begin an episode; no material is chosen yet. What each builder sees, (k, 4)."""
        self._chosen, self._ticks, self._running = 0, 0, True
        self._observations = self._start()
        return self._seen()

    def step(self, actions: Sequence[int] | Int64s) -> TeamStep:
        """One tick, one of the ten actions of each builder; ResetNeeded if no episode runs."""
        if not self._running:
            raise ResetNeeded("the episode has ended, or none has begun: call reset() first")
        self._ticks += 1
        step = self._act(np.asarray(actions)) if self._chosen else self._choose(int(actions[0]))
        truncated = not step.terminated and self._ticks >= self.team.scenario.step_limit
        self._running = not (step.terminated or truncated)
        score = self._score(step) if not self._running else 0.0
        return TeamStep(self._seen(), step.rewards, step.terminated, truncated, score)

    @property
    def resumable(self) -> Resumable | None:
        """This view, if the arena within can be resumed."""
        return self if self._within.resumable else None

    def snapshot(self) -> Arrays:
        """The current episode, for ``restore``."""
        within = self._within.resumable.snapshot() if self._within.resumable else {}
        stands_at = np.array([self._chosen, self._ticks, self._running])
        return {**within, "single_stands_at": stands_at, "single_observations": self._observations.copy()}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put the episode back as it stood at ``snapshot``."""
        self._chosen, self._ticks, running = (int(value) for value in snapshot["single_stands_at"])
        self._running = bool(running)
        self._observations = snapshot["single_observations"].copy()
        if self._within.resumable:
            self._within.resumable.restore(snapshot)

    @property
    def _materials(self) -> int:
        return len(self.team.scenario.materials)

    def _choose(self, action: int) -> TeamStep:
        rewards = np.zeros(self.team.builders)
        if action >= self._materials:
            return TeamStep(self._observations, rewards, terminated=True, truncated=False, score=0.0)
        self._observations = self._within.reset(action)
        self._chosen = action + 1
        rewards[0] = self.team.scenario.materials[action].p
        return TeamStep(self._observations, rewards, terminated=False, truncated=False, score=0.0)

    def _act(self, actions: Int64s) -> TeamStep:
        step = self._within.step(np.where(actions < self._materials, NO_ACTION, actions - self._materials))
        self._observations = step.observations
        return step

    def _score(self, step: TeamStep) -> float:
        """r_M at the end: of the blocks that stand, and of the material; 0 if none was chosen."""
        if not self._chosen:
            return 0.0
        return step.score if step.terminated else self.team.scenario.score(self._within.placed, self._chosen - 1)

    def _start(self) -> Int64s:
        return np.array([(*start, self.team.scenario.blocks) for start in self.team.starts], dtype=np.int64)

    def _seen(self) -> Int64s:
        return np.column_stack((self._observations, np.full(self.team.builders, self._chosen)))
