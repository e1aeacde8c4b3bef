"""Greedy play: the argmax of the networks, without exploration and without learning."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any, NamedTuple

import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.env import ArenaEnv, step_in
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import INSTEAD, really_done
from mc_nested.arrays import Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.foresight import announce
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.objectives.decide import Decision, ObjectiveAgent, Plan


@dataclass
class GreedyEpisode:
    """One greedy episode: the material in hand at each step (-1 for none), the actions of the agent's own set, r_M.

    Of several builders they are the first one's actions.
    """

    materials: list[int] = field(default_factory=list)
    actions: list[int] = field(default_factory=list)
    score: float = 0.0

    @property
    def material(self) -> int:
        """The material in hand at the end; -1 if none was chosen."""
        return self.materials[-1] if self.materials else -1

    def material_name(self, scenario: Scenario) -> str:
        """Return the materials' names, in the order in which they were in hand; "no material" where none was chosen."""
        chosen = [material for material, _ in groupby(self.materials) if material >= 0]
        return ", then ".join(scenario.materials[material].name for material in chosen) or "no material"


def play_greedily(
    env: VectorEnv[Int64s, Int64s, Any],
    scenarios: Sequence[Scenario],
    agent: Agent,
    show: Callable[[Cell | None], None] = lambda _: None,
    after_step: Callable[[], None] = lambda: None,
) -> list[GreedyEpisode]:
    """Play one greedy episode of every run, from a reset on; callbacks as ``take_steps``'s, which no cell is told."""
    runs, builders = len(scenarios), agent.builders
    first = slice(None, None, builders)
    has_parts = any(scenario.parts for scenario in scenarios)
    never, unused = np.zeros(runs), np.ones((runs, CHOICE_NUMBERS))
    of_builders = np.ones((runs, CHOICE_NUMBERS * builders))
    start = agent.start_states(scenarios)
    materials = agent.main.act(start, never, unused) if agent.main else agent.begin_episodes(np.arange(runs))
    observations, _ = env.reset(options={"material": np.repeat(materials, builders)})
    episodes = [GreedyEpisode() for _ in scenarios]
    running = np.ones(runs, dtype=np.bool_)
    while running.any():
        show(None)
        actions = agent.act(agent.low_level_states(observations, materials), materials, never, of_builders)
        takes = np.stack((actions, materials), axis=1) if agent.main and has_parts else actions
        announce(env, agent, takes, materials, never, of_builders, running)
        observations, _, terminated, truncated, info = env.step(takes)
        in_hand = materials if agent.main else agent.chosen_materials(observations[first])
        is_last, scores, done = info["_score"][first], info["score"][first], really_done(actions, info)
        for run in np.flatnonzero(running):
            episodes[run].actions.append(int(done[run * builders]))
            episodes[run].materials.append(int(in_hand[run]))
            if is_last[run]:
                episodes[run].score = float(scores[run])
        if agent.main and has_parts:
            due = np.flatnonzero(info["chooses"])
            materials = materials.copy()
            materials[due] = agent.main.act(observations[due], never[due], unused[due], due)
        running = ~(terminated | truncated)[first]
        after_step()
    show(None)
    return episodes


class BuildStep(NamedTuple):
    """An action with its material in hand, what comes next if all goes as the rules say, and the cell it is for."""

    taken: tuple[Action, int]
    following: tuple[Action, int] | None
    objective: Cell | None = None


def steps_of(agent: ObjectiveAgent, env: ArenaEnv, material: int | None = None) -> Iterator[BuildStep]:
    """Yield the agent's greedy steps in a running episode, each chosen once the one before is done.

    They end where the agent is stuck; whoever takes them ends where the episode does. ``material``: build all of it, in
    place of what is worth most.
    """

    def of_material(decision: Decision) -> Decision:
        return decision if material is None else decision._replace(material=material)

    plan = Plan()
    while not agent.is_stuck(plan, env.placed):
        decision, plan = agent.decide(plan, env.cell, env.placed)
        taken = of_material(decision)
        cell, placed = agent.expected(env.cell, env.placed, taken.action)
        _, goes_on, _ = env.expected(step_in(env.scenario, *taken))
        is_last = not goes_on or agent.is_stuck(plan, placed)
        yield BuildStep(taken, None if is_last else of_material(agent.decide(plan, cell, placed)[0]), plan.objective)


def build_greedily(
    env: ArenaEnv,
    agent: Agent,
    show: Callable[[Cell | None], None] = lambda _: None,
    after_step: Callable[[], None] = lambda: None,
) -> GreedyEpisode:
    """Play one greedy episode of an agent with objectives, which is told the design; callbacks as ``take_steps``'s."""
    online = agent.online()
    told = ObjectiveAgent(online["main"][0], online["low"][0], env.scenario, agent.nested_sees)
    return take_steps(env, steps_of(told, env), show=show, after_step=after_step)


def take_steps(
    env: ArenaEnv,
    steps: Iterable[BuildStep],
    material: int | None = None,
    show: Callable[[Cell | None], None] = lambda _: None,
    after_step: Callable[[], None] = lambda: None,
) -> GreedyEpisode:
    """Take the steps of an episode, from a reset on, until it or they end; each is announced with the one before.

    ``material`` is in hand first, the best one unless named. ``show`` is told the cell that each step is for before it,
    and None after the last; ``after_step`` is called after each.
    """
    scenario, episode = env.scenario, GreedyEpisode()
    env.reset(options=None if material is None else {"material": scenario.materials[material].name})
    for (action, in_hand), following, objective in steps:
        show(objective)
        env.announce(following and step_in(scenario, *following))
        _, _, terminated, truncated, info = env.step(step_in(scenario, action, in_hand))
        episode.actions.append(int(info.get(INSTEAD, action)))
        episode.materials.append(in_hand)
        after_step()
        if terminated or truncated:
            break
    show(None)
    episode.score = env.score
    return episode
