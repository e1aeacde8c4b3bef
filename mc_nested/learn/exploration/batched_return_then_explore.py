"""ReturnThenExplore for every run of an agent; the best episodes are handed to the low-level learners to imitate."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.env import BLOCKS_LEFT, X, Y
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.dqn.replay import Transitions
from mc_nested.learn.dqn.state_space import numbered
from mc_nested.learn.exploration.return_then_explore import PLAN_NUMBERS, STEP_NUMBERS, EpisodeStep, ReturnThenExplore
from mc_nested.learn.preset import ExcursionRule
from mc_nested.learn.state_dict import named_for, part_of

NUMBERS = PLAN_NUMBERS + STEP_NUMBERS
"""Random numbers that a run needs per tick."""


class BatchedReturnThenExplore:
    """The exploration of all of an agent's runs.

    Args:
        rule: how often and how far excursions leave the best episode.
        agent: the agent whose low-level agents act.
    """

    def __init__(self, rule: ExcursionRule, agent: Agent) -> None:
        self._low_level, self._space = agent.low_level, numbered(agent.low_level.states)
        self._explorers = [ReturnThenExplore(rule, self._space.actions, agent.size) for _ in agent.runs]

    def begin(self, runs: Int64s, numbers: Float64s) -> None:
        """Begin an episode in each of the named runs; ``numbers`` (all runs, NUMBERS) plan the excursions.

        A greedy episode doesn't follow its plan, it is only observed: it may become the best.
        """
        for run in runs:
            self._explorers[run].begin(numbers[run, :PLAN_NUMBERS])

    def act(self, runs: Int64s, observations: Int64s, numbers: Float64s) -> Int64s:
        """The next actions of the named runs (k,), for the observations and numbers of all runs."""
        chosen = [
            self._explorers[run].next_action(*observations[run, [X, Y]].tolist(), numbers[run, PLAN_NUMBERS:])
            for run in runs
        ]
        return np.array(chosen, dtype=np.int64)

    def observe(
        self,
        runs: Int64s,
        before: Int64s,
        states: Int64s,
        actions: Int64s,
        rewards: Float64s,
        next_states: Int64s,
        terminated: Bools,
    ) -> None:
        """Record what the actions did; every array is of the named runs (k, …), ``before`` is what was acted on."""
        indices, next_indices = self._space.index(states), self._space.index(next_states)
        used = before[:, BLOCKS_LEFT] > next_states[:, BLOCKS_LEFT]
        columns = (before[:, X], before[:, Y], indices, actions, rewards, next_indices, terminated, used)
        for run, *values in zip(runs.tolist(), *(column.tolist() for column in columns), strict=True):
            self._explorers[run].observe(EpisodeStep(*values))

    def end(self, runs: Int64s, rows: Int64s) -> None:
        """End the episodes of the named runs (k,); ``rows`` (k,) are the low-level learners' rows that acted."""
        for run, row in zip(runs.tolist(), rows.tolist(), strict=True):
            explorer, last = self._explorers[run], self._explorers[run].best_row
            if explorer.end(row) and self._low_level.best:
                if row != last:
                    self._low_level.best.forget(last)
                self._low_level.best.keep(row, self._transitions(explorer.best))

    def state(self) -> Arrays:
        """Everything that later steps depend on, by name."""
        every = (named_for(str(run), explorer.state()) for run, explorer in enumerate(self._explorers))
        return {name: kept for part in every for name, kept in part.items()}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
        for run, explorer in enumerate(self._explorers):
            explorer.load(part_of(state, str(run)))
            if self._low_level.best and explorer.best:
                self._low_level.best.keep(explorer.best_row, self._transitions(explorer.best))

    def _transitions(self, walk: list[EpisodeStep]) -> Transitions:
        terminated = np.array([step.terminated for step in walk], dtype=np.bool_)
        return Transitions(
            np.array([[step.state, step.next_state] for step in walk], dtype=np.int64).T,
            np.array([step.action for step in walk], dtype=np.int64),
            np.array([step.reward for step in walk]),
            self._low_level.discounts(terminated),
        )
