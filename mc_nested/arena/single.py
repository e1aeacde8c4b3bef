"""The single agent's view of the arenas: ten actions, the first two of which choose the material (paper, appendix).

The main and the nested agent's actions are one set: 0 to M - 1 choose one of the M materials, the rest are the eight
building actions. The state is (x, y, b, m); m is 0 until a material is chosen, then its action + 1
(docs/explanation/task.md). The choice earns the material's p and counts as a step. A first action that is no material
ends the episode with score 0. A later material action does nothing, and counts as a step.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from gymnasium.spaces import Discrete
from gymnasium.vector import VectorEnv, VectorWrapper
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from mc_nested.arena.action import Action
from mc_nested.arena.env import highest_observation, space_up_to
from mc_nested.arena.game import Resumable
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import NO_ACTION, reset_options, resumable_arenas
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s


class SingleAgentVectorEnv(VectorWrapper):
    """Arenas whose material is chosen by an action of the episode.

    Args:
        env: the arenas, autoreset disabled.
        scenarios: each run's scenario; all with the same number of materials.
    """

    def __init__(self, env: VectorEnv[Int64s, Int64s, Any], scenarios: Sequence[Scenario]) -> None:
        super().__init__(env)
        runs = env.num_envs
        self._resumable = resumable_arenas(env)
        self._scenarios = tuple(scenarios)
        self._worth = np.array([[material.p for material in scenario.materials] for scenario in scenarios])
        self._step_limit = np.array([scenario.step_limit for scenario in scenarios])
        self._materials = self._worth.shape[1]
        highest = np.max([highest_observation(scenario) for scenario in scenarios], axis=0)
        self.single_observation_space = space_up_to(np.append(highest, self._materials))
        self.single_action_space = Discrete(self._materials + len(Action))
        self.observation_space = batch_space(self.single_observation_space, runs)
        self.action_space = batch_space(self.single_action_space, runs)
        self._start = np.array([scenario.start_state for scenario in scenarios])
        self._observations = self._start.copy()
        self._chosen = np.zeros(runs, dtype=np.int64)
        self._steps = np.zeros(runs, dtype=np.int64)
        self._score = np.zeros(runs)
        self._terminated = np.zeros(runs, dtype=np.bool_)
        self._truncated = np.zeros(runs, dtype=np.bool_)

    def reset(
        self,
        *,
        seed: int | list[int | None] | None = None,  # noqa: ARG002 - the arenas within begin when a material is chosen
        options: dict[str, Any] | None = None,
    ) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode in the masked arenas (all, without a mask); no material is chosen yet."""
        mask, _ = reset_options({**(options or {}), "material": np.zeros(self.num_envs, np.int64)}, self._scenarios)
        self._observations[mask] = self._start[mask]
        self._chosen[mask] = self._steps[mask] = 0
        self._score[mask] = 0.0
        self._terminated[mask] = self._truncated[mask] = False
        return self._seen(), {}

    def step(self, actions: Int64s) -> tuple[Int64s, Float64s, Bools, Bools, dict[str, Any]]:
        """One of the ten actions in every running arena; ``info["score"]`` is as that of the arenas within."""
        running = ~(self._terminated | self._truncated)
        first = running & (self._chosen == 0)
        chooses = first & (actions < self._materials)
        acts = running & ~first & (actions >= self._materials)
        rewards = np.zeros(self.num_envs)
        if chooses.any():
            self.env.reset(options={"reset_mask": chooses, "material": np.where(chooses, actions, 0)})
            self._chosen[chooses] = actions[chooses] + 1
            rewards[chooses] = self._worth[chooses, actions[chooses]]
        if acts.any():
            within = np.where(acts, actions - self._materials, NO_ACTION)
            observations, earned, terminated, _, _ = self.env.step(within)
            self._observations[acts] = observations[acts]
            rewards[acts] = earned[acts]
            self._terminated |= terminated & acts
        self._terminated |= first & ~chooses
        self._steps += running
        self._score += rewards
        self._truncated |= running & ~self._terminated & (self._steps >= self._step_limit)
        ended = running & (self._terminated | self._truncated)
        info = {"score": np.where(ended, self._score, 0.0), "_score": ended}
        return self._seen(), rewards, self._terminated.copy(), self._truncated.copy(), info

    def occupied(self) -> Bools:
        """The cells where a block landed in each arena, (runs, size, size); none before a material is chosen."""
        within: Bools = self.env.occupied()  # type: ignore[attr-defined]  # both kinds of arenas have it
        return within & (self._chosen > 0)[:, None, None]

    @property
    def resumable(self) -> Resumable | None:
        """This view, if the arenas within can be resumed."""
        return self if self._resumable else None

    def snapshot(self) -> Arrays:
        """Every arena as it stands, for ``restore``."""
        own = {f"single{name}": getattr(self, name).copy() for name in self._STATE}
        return {**own, **(self._resumable.snapshot() if self._resumable else {})}

    def restore(self, snapshot: Mapping[str, NDArray[Any]]) -> None:
        """Put every arena back as it stood at ``snapshot``."""
        for name in self._STATE:
            setattr(self, name, snapshot[f"single{name}"].copy())
        if self._resumable:
            self._resumable.restore(snapshot)

    _STATE = ("_observations", "_chosen", "_steps", "_score", "_terminated", "_truncated")

    def _seen(self) -> Int64s:
        return np.concatenate((self._observations, self._chosen[:, None]), axis=1)
