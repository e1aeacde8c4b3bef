"""The practice of a preset with [imagination]: in a game that is learnt from what was played (imagination/)."""

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s
from mc_nested.learn.agents import Agent
from mc_nested.learn.imagination.background_practice import Background, BackgroundPractice
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.imagination import Imagination, Surroundings
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import Preset


class LearntGame(Practice):
    """Practice in the learnt game, to its end, before the real one is reset; real steps are only remembered.

    Args:
        agent: what learns.
        preset: the hyper-parameters.
        imagination: the learnt games of its runs.
    """

    evaluate_every = 1
    """A policy that builds all of a known design is evaluated at once."""

    def __init__(self, agent: Agent, preset: Preset, imagination: Imagination) -> None:
        super().__init__(agent, preset)
        self._imagination = imagination

    @property
    def imagination(self) -> Imagination:
        return self._imagination

    def before_choice(self, runs: Int64s, elsewhere: Collection[int] = ()) -> None:
        for run in runs.tolist():
            self._imagination.learn_choice(run, elsewhere)

    def before_episode(self, runs: Int64s, materials: Int64s, reset: Callable[[], None]) -> Bools:
        practised = [self._imagination.practise(run, int(materials[run])) for run in runs.tolist()]
        reset()
        return np.array(practised, dtype=np.bool_)

    def practise(self, run: int, material: int, number: int, elsewhere: Collection[Cell] | None) -> bool:
        return self._imagination.practise(run, material, number, elsewhere)

    def begin(self, runs: Int64s, numbers: Float64s) -> None:  # noqa: ARG002 - it draws none
        self._imagination.begin(runs)

    def act(self, runs: Int64s, observations: NDArray[Any], actions: Int64s, numbers: Float64s) -> Int64s:  # noqa: ARG002
        actions[runs] = self._imagination.act(runs, actions)
        return actions

    def learn(self, step: Step) -> None:
        self._imagination.observe(
            step.running.nonzero()[0],
            step.observations,
            step.materials,
            step.actions,
            step.rewards,
            step.next_observations,
        )

    def end(self, runs: Int64s, materials: Int64s, scores: Float64s) -> None:
        self._imagination.end(runs, materials, scores)

    def knows_nothing(self, run: int) -> bool:
        return not self._imagination.has_experience(run)

    def probes(self, run: int, material: int) -> frozenset[Cell]:
        return self._imagination.probes(run, material)

    def first_tries(self, run: int, games: int) -> FirstTries:
        return self._imagination.first_tries(run).beside(games)

    def state(self) -> Arrays:
        return self._imagination.state()

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        self._imagination.load(state)


class LearntGameBesideIt(LearntGame):
    """Practice beside a live game, which can't wait: while the game resets, a little longer, and while an episode runs.

    Args:
        agent: what learns.
        preset: the hyper-parameters.
        imagination: the learnt games of its runs.
        background: where it runs.
    """

    def __init__(self, agent: Agent, preset: Preset, imagination: Imagination, background: Background) -> None:
        super().__init__(agent, preset, imagination)
        self._background = BackgroundPractice(background)

    def before_choice(self, runs: Int64s, elsewhere: Collection[int] = ()) -> None:
        self._background.end_of_episode()
        super().before_choice(runs, elsewhere)

    def before_episode(self, runs: Int64s, materials: Int64s, reset: Callable[[], None]) -> Bools:
        sessions = {run: self._imagination.session(run, int(materials[run])) for run in runs.tolist()}
        self._background.during_reset(sessions, reset)
        practised = [self._imagination.builds_it_all(run, session) for run, session in sessions.items()]
        self._background.during_episode()
        return np.array(practised, dtype=np.bool_)


def imagination_of(agent: Agent, scenarios: Sequence[Scenario], preset: Preset, seed: int) -> Imagination | None:
    """Return the learnt games of an agent's runs, one scenario a run; None if the preset has no [imagination].

    Of a scenario it gets what every reset shows, and how large the arena and how long an episode is.
    """
    if preset.imagination is None or agent.main is None:
        return None
    known = [
        Surroundings(scenario.start_state, scenario.size, scenario.step_limit, len(scenario.materials))
        for scenario in scenarios
    ]
    return Imagination(agent.main, agent.low_level, known, preset, preset.imagination, seed, agent.runs)
