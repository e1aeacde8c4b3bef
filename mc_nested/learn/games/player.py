"""A game's part: it plays an episode as the learner planned it. It learns nothing, and needs no torch for that."""

from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arrays import Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.foresight import announce
from mc_nested.learn.games.episode import EpisodePlan, PlayedEpisode
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.learner import CHOICE_NUMBERS


def play_episode(arena: VectorEnv[Any, Int64s, Any], plan: EpisodePlan, agent: Agent) -> PlayedEpisode:
    """Play that episode. An error of the game passes through: nothing of the episode counts then.

    Args:
        arena: one arena as the agent sees it (``Agent.view_of``), autoreset disabled.
        plan: what is played.
        agent: an agent of one run as the learner's, of which the plan's network is loaded.
    """
    low_level = agent.low_level
    low_level.engine.load_online(np.tile(plan.online, (low_level.states.rows, 1)))
    materials, epsilon = np.array([plan.material]), np.array([plan.epsilon])
    numbers = plan.numbers if len(plan.numbers) else np.ones((1, CHOICE_NUMBERS))
    tries, seen = plan.first_tries.copied() if plan.first_tries else None, Experience()
    seen.begin()
    before, _ = arena.reset(options={"material": materials})
    observations, actions, rewards = [before[0]], list[int](), list[float]()
    is_over = False
    while not is_over:
        now, then = numbers.take([[len(actions)], [len(actions) + 1]], axis=0, mode="clip")
        chosen = agent.act(agent.low_level_states(before, materials), materials, epsilon, now)
        if tries:
            chosen = np.array([tries.act(int(chosen[0]), seen.tried_here())])
        announce(arena, agent, chosen, materials, epsilon, then, np.array([not tries or tries.are_over]))
        after, earned, terminated, truncated, info = arena.step(chosen)
        action, reward = int(chosen[0]), float(earned[0])
        if tries:
            tries.observe(action, bool((before[0, :2] != after[0, :2]).any()), seen.tried_here())
            step = [*before[0].tolist(), action, *after[0].tolist(), int(reward > 0), plan.material]
            seen.add(RealStep(*step))
        observations.append(after[0])
        actions.append(action)
        rewards.append(reward)
        before, is_over = after, bool(terminated[0] or truncated[0])
        materials = materials if agent.main else agent.chosen_materials(after)
    return PlayedEpisode(
        number=plan.number,
        process=plan.process,
        observations=np.stack(observations),
        actions=np.array(actions, dtype=np.int64),
        rewards=np.array(rewards),
        terminated=bool(terminated[0]),
        score=float(info["score"][0]),
    )
