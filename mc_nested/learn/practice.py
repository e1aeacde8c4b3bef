"""Practice: what a preset makes of the steps that were done, and what it does before an episode.

A preset names one of three (training.py: ``practice_of``): none but the paper's, which stores every step and updates
from the replay, and explores by ε (Practice); excursions from the best episode (exploration/); or a learnt
game to practise in (learnt_game.py).
"""

from collections.abc import Callable, Collection, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.imagination import Imagination
from mc_nested.learn.imagination.known_arena import Knowing
from mc_nested.learn.preset import Preset


class Step(NamedTuple):
    """A step of all runs as it was done; every array is of all runs or, where builders share an arena, of all of those.

    Args:
        learning: the runs in whose training episode it is, (k,).
        running: which runs aren't finished, (runs,).
        observations: what was seen before it.
        materials: what was in hand, (runs,).
        states: the low-level agents' states before it.
        actions: what was done.
        rewards: r_N.
        next_observations: what was seen after it.
        next_materials: what is in hand then, (runs,).
        terminated: whether it terminated the episode.
        draws: numbers that select the batches of its updates, (runs, numbers).
    """

    learning: Int64s
    running: Bools
    observations: NDArray[Any]
    materials: Int64s
    states: NDArray[Any]
    actions: Int64s
    rewards: Float64s
    next_observations: NDArray[Any]
    next_materials: Int64s
    terminated: Bools
    draws: Float64s


class Practice:
    """No practice but the paper's: each step is stored, and updates from the replay follow it.

    Args:
        agent: what learns.
        preset: the hyper-parameters.
    """

    numbers = 0
    """Random numbers that it needs for each run and tick."""

    imagination: Imagination | None = None
    """What the runs have learnt of their games; None if the preset has no [imagination]."""

    known: Knowing | None = None
    """What the runs know of their arenas; None if they learn no more than values."""

    def __init__(self, agent: Agent, preset: Preset) -> None:
        self._agent, self._preset = agent, preset
        self.untold: list[str] = []
        """What a user should know and wasn't told yet, a line each."""

    @property
    def evaluate_every(self) -> int:
        """Training episodes from one greedy evaluation to the next, at least."""
        return self._preset.evaluate_every

    def before_choice(self, runs: Int64s, elsewhere: Collection[int] = ()) -> None:
        """Learn what the main agent has to know before it chooses in the named runs (k,).

        ``elsewhere``: the materials that other games are playing.
        """

    def before_episode(self, runs: Int64s, materials: Int64s, reset: Callable[[], None]) -> Bools:  # noqa: ARG002
        """Reset the arenas of the named runs (k,); return which may be evaluated, (k,). ``materials`` are (runs,)."""
        reset()
        return np.ones(len(runs), dtype=np.bool_)

    def practise(self, run: int, material: int, number: int | None, elsewhere: Collection[Cell] | None) -> bool:  # noqa: ARG002
        """Practise that run's agent with that material; return whether it may be evaluated.

        ``number`` is the practice's, None for that before the run's next episode; other games probe the cells
        ``elsewhere``, None where there are no such games.
        """
        return True

    def begin(self, runs: Int64s, numbers: Float64s) -> None:
        """Begin an episode in each of the named runs (k,), with the numbers of all, (runs, numbers)."""

    def act(self, runs: Int64s, observations: NDArray[Any], actions: Int64s, numbers: Float64s) -> Int64s:  # noqa: ARG002
        """Return all runs' actions; those of the named runs (k,) may differ from the ε-greedy ones that are given."""
        return actions

    def is_settled(self, run: int) -> bool:  # noqa: ARG002
        """Return whether that run's actions are the ε-greedy ones, of the networks as they are, until its end."""
        return False

    def learn(self, step: Step) -> None:
        """Store the step of the runs that learn from it, and update."""
        agent, low_level, materials = self._agent, self._agent.low_level, step.materials
        next_states = agent.low_level_states(step.next_observations, step.next_materials)
        rows = []
        for own in agent.builders_of(step.learning):
            rows.append(agent.low_level_rows(own, materials))
            done = step.actions[own], step.rewards[own], next_states[own], step.terminated[own]
            low_level.store(rows[-1], step.states[own], *done)
        self.observe(step, next_states)
        updates, runs = self._preset.updates_a_step, step.learning
        shape = len(runs), len(rows) * updates, self._preset.update.batch
        draws = step.draws.take(runs, axis=0).reshape(shape)
        for update in range(shape[1]):
            low_level.learn(rows[update // updates], draws[:, update])

    def observe(self, step: Step, next_states: NDArray[Any]) -> None:
        """See a step that is stored, before its updates."""

    def end(self, runs: Int64s, materials: Int64s, scores: Float64s) -> None:
        """End the episodes of the named runs (k,); materials and scores are of all."""

    def epsilon_in_a_game(self, run: int, epsilon: float, games: int) -> float:  # noqa: ARG002
        """Return the ε of that run's next episode in a game beside so many others; it is given as by the preset."""
        return epsilon

    def news(self) -> list[str]:
        """Return what was ``untold``, which is told now."""
        told, self.untold = self.untold, []
        return told

    def probes(self, run: int, material: int) -> frozenset[Cell]:  # noqa: ARG002
        """Return the unknown cells where that run's next episode should place a block."""
        return frozenset()

    def first_tries(self, run: int, games: int) -> FirstTries | None:  # noqa: ARG002
        """Return what an episode of that run tries before it does what the policy says, beside so many other games."""
        return None

    def state(self) -> Arrays:
        """Return what it remembers of past episodes beside the replays, by name."""
        return {}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
