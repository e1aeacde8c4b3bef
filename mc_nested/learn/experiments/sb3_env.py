"""The single agent's task as one gymnasium Env, as stable-baselines3 takes it: ten actions, the state (x, y, b, m).

Its observation space is MultiDiscrete, which that library encodes as one-hot.
"""

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import MultiDiscrete
from gymnasium.vector import VectorEnv

from mc_nested.arena.env import highest_observation
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arrays import Int64s


class Sb3Env(gymnasium.Env[Int64s, np.int64]):
    """One arena, whose material is chosen by an action of the episode.

    Args:
        arenas: a VectorEnv of that one arena, autoreset disabled.
        scenarios: its scenario.
    """

    def __init__(self, arenas: VectorEnv[Int64s, Int64s, Any], scenarios: Sequence[Scenario]) -> None:
        self._view = SingleAgentVectorEnv(arenas, scenarios)
        (scenario,) = scenarios
        self.observation_space = MultiDiscrete([*(highest_observation(scenario) + 1), len(scenario.materials) + 1])
        self.action_space = self._view.single_action_space
        self.episodes = 0
        """Episodes that have ended."""
        self.steps = 0
        """Steps of the current episode, or of the one that has just ended."""

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Int64s, dict[str, Any]]:
        """Begin an episode."""
        super().reset(seed=seed, options=options)
        observations, _ = self._view.reset()
        self.steps = 0
        return observations[0], {}

    def step(self, action: np.int64 | int) -> tuple[Int64s, float, bool, bool, dict[str, Any]]:
        """One of the ten actions; the last step's ``info["score"]`` is r_M."""
        observations, rewards, terminated, truncated, info = self._view.step(np.array([action], dtype=np.int64))
        self.steps += 1
        ended = bool(info["_score"][0])
        self.episodes += ended
        beside = {"score": float(info["score"][0])} if ended else {}
        return observations[0], float(rewards[0]), bool(terminated[0]), bool(truncated[0]), beside
