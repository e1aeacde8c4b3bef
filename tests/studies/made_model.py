"""A model that learns in no time: after some episodes its greedy policy is the scripted builder's."""

import gymnasium
import numpy as np

from mc_nested.arena.builder import build
from mc_nested.arrays import Int64s
from mc_nested.learn.preset import Preset
from mc_nested.studies.sb3 import Sb3Dqn, Sb3Env
from tests.learn.made_experiments import BAR


class MadeModel(Sb3Dqn):
    """Takes the material stone, then acts at random; from ``knows_after`` episodes on, it builds the bar."""

    knows_after = 12

    def __init__(self, env: gymnasium.Env[Int64s, np.int64], preset: Preset, capacity: int, seed: int) -> None:
        assert isinstance(env, Sb3Env)
        self.env, self.capacity, self.seed = env, capacity, seed
        self.epsilons: list[float] = []
        self._random = np.random.default_rng(seed)
        self._over = True
        self._place = 0
        self._first = preset.episodes

    @property
    def updates(self) -> int:
        return len(self.epsilons)

    @property
    def parameters(self) -> int:
        return 7

    def learn_a_step(self, epsilon: float) -> None:
        self.epsilons.append(epsilon)
        if self._over:
            self.env.reset()
        action = 1 if self._over else int(self._random.integers(2, 10))
        _, _, terminated, truncated, _ = self.env.step(action)
        self._over = terminated or truncated

    def greedy(self, observation: Int64s) -> int:
        x, y, _, material = observation.tolist()
        if material == 0:
            self._place = 0
            return 1
        if self.env.episodes < self.knows_after:
            return 2
        assert self._place > 0 or (x, y) == BAR.start
        self._place += 1
        return 2 + int(build(BAR)[self._place - 1])
