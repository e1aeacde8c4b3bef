"""The practice of a preset with [imagination]: in a game that is learnt from what was played (imagination/).

Where that game turns out not to hold, a run returns and explores in every other episode (exploration/), before which
its networks learn what the best one did. In the others it goes on: what is wrong somewhere may still be right enough.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s, named_for, part_of
from mc_nested.learn.agents import Agent
from mc_nested.learn.exploration.return_then_explore import Excursions
from mc_nested.learn.imagination.background_practice import Background, BackgroundPractice, Foreground
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.imagination import GivenFacts, Imagination
from mc_nested.learn.imagination.noticing import IN_WORDS
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import ExcursionRule, Preset

INSTEAD = ExcursionRule(at_end=0.1, wander=12, rejoin=0.4, repeat=0.8)
"""How a run explores whose learnt game doesn't hold: as by the preset tuned."""

EPSILON_INSTEAD = 0.1
"""Its ε in a game of several, for which the learner plans no excursion."""


class LearntGame(Practice):
    """Practice in the learnt game, before the real one is reset, or beside it; real steps are only remembered.

    Args:
        agent: what learns.
        preset: the hyper-parameters.
        imagination: the learnt games of its runs.
        scenarios: each run's scenario, for excursions in the place of a game that doesn't hold.
        background: where it runs; to its end before the game is reset, unless given.
    """

    numbers = Excursions.numbers
    evaluate_every = 1
    """A policy that builds all of a known design is evaluated at once."""

    def __init__(
        self,
        agent: Agent,
        preset: Preset,
        imagination: Imagination,
        scenarios: Sequence[Scenario],
        background: Background | None = None,
    ) -> None:
        super().__init__(agent, preset)
        self.imagination: Imagination = imagination
        self.known = imagination
        self._sessions = BackgroundPractice(background or Foreground())
        self._excursions = Excursions(agent, preset, INSTEAD, scenarios)
        # What doesn't hold of each run's learnt game; negative while that has its turn all the same.
        self._broken = np.zeros(len(scenarios), dtype=np.int64)

    def before_choice(self, runs: Int64s, elsewhere: Collection[int] = ()) -> None:
        self._sessions.end_of_episode()
        for run in runs.tolist():
            self.imagination.learn_choice(run, elsewhere)

    def before_episode(self, runs: Int64s, materials: Int64s, reset: Callable[[], None]) -> Bools:
        broken, own = runs[self._broken[runs] > 0].tolist(), runs[self._broken[runs] <= 0].tolist()
        practised = {run: self.practise(run, int(materials[run]), None, None) for run in broken}
        sessions = {run: self.imagination.session(run, int(materials[run])) for run in own}
        self._sessions.during_reset(sessions, reset)
        practised |= {run: self.imagination.builds_it_all(run, session) for run, session in sessions.items()}
        self._sessions.during_episode()
        return np.array([practised[run] for run in runs.tolist()], dtype=np.bool_)

    def practise(self, run: int, material: int, number: int | None, elsewhere: Collection[Cell] | None) -> bool:
        if self._broken[run] > 0:
            return self._excursions.teach_best(run, material, self.imagination.stream(run))
        return self.imagination.practise(run, material, number, elsewhere)

    def begin(self, runs: Int64s, numbers: Float64s) -> None:
        self.imagination.begin(runs)
        self._excursions.begin(runs, numbers * (self._broken > 0)[:, None])

    def act(self, runs: Int64s, observations: NDArray[Any], actions: Int64s, numbers: Float64s) -> Int64s:
        actions[runs] = self.imagination.act(runs, actions)
        return self._excursions.act(runs[self._broken[runs] > 0], observations, actions, numbers)

    def is_settled(self, run: int) -> bool:
        return self._broken[run] <= 0 and self.imagination.first_tries(run).are_over

    def learn(self, step: Step) -> None:
        done = step.materials, step.actions, step.rewards, step.next_observations
        self.imagination.observe(step.running.nonzero()[0], step.observations, *done)
        self._excursions.observe(step, self._agent.low_level_states(step.next_observations, step.next_materials))

    def end(self, runs: Int64s, materials: Int64s, scores: Float64s) -> None:
        self.imagination.end(runs, materials, scores)
        self._excursions.end(runs, materials, scores)
        self._broken[runs] *= -1  # the learnt game has its turn, or the excursions
        for run in runs[self._broken[runs] == 0].tolist():
            self._broken[run] = broken = self.imagination.broken_assumption(run)
            if broken:
                what = f"the learnt game doesn't hold: {IN_WORDS[broken]}; every other episode is an excursion now"
                self.untold.append(f"trial {run}: {what}" if len(self._broken) > 1 else what)

    def epsilon_in_a_game(self, run: int, epsilon: float, games: int) -> float:
        if self._broken[run] > 0:
            return EPSILON_INSTEAD
        # Another game already plays what an untaught network says, which may stand still. By chance other cells are
        # tried in each game, and an episode ends sooner.
        return 1.0 if games and not self.imagination.has_experience(run) else epsilon

    def probes(self, run: int, material: int) -> frozenset[Cell]:
        return frozenset() if self._broken[run] > 0 else self.imagination.probes(run, material)

    def first_tries(self, run: int, games: int) -> FirstTries | None:
        return None if self._broken[run] > 0 else self.imagination.first_tries(run).beside(games)

    def state(self) -> Arrays:
        excursions = named_for("excursions", self._excursions.state())
        return {**self.imagination.state(), **excursions, "broken": self._broken}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        self.imagination.load(state)
        self._excursions.load(part_of(state, "excursions"))
        self._broken[:] = state["broken"]


def imagination_of(agent: Agent, scenarios: Sequence[Scenario], preset: Preset, seed: int) -> Imagination | None:
    """Return the learnt games of an agent's runs, one scenario a run; None if the preset has no [imagination].

    Of a scenario it gets what every reset shows, and how large the arena and how long an episode is.
    """
    if preset.imagination is None or agent.main is None:
        return None
    known = given_facts_of(scenarios)
    return Imagination(agent.main, agent.low_level, known, preset, preset.imagination, seed, agent.runs)


def given_facts_of(scenarios: Sequence[Scenario]) -> list[GivenFacts]:
    """Return what is known of each scenario from the beginning: nothing of its design but how many blocks it has."""
    return [GivenFacts(each.start_state, each.size, each.step_limit, len(each.materials)) for each in scenarios]
