"""Foresight: what an agent will do next, told to arenas whose games can make use of it."""

from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arena.vector import NO_ACTION, Foreseeing, foresees
from mc_nested.arrays import Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.learner import CHOICE_NUMBERS

Env = VectorEnv[Any, Int64s, Any]


def announce(
    env: Env, agent: Agent, takes: Int64s, materials: Int64s, epsilon: Float64s, numbers: Float64s, known: Bools
) -> None:
    """Announce what comes after ``takes``, which the arenas take now, (R,) or (R, 2); nothing if they don't foresee.

    ``materials`` (R,) are in hand; the next action is ε-greedy by ``epsilon`` (R,) and ``numbers`` (R, 2), a choice of
    material that is due then is greedy. It is ``known`` (R,) where the agent will choose by these and by its networks.
    """
    if not foresees(env):
        return
    arenas: Foreseeing = env  # type: ignore[assignment]  # it says so itself
    observations, goes_on, chooses = arenas.expected(takes)
    if agent.main and takes.ndim > 1:
        due = np.flatnonzero(chooses)
        materials, greedy = materials.copy(), (np.zeros(len(due)), np.ones((len(due), CHOICE_NUMBERS)))
        materials[due] = agent.main.act(observations[due], *greedy, due)
    actions = agent.foretold(agent.low_level_states(observations, materials), materials, epsilon, numbers)
    actions = np.where(known & goes_on, actions, NO_ACTION)
    arenas.announce(np.stack((actions, materials), axis=1) if takes.ndim > 1 else actions)
