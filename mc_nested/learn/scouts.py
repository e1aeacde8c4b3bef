"""The excursions of every run (excursions.py), and what the best of them leave the low agents to imitate."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.learn.agents import Agent
from mc_nested.learn.checkpoint import Arrays, named_for, part_of
from mc_nested.learn.excursions import PLAN_NUMBERS, STEP_NUMBERS, Excursions, Step
from mc_nested.learn.preset import ExcursionRule
from mc_nested.learn.replay import Transitions

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

NUMBERS = PLAN_NUMBERS + STEP_NUMBERS
"""Random numbers that a run needs at a tick."""


class Scouts:
    """The excursions of all of an agent's runs.

    Args:
        rule: how often and how far they leave the best episode.
        agent: whose low agents act.
    """

    def __init__(self, rule: ExcursionRule, agent: Agent) -> None:
        self._low = agent.low
        self._excursions = [Excursions(rule, agent.low.space.actions) for _ in agent.runs]

    def begin(self, runs: Ints, numbers: Floats) -> None:
        """An episode begins in each of the named runs: plan an excursion by the numbers (all runs, NUMBERS).

        A greedy episode is only watched: it may turn out to be the best.
        """
        for run in runs:
            self._excursions[run].begin(numbers[run, :PLAN_NUMBERS])

    def act(self, runs: Ints, observations: Ints, numbers: Floats) -> Ints:
        """The next actions of the named runs (k,), for the observations and numbers of all runs."""
        chosen = [
            self._excursions[run].next_action(*observations[run, :2].tolist(), numbers[run, PLAN_NUMBERS:])
            for run in runs
        ]
        return np.array(chosen, dtype=np.int64)

    def saw(
        self, runs: Ints, before: Ints, states: Ints, actions: Ints, rewards: Floats, next_states: Ints, ended: Bools
    ) -> None:
        """What the actions came to; every array of the named runs (k, …), ``before`` the observations acted on."""
        numbers, following = self._low.space.number(states), self._low.space.number(next_states)
        used = before[:, 2] > next_states[:, 2]
        columns = (before[:, 0], before[:, 1], numbers, actions, rewards, following, ended, used)
        for run, *values in zip(runs.tolist(), *(column.tolist() for column in columns), strict=True):
            self._excursions[run].saw(Step(*values))

    def end(self, runs: Ints, rows: Ints) -> None:
        """The episodes of the named runs (k,) are over; ``rows`` (k,) are the low learners' that acted."""
        for run, row in zip(runs.tolist(), rows.tolist(), strict=True):
            excursions, last = self._excursions[run], self._excursions[run].best_row
            if excursions.end(row) and self._low.best:
                if row != last:
                    self._low.best.forget(last)
                self._low.best.keep(row, self._transitions(excursions.best))

    def state(self) -> Arrays:
        """Everything later steps depend on, by name."""
        every = (named_for(str(run), excursions.state()) for run, excursions in enumerate(self._excursions))
        return {name: kept for part in every for name, kept in part.items()}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Go on from what ``state`` gave; KeyError or ValueError where it is of another shape."""
        for run, excursions in enumerate(self._excursions):
            excursions.load(part_of(state, str(run)))
            if self._low.best and excursions.best:
                self._low.best.keep(excursions.best_row, self._transitions(excursions.best))

    def _transitions(self, walk: list[Step]) -> Transitions:
        terminated = np.array([step.terminated for step in walk], dtype=np.bool_)
        return Transitions(
            np.array([[step.state, step.next_state] for step in walk], dtype=np.int64).T,
            np.array([step.action for step in walk], dtype=np.int64),
            np.array([step.reward for step in walk]),
            self._low.discounts(terminated),
        )
