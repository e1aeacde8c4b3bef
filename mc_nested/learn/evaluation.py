"""Greedy play: the argmax of the networks, without exploration and without learning."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.learner import CHOICE_NUMBERS


@dataclass
class GreedyEpisode:
    """One greedy episode: the material chosen (-1 for none), the actions of the agent's own set, and r_M."""

    material: int = -1
    actions: list[int] = field(default_factory=list)
    score: float = 0.0

    def material_name(self, scenario: Scenario) -> str:
        """The chosen material's name; "no material" where none was chosen."""
        return scenario.materials[self.material].name if self.material >= 0 else "no material"


def play_greedily(
    env: VectorEnv[Int64s, Int64s, Any],
    scenarios: Sequence[Scenario],
    agent: Agent,
    after_step: Callable[[], None] = lambda: None,
) -> list[GreedyEpisode]:
    """One greedy episode of every run, from a reset on; ``after_step`` is called after each step of all runs."""
    runs = len(scenarios)
    never, unused = np.zeros(runs), np.ones((runs, CHOICE_NUMBERS))
    start = agent.start_states(scenarios)
    materials = agent.main.act(start, never, unused) if agent.main else np.zeros(runs, dtype=np.int64)
    observations, _ = env.reset(options={"material": materials})
    episodes = [GreedyEpisode() for _ in scenarios]
    running = np.ones(runs, dtype=np.bool_)
    while running.any():
        actions = agent.act(agent.low_level_states(observations, materials), materials, never, unused)
        observations, _, terminated, truncated, info = env.step(actions)
        for run in np.flatnonzero(running):
            episodes[run].actions.append(int(actions[run]))
            if info["_score"][run]:
                episodes[run].score = float(info["score"][run])
        running = ~(terminated | truncated)
        after_step()
    chosen = materials if agent.main else agent.chosen_materials(observations)
    for episode, material in zip(episodes, chosen, strict=True):
        episode.material = int(material)
    return episodes
