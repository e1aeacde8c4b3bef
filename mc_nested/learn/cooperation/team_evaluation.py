"""Greedy play of a team: the argmax of the networks, without exploration and without learning."""

from dataclasses import dataclass

import numpy as np

from mc_nested.learn.cooperation.team_agent import TeamAgent
from mc_nested.learn.cooperation.team_trainer import TeamArena
from mc_nested.learn.learner import CHOICE_NUMBERS


@dataclass(frozen=True)
class TeamEpisode:
    """One greedy episode: the material chosen (-1 for none), how many ticks it took, and the team's r_M."""

    material: int
    ticks: int
    score: float


def play_team_greedily(arena: TeamArena, agent: TeamAgent) -> TeamEpisode:
    """One greedy episode of an agent with one run; LiveError as the arena raises it."""
    never, row = np.zeros(1), np.arange(1)
    unused = np.ones((1, CHOICE_NUMBERS * agent.team.builders))
    materials = agent.choose(row, never, unused[:, :CHOICE_NUMBERS])
    observations, ticks = arena.reset(int(materials[0])), 0
    while True:
        states = agent.states(observations[None], materials)
        step = arena.step(agent.act(states, never, unused)[0])
        observations, ticks = step.observations, ticks + 1
        if agent.main is None:
            materials = agent.chosen_materials(observations[None])
        if step.terminated or step.truncated:
            return TeamEpisode(int(materials[0]), ticks, step.score)
