"""A whole episode as an agent sees it, to learn from: a game far away has played it, or it was demonstrated."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.demonstration import Demonstration, ShownGame
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.arrays import Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent


class WholeEpisode(NamedTuple):
    """An episode from its reset to its end, every step of which was confirmed.

    Args:
        observations: what was seen, from the reset on, (steps + 1, …).
        materials: in hand when each was made, (steps + 1,); -1 before there was a choice.
        actions: what was done, of the agent's own set of actions, (steps,).
        rewards: r_N of each step, (steps,).
        earned: r_M after each step, (steps,); the last is the score.
        due: after which steps the main agent had to choose, (steps,).
        terminated: whether its last step terminated it; it was truncated otherwise.
    """

    observations: NDArray[Any]
    materials: Int64s
    actions: Int64s
    rewards: Float64s
    earned: Float64s
    due: Bools
    terminated: bool


def as_seen(agent: Agent, scenario: Scenario, shown: Demonstration) -> WholeEpisode:
    """Return a demonstration as the agent would have seen it, the choices of materials included."""
    game = ShownGame(shown, scenario.start)
    arena = agent.view_of(ArenaVectorEnv([ArenaEnv(game, scenario)]), [scenario])
    observations, _ = arena.reset(options={"material": np.array([shown.material])})
    seen, materials = [observations[0]], list[int]()
    steps: list[tuple[int, float, float, bool]] = []
    is_over = terminated = False
    for action, material in _taken(agent, scenario, shown):
        if is_over:  # a choice of a material was a step more than a person took
            break
        takes = [[action, material]] if agent.main and scenario.parts else [action]
        observations, rewards, *ends, info = arena.step(np.array(takes))
        terminated, is_over = bool(ends[0][0]), bool(ends[0][0] or ends[1][0])
        seen.append(observations[0])
        materials.append(material)
        earned, chooses = info.get("earned", info["score"]), info.get("chooses", [False])
        steps.append((action, float(rewards[0]), float(earned[0]), bool(chooses[0])))
    actions, paid, earnings, due = (np.array(column) for column in zip(*steps, strict=True))
    in_hand = np.array([*materials, materials[-1]])
    if not agent.main:
        in_hand = agent.chosen_materials(np.stack(seen))
    return WholeEpisode(np.stack(seen), in_hand, actions, paid, earnings, due, terminated)


def _taken(agent: Agent, scenario: Scenario, shown: Demonstration) -> list[tuple[int, int]]:
    """Return the actions of the agent's own set, each with the material in hand then."""
    in_hand, taken = shown.material, list[tuple[int, int]]()
    chooses = 0 if agent.main else len(scenario.materials)
    if chooses:
        taken.append((in_hand, in_hand))
    for step in shown.steps:
        if chooses and step.material != in_hand:
            taken.append((step.material, step.material))
        in_hand = step.material
        taken.append((chooses + step.action, in_hand))
    return taken
