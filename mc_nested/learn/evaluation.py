"""Greedy play: the argmax of the networks, without exploration and without learning."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import groupby
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv

from mc_nested.arena.action import Cell
from mc_nested.arena.env import BLOCKS_LEFT, X, Y
from mc_nested.arena.rules import front_of
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.vector import NO_ACTION, Foreseeing, foresees
from mc_nested.arrays import Bools, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.foresight import announce
from mc_nested.learn.learner import CHOICE_NUMBERS
from mc_nested.learn.objectives.decide import ObjectiveAgent, Plan


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
    after_step: Callable[[], None] = lambda: None,
) -> list[GreedyEpisode]:
    """Play one greedy episode of every run, from a reset on; ``after_step`` is called after each step of all runs."""
    if agent.has_objectives:
        return _build_greedily(env, scenarios, agent, after_step)
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
        actions = agent.act(agent.low_level_states(observations, materials), materials, never, of_builders)
        takes = np.stack((actions, materials), axis=1) if agent.main and has_parts else actions
        announce(env, agent, takes, materials, never, of_builders, running)
        observations, _, terminated, truncated, info = env.step(takes)
        in_hand = materials if agent.main else agent.chosen_materials(observations[first])
        is_last, scores = info["_score"][first], info["score"][first]
        for run in np.flatnonzero(running):
            episodes[run].actions.append(int(actions[run * builders]))
            episodes[run].materials.append(int(in_hand[run]))
            if is_last[run]:
                episodes[run].score = float(scores[run])
        if agent.main and has_parts:
            due = np.flatnonzero(info["chooses"])
            materials = materials.copy()
            materials[due] = agent.main.act(observations[due], never[due], unused[due], due)
        running = ~(terminated | truncated)[first]
        after_step()
    return episodes


def _build_greedily(
    env: VectorEnv[Int64s, Int64s, Any], scenarios: Sequence[Scenario], agent: Agent, after_step: Callable[[], None]
) -> list[GreedyEpisode]:
    """Do ``play_greedily`` with objectives: the main agent is told each scenario's design."""
    main, nested = agent.online()["main"], agent.online()["low"]
    agents = [ObjectiveAgent(*own) for own in zip(main, nested, scenarios, strict=True)]
    has_parts = any(scenario.parts for scenario in scenarios)
    observations, _ = env.reset(options={"material": np.array([scenario.best_material for scenario in scenarios])})
    episodes = [GreedyEpisode() for _ in scenarios]
    plans, blocks = [Plan() for _ in scenarios], [frozenset[Cell]() for _ in scenarios]
    running = np.ones(len(scenarios), dtype=np.bool_)

    def decided(
        seen: Int64s, stands: list[frozenset[Cell]], about: list[Plan], asked: Bools
    ) -> tuple[Int64s, list[Plan]]:
        takes, then = np.full((len(agents), 2), NO_ACTION), list(about)
        for run in asked.nonzero()[0].tolist():
            takes[run], then[run] = agents[run].decide(about[run], (int(seen[run, X]), int(seen[run, Y])), stands[run])
        return takes if has_parts else takes[:, 0], then

    def stand(before: Int64s, after: Int64s) -> list[frozenset[Cell]]:
        landed = before[:, BLOCKS_LEFT] > after[:, BLOCKS_LEFT]
        fronts = [front_of((int(x), int(y))) for x, y in after[:, [X, Y]]]
        return [own | {front} if is_new else own for own, front, is_new in zip(blocks, fronts, landed, strict=True)]

    takes, plans = decided(observations, blocks, plans, running)
    while running.any():
        if foresees(env):
            arenas: Foreseeing = env  # type: ignore[assignment]  # it says so itself
            expected, goes_on, _ = arenas.expected(takes)
            following, _ = decided(expected, stand(observations, expected), plans, running & goes_on)
            arenas.announce(following)
        before = observations
        observations, _, terminated, truncated, info = env.step(takes)
        blocks = stand(before, observations)
        for run in running.nonzero()[0].tolist():
            action, material = np.atleast_1d(takes[run]).tolist()[0], scenarios[run].best_material
            episodes[run].actions.append(action)
            episodes[run].materials.append(int(takes[run][1]) if has_parts else material)
            if info["_score"][run]:
                episodes[run].score = float(info["score"][run])
        running = ~(terminated | truncated)
        after_step()
        takes, plans = decided(observations, blocks, plans, running)
    return episodes
