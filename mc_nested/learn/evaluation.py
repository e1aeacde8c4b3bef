"""Greedy play: what the saved networks' argmax does, without exploring and without learning."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arena.rules import Action
from mc_nested.arena.scenario import Scenario
from mc_nested.learn.agents import NestedAgent
from mc_nested.learn.learner import CHOICE_NUMBERS, Ints


@dataclass
class GreedyEpisode:
    """One greedy episode: the main agent's choice, the nested agent's actions, and r_M."""

    material: int
    actions: list[Action] = field(default_factory=list)
    score: float = 0.0


def play_greedily(
    env: VectorEnv[Ints, Ints, Any],
    scenarios: Sequence[Scenario],
    agent: NestedAgent,
    after_step: Callable[[], None] = lambda: None,
) -> list[GreedyEpisode]:
    """One greedy episode of every run, over arenas that begin anew; ``after_step`` is called after each step of all."""
    start = np.array([scenario.start_state for scenario in scenarios])
    never, unused = np.zeros(len(start)), np.ones((len(start), CHOICE_NUMBERS))
    materials = agent.main.act(start, never, unused)
    episodes = [GreedyEpisode(int(material)) for material in materials]
    observations, _ = env.reset(options={"material": materials})
    running = np.ones(len(start), dtype=np.bool_)
    while running.any():
        actions = agent.nested.act(agent.nested_states(observations, materials), never, unused)
        observations, _, terminated, truncated, info = env.step(actions)
        for run in np.flatnonzero(running):
            episodes[run].actions.append(Action(int(actions[run])))
            if info["_score"][run]:
                episodes[run].score = float(info["score"][run])
        running = ~(terminated | truncated)
        after_step()
    return episodes
