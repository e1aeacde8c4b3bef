"""Training the agent with objectives: the nested agent first, then the main agent through it (objective_lessons.py).

An episode is a design drawn at random, and its score the share of it that stands, of the scenario's optimum. A greedy
evaluation builds the scenario itself, which is no lesson.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, named_parts, part_of
from mc_nested.errors import PresetError
from mc_nested.learn.agents import Agent
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.objective_lessons import MainLessons, NestedLessons
from mc_nested.learn.objectives.decide import ObjectiveAgent, built_by_the_rules
from mc_nested.learn.objectives.networks import ReachNetwork
from mc_nested.learn.preset import Preset
from mc_nested.learn.streams import Purpose, stream
from mc_nested.learn.training import Training

SAID_EVERY = 1000
"""Updates of the nested agent from one line about it to the next."""


class ObjectivesTraining(Training):
    """A training of one run; arguments as ``Training``'s.

    Raises:
        PresetError: more than one run is asked for.
    """

    def __init__(
        self, scenarios: Sequence[Scenario], agent: Agent, preset: Preset, seed: int, stop_at_optimum: bool = False
    ) -> None:
        rule, main, exploration = preset.objectives, agent.main, preset.explore_nested
        if len(scenarios) > 1 or rule is None or main is None or exploration is None:
            raise PresetError("[objectives] trains one nested agent at a time: leave out --trials and --agent")
        super().__init__(scenarios, agent, preset, seed, stop_at_optimum)
        self._scenario, self._rule, self._seed = scenarios[0], rule, seed
        self._nested = NestedLessons(agent.low_level, rule, preset.update, exploration)
        self._main = MainLessons(main, rule)

    def tick(self) -> None:
        """Do a round of lessons: in every arena a step of the nested agent, or an objective of the main agent."""
        random = stream(Purpose.PRACTICE, self._seed, self.agent.runs[0], self.ticks)
        if not self.ticks:
            first, then = self._rule.nested_updates, self.preset.episodes
            self.practice.untold.append(
                f"the nested agent learns first, with {first:,} updates; then the main agent, on {then:,} designs"
            )
        if self._nested.updates < self._rule.nested_updates:
            said = self._nested.updates // SAID_EVERY
            self._nested.round(random)
            self.env_steps += self._rule.nested_arenas
            if self._nested.updates // SAID_EVERY > said:
                self.practice.untold.append(self._nested.in_words())
        else:
            self._learn_order(random)
        self.ticks += 1

    def abandon_episodes(self) -> None:
        """Do nothing: no lesson is played in an arena that a mishap can end."""

    def state(self) -> Arrays:
        lessons = {"lessons/nested": self._nested.state(), "lessons/main": self._main.state()}
        return {**super().state(), **named_parts(lessons)}

    def load(self, state: Mapping[str, NDArray[Any]], journals: Sequence[Mapping[str, NDArray[Any]]]) -> None:
        super().load(state, journals)
        self._nested.load(part_of(state, "lessons/nested"))
        self._main.load(part_of(state, "lessons/main"))

    def _learn_order(self, random: np.random.Generator) -> None:
        """Do a round of the main agent; count the episodes that ended in it, and evaluate where that is due."""
        nested = ReachNetwork(self.agent.online()["low"][0])
        epsilon = float(self.epsilon[0][0])
        before, episodes = int(self.episodes_done[0]), self.preset.episodes
        ended = self._main.round(random, nested, epsilon, before / episodes)
        for done in ended[: episodes - before]:
            self.episodes_done[0] += 1
            self.env_steps += done.steps
            score, episode = done.share * self._scenario.optimum, int(self.episodes_done[0])
            material = self._scenario.best_material
            self.episode_rows.append(EpisodeRow(0, episode, score, material, done.steps, epsilon, 0.0))
        self.epsilon = self._epsilon_now()
        after, every = int(self.episodes_done[0]), self.preset.evaluate_every
        if after // every > before // every or after == episodes:
            self._evaluate()

    def _evaluate(self) -> None:
        """Build the scenario greedily, by the rules of the game, and count that as an evaluation."""
        online, scenario = self.agent.online(), self._scenario
        agent = ObjectiveAgent(online["main"][0], online["low"][0], scenario, self._rule.nested_sees)
        _, steps, score = built_by_the_rules(agent, scenario)
        self.evaluation_steps += steps
        row = EvaluationRow(0, int(self.episodes_done[0]), score, scenario.best_material, steps)
        self._count_evaluation(row, online)
