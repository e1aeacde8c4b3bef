"""Who chooses the material in R runs: the main agent, with a transition for each choice (paper, Algorithm 1).

It chooses a material as an episode begins. In a scenario with parts it chooses again whenever the arena says so: each
time from the state (x, y, b) at that moment. A choice's transition is stored when the next one is due or the episode
ends: the state that it was made in, what was chosen, the r_M that was earned since, and the state that it led to. In
the paper there is one choice, and its r_M is the episode's score. The single agent chooses by an action like any other.
"""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.learner import CHOICE_NUMBERS, Learner
from mc_nested.learn.preset import Preset
from mc_nested.learn.streams import Purpose, stream


class ChoiceStep(NamedTuple):
    """A step of all runs, as the main agent sees it; every array is (runs, ...).

    Args:
        states: what it shows after it: (x, y, b), or planes.
        earned: the episode's r_M so far; if it has ended, its score.
        ended: whether it has ended.
        due: whether a choice is due; None where each is made as an episode begins.
        draws: the numbers of the step's tick that select a batch, (runs, batch).
        tick: the tick's number.
    """

    states: NDArray[Any]
    earned: Float64s
    ended: Bools
    due: Bools | None
    draws: Float64s
    tick: int


class OwnChoices:
    """The choices of runs whose single agent makes them by its actions: there is nothing else to do."""

    def __init__(self, agent: Agent) -> None:
        self._agent = agent

    def begin(self, rows: Int64s, epsilon: Float64s, numbers: Float64s) -> Int64s:  # noqa: ARG002 - nothing is drawn
        """Return the materials with which the episodes of the named runs (k,) begin."""
        return self._agent.begin_episodes(rows)

    def in_hand(self, actions: Int64s, materials: Int64s) -> Int64s:  # noqa: ARG002 - an action says it
        """Return the actions as the arenas take them."""
        return actions

    def after(self, step: ChoiceStep, materials: Int64s, learning: Bools, epsilon: Float64s) -> Int64s:  # noqa: ARG002
        """Return the materials after a step, (runs,), as the agent sees them; -1 before its choice."""
        return self._agent.chosen_materials(step.states)

    def learn(self, rows: Int64s, materials: Int64s, step: ChoiceStep) -> None:
        """Learn nothing: the agent's own steps say all."""

    def state(self) -> Arrays:
        """Return nothing: there is no state."""
        return {}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Load nothing."""


class MainChoices(OwnChoices):
    """The main agent's part in the episodes of R runs.

    With an [imagination] it learns in the learnt game alone (imagination/material_choice.py).

    Args:
        agent: whose main agent chooses.
        main: its main agent.
        scenarios: each run's scenario.
        preset: the hyper-parameters.
        seed: of the training's random choices.
    """

    def __init__(self, agent: Agent, main: Learner, scenarios: Sequence[Scenario], preset: Preset, seed: int) -> None:
        super().__init__(agent)
        self._main, self._preset, self._seed = main, preset, seed
        self._has_parts = any(scenario.parts for scenario in scenarios)
        self._start = agent.start_states(scenarios)
        self._chosen_in = self._start.copy()
        self._earned = np.zeros(len(scenarios))

    def begin(self, rows: Int64s, epsilon: Float64s, numbers: Float64s) -> Int64s:
        """Return the choices with which the episodes of the named runs (k,) begin; ε (k,), numbers (runs, 2)."""
        self._chosen_in[rows] = self._start[rows]
        self._earned[rows] = 0.0
        return self._main.act(self._start[rows], epsilon, numbers[rows], rows)

    def in_hand(self, actions: Int64s, materials: Int64s) -> Int64s:
        """Return the actions as the arenas take them, (runs,).

        With parts, each action stands beside its run's material, (runs, 2).
        """
        return np.stack((actions, materials), axis=1) if self._has_parts else actions

    def after(self, step: ChoiceStep, materials: Int64s, learning: Bools, epsilon: Float64s) -> Int64s:
        """Return the materials after a step, (runs,): where a choice is due, the last is learned from, and one is made.

        Every array is of all runs. ``learning``: whose choices are learned from, and made with ε.
        """
        if step.due is None or not step.due.any():
            return materials
        self.learn(np.flatnonzero(step.due & learning), materials, step)
        rows = np.flatnonzero(step.due)
        self._chosen_in[rows] = step.states[rows]
        self._earned[rows] = step.earned[rows]
        # Drawn only when they are needed, which leaves the numbers of every tick as they were without choices.
        runs = [self._agent.runs[row] for row in rows.tolist()]
        drawn = [stream(Purpose.CHOICES, self._seed, run, step.tick).random(CHOICE_NUMBERS) for run in runs]
        chosen: Int64s = materials.copy()
        explores = np.where(learning, epsilon, 0.0)[rows]
        chosen[rows] = self._main.act(step.states[rows], explores, np.stack(drawn), rows)
        return chosen

    def learn(self, rows: Int64s, materials: Int64s, step: ChoiceStep) -> None:
        """Store the last choice of each named run (k,), and update: it is over with this step.

        ``materials`` (runs,) are what was chosen. If the episode has ended, nothing is left to choose.
        """
        if not len(rows) or self._preset.imagination:
            return
        returns = step.earned[rows] - self._earned[rows]
        self._main.store(rows, self._chosen_in[rows], materials[rows], returns, step.states[rows], step.ended[rows])
        for update in self._draws(rows, step):
            self._main.learn(rows, update)

    def state(self) -> Arrays:
        """Return the choices that aren't over, for a checkpoint; nothing where each is made as an episode begins."""
        return {"chosen_in": self._chosen_in, "earned": self._earned} if self._has_parts else {}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
        for name, kept in self.state().items():
            kept[:] = state[name]

    def _draws(self, rows: Int64s, step: ChoiceStep) -> Float64s:
        """Return the numbers that select the batches of the updates now, (updates, k, batch)."""
        if self._preset.main is None:
            return step.draws[None, rows]
        shape = self._preset.main.updates_an_episode, self._preset.update.batch
        streams = [stream(Purpose.MAIN_UPDATES, self._seed, self._agent.runs[row], step.tick) for row in rows.tolist()]
        return np.stack([each.random(shape) for each in streams], axis=1)
