"""The practice of a preset with [excursions]: every run returns along its best episode, then explores.

The best episodes are handed to the low-level learners to imitate.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.env import BLOCKS_LEFT, X, Y
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.dqn.replay import Transitions
from mc_nested.learn.dqn.self_imitation import BestEpisodes
from mc_nested.learn.dqn.states import numbered
from mc_nested.learn.exploration.return_then_explore import PLAN_NUMBERS, STEP_NUMBERS, EpisodeStep, ReturnThenExplore
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import ExcursionRule, Preset
from mc_nested.learn.state_dict import named_for, part_of


class Excursions(Practice):
    """The paper's practice, and excursions in the place of ε, in all of an agent's runs.

    A greedy episode is learned from in another way: what its actions did is remembered, and if it is the best episode
    so far, excursions follow it and updates imitate it.

    Args:
        agent: the agent whose low-level agents act.
        preset: the hyper-parameters.
        rule: how often and how far excursions leave the best episode.
        scenarios: each run's scenario.
    """

    numbers = PLAN_NUMBERS + STEP_NUMBERS

    def __init__(self, agent: Agent, preset: Preset, rule: ExcursionRule, scenarios: Sequence[Scenario]) -> None:
        super().__init__(agent, preset)
        self._low_level, self._space = agent.low_level, numbered(agent.low_level.states)
        self._explorers = [
            ReturnThenExplore(rule, self._space.actions, agent.size, len(scenario.in_order)) for scenario in scenarios
        ]
        self._part_at = [[scenario.part_at(left) for left in range(scenario.blocks + 1)] for scenario in scenarios]

    def begin(self, runs: Int64s, numbers: Float64s) -> None:
        """Plan an excursion in each of the named runs; a greedy episode doesn't follow it, and is only observed."""
        for run in runs:
            self._explorers[run].begin(numbers[run, :PLAN_NUMBERS])

    def act(self, runs: Int64s, observations: NDArray[Any], actions: Int64s, numbers: Float64s) -> Int64s:
        """Return all runs' actions; those of the named runs are the next ones of their excursions."""
        for run in runs.tolist():
            x, y, left = observations[run, [X, Y, BLOCKS_LEFT]].tolist()
            part = self._part_at[run][left]
            actions[run] = self._explorers[run].next_action(x, y, numbers[run, PLAN_NUMBERS:], part)
        return actions

    def observe(self, step: Step, next_states: NDArray[Any]) -> None:
        """Record what the actions of all running runs did, in greedy episodes, too."""
        runs = np.flatnonzero(step.running)
        before, states, next_states = step.observations[runs], step.states[runs], next_states[runs]
        actions, rewards, terminated = step.actions[runs], step.rewards[runs], step.terminated[runs]
        rows = self._agent.low_level_rows(runs, step.materials)
        indices, next_indices = self._space.index(states), self._space.index(next_states)
        used = before[:, BLOCKS_LEFT] > next_states[:, BLOCKS_LEFT]
        parts = np.array([self._part_at[run][left] for run, left in zip(runs, before[:, BLOCKS_LEFT], strict=True)])
        columns = (before[:, X], before[:, Y], indices, actions, rewards, next_indices, terminated, used, parts, rows)
        for run, *values in zip(runs.tolist(), *(column.tolist() for column in columns), strict=True):
            self._explorers[run].observe(EpisodeStep(*values))

    def end(self, runs: Int64s, materials: Int64s, scores: Float64s) -> None:  # noqa: ARG002 - the best is known by its steps
        """End the episodes of the named runs (k,)."""
        for run in runs.tolist():
            last = {step.row for step in self._explorers[run].best}
            if self._explorers[run].end() and self._low_level.best:
                for row in last:
                    self._low_level.best.forget(row)
                self._imitate(self._low_level.best, run)

    def state(self) -> Arrays:
        """Return everything that later steps depend on, by name."""
        every = (named_for(str(run), explorer.state()) for run, explorer in enumerate(self._explorers))
        return {name: kept for part in every for name, kept in part.items()}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
        for run, explorer in enumerate(self._explorers):
            explorer.load(part_of(state, str(run)))
            if self._low_level.best:
                self._imitate(self._low_level.best, run)

    def _imitate(self, best: BestEpisodes, run: int) -> None:
        """Let each row that acted in the run's best episode imitate its own steps of it."""
        walk = self._explorers[run].best
        for row in {step.row for step in walk}:
            best.keep(row, self._transitions([step for step in walk if step.row == row]))

    def _transitions(self, walk: list[EpisodeStep]) -> Transitions:
        terminated = np.array([step.terminated for step in walk], dtype=np.bool_)
        return Transitions(
            np.array([[step.state, step.next_state] for step in walk], dtype=np.int64).T,
            np.array([step.action for step in walk], dtype=np.int64),
            np.array([step.reward for step in walk]),
            self._low_level.discounts(terminated),
        )
