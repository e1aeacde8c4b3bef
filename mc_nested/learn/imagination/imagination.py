"""The imagination of an agent's runs: what each has seen of its game, and practice in what it has learnt of it.

Between two real episodes: learn the rules and beliefs anew from all transitions, let the main agent learn from the
scores that each material would bring, and practise the nested agent in the learnt game. Then a real episode is played
greedily. The real game is explored only by optimism in the learnt one (beliefs.py), except for the very first
steps, which try the actions.
"""

from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from mc_nested.arena.action import Cell
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s, named_for, named_parts, part_of
from mc_nested.learn.dqn.states import numbered
from mc_nested.learn.imagination.arena_step import expected_landings, imagined_arena
from mc_nested.learn.imagination.beliefs import Belief, Beliefs, believe, evidence_of
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.first_tries import FirstTries
from mc_nested.learn.imagination.known_arena import KnownArena, known_arena
from mc_nested.learn.imagination.learnt_rules import LearntRules, learn_rules, unclear_moves
from mc_nested.learn.imagination.material_choice import learn_choice, scores_of_materials
from mc_nested.learn.imagination.noticing import Assumption, broken_assumption
from mc_nested.learn.imagination.practice_session import (
    Goal,
    NetworkPractice,
    PracticeSession,
    RealTransitions,
    landed_cells,
)
from mc_nested.learn.learner import CHOICE_NUMBERS, Learner
from mc_nested.learn.preset import ImaginationRule, Preset
from mc_nested.learn.streams import Purpose, stream

THOROUGH = 0.999
"""Replaces ``enough`` beside other games: a policy that leaves a block over would take all the steps of an episode."""


def learnt_game(state: Mapping[str, NDArray[Any]], run: int) -> Arrays:
    """Return one run's part of a saved imagination (``Imagination.state``), to begin others from.

    Raise KeyError if it has none.
    """
    own = {name: state[name][run] for name in ("untried", "tries")}
    return {**own, **named_for("seen", part_of(state, str(run)))}


class GivenFacts(NamedTuple):
    """What a run knows of its game from the beginning: (x, y, b) after a reset, cells a side, steps, materials."""

    start: tuple[int, int, int]
    size: int
    step_limit: int
    materials: int


class Imagination:
    """The learnt games of all runs of an agent that has a main agent, and its practice in them.

    Args:
        main: the main agent's learner, a row a run.
        low_level: the nested agent's learner, a row a run; or the low-level agents', a row a run and material.
        given: of each run.
        preset: the hyper-parameters.
        rule: its table [imagination].
        seed: of all random choices.
        runs: each run's number (streams.py).
    """

    def __init__(
        self,
        main: Learner,
        low_level: Learner,
        given: Sequence[GivenFacts],
        preset: Preset,
        rule: ImaginationRule,
        seed: int,
        runs: Sequence[int],
    ) -> None:
        self._main, self._low_level, self._space = main, low_level, numbered(low_level.states)
        self._given_facts = given
        self._rule, self._seed, self._numbers = rule, seed, runs
        self._practice = NetworkPractice(low_level, preset, rule)
        self._experience = [Experience() for _ in runs]
        self._rules: dict[int, tuple[tuple[int, int], LearntRules]] = {}
        self._rows_a_run = self._space.rows // len(runs)
        self._explores, self._falls_short = np.ones(len(runs), dtype=np.bool_), np.zeros(len(runs), dtype=np.bool_)
        self._untried = np.ones((len(runs), self._space.actions), dtype=np.bool_)
        self._unclear = np.zeros_like(self._untried)
        self._tries = np.zeros((len(runs), self._space.actions), dtype=np.int64)

    def rules(self, run: int) -> LearntRules:
        """Return what that run has learnt of moving and placing."""
        seen = self._experience[run]
        actions, size = self._space.actions, self._given_facts[run].size
        if run not in self._rules or self._rules[run][0] != seen.length:
            self._rules[run] = seen.length, learn_rules(seen.steps, seen.first_of_episode, actions, size)
        return self._rules[run][1]

    def broken_assumption(self, run: int) -> Assumption:
        """Return what doesn't hold of that run's learnt game, by its last episodes, which have ended."""
        return broken_assumption(self.rules(run).astray, self._experience[run].first_of_episode)

    def stream(self, run: int, number: int | None = None) -> Generator:
        """Return the random numbers of that run's practice of that number; unless given, of that before its episode."""
        return stream(
            Purpose.PRACTICE, self._seed, self._numbers[run], self.episodes(run) if number is None else number
        )

    def beliefs(self, run: int, elsewhere: Collection[Cell] = ()) -> Beliefs:
        """Return what that run thinks of every cell; what is probed ``elsewhere`` is taken to pay nothing."""
        here, rule, rules = self._given_facts[run], self._rule, self.rules(run)
        evidence = evidence_of(self._experience[run].steps, rules.lands, here.size)
        blocks = here.start[2]
        return believe(evidence, rules.lands, blocks, rule.optimism, rule.neighbours, elsewhere, rules.walls)

    def learn_choice(self, run: int, elsewhere: Collection[int] = ()) -> None:
        """Let the main agent of that run learn what each material would bring in its learnt game.

        Of the materials that are played ``elsewhere``, an untried one isn't worth another try.
        """
        here = self._given_facts[run]
        scores = scores_of_materials(
            self._experience[run].extras, here.materials, here.start[2], self.beliefs(run).most, elsewhere
        )
        learn_choice(self._main, run, np.array(here.start), scores)

    def practise(
        self, run: int, material: int, number: int | None = None, elsewhere: Collection[Cell] | None = None
    ) -> bool:
        """Practise that run's agent with that material; return whether its policy now builds all of a known design.

        ``number`` and ``elsewhere`` as for ``session``.
        """
        session = self.session(run, material, number, elsewhere)
        session.run()
        return self.builds_it_all(run, session)

    def builds_it_all(self, run: int, session: PracticeSession) -> bool:
        """Return whether that practice, the run's last one, found a policy that builds all of a known design."""
        self._falls_short[run] = not session.practised.reached
        return session.practised.reached and not bool(self._explores[run])

    def session(
        self, run: int, material: int, number: int | None = None, elsewhere: Collection[Cell] | None = None
    ) -> PracticeSession:
        """Return a practice of that run's agent with that material, to be run.

        It is over at once before the game's first step. Where the last one fell short of building all of a known
        design, the networks begin anew. ``number`` is the practice's: its random numbers depend on it. Unless given, it
        is how many episodes the run has begun. What is probed ``elsewhere``, in games whose episodes are still to come,
        is taken to pay nothing; None where there are no such games.
        """
        seen, here = self._experience[run], self._given_facts[run]
        rules = self.rules(run)
        beliefs = self.beliefs(run, elsewhere or ())
        anew = bool(self._falls_short[run]) and not self._explores[run] and not beliefs.explores
        self._explores[run] = beliefs.explores
        self._unclear[run] = unclear_moves(seen.steps, self._space.actions)
        arena = imagined_arena(rules, beliefs)
        x, y, blocks = here.start
        if beliefs.explores:
            aim = (self._rule.enough if elsewhere is None else THOROUGH) * beliefs.most
            most_updates, most_table_steps = self._rule.updates_exploring, self._rule.table_steps_exploring
        else:
            aim = beliefs.most
            most_updates, most_table_steps = self._rule.updates_building, self._rule.table_steps_building
        if not len(seen.steps):
            most_updates = most_table_steps = 0
        goal = Goal((x, y), blocks, here.step_limit, aim, most_updates, most_table_steps, anew)
        real = self._real_transitions(run, material, landed_cells(seen.steps, rules.lands, arena))
        row, others = self._row(run, material), self._appended(material)
        return self._practice.session(row, arena, goal, others, real, self.stream(run, number))

    def begin(self, runs: Int64s) -> None:
        """Begin an episode in each of the named runs."""
        for run in runs:
            self._experience[run].begin()

    def act(self, runs: Int64s, actions: Int64s) -> Int64s:
        """Return the named runs' actions (k,): first tries (first_tries.py), or those in ``actions`` (all runs')."""
        chosen: Int64s = actions[runs].copy()
        for at, run in enumerate(runs.tolist()):
            chosen[at] = self.first_tries(run).act(int(chosen[at]), self._experience[run].tried_here())
        return chosen

    def observe(
        self, runs: Int64s, before: Int64s, materials: Int64s, actions: Int64s, rewards: Float64s, after: Int64s
    ) -> None:
        """Record what the actions of the named runs did; every array is of all runs, observations are (runs, 3)."""
        for run in runs.tolist():
            action, moved = int(actions[run]), bool((before[run, :2] != after[run, :2]).any())
            self.first_tries(run).observe(action, moved, self._experience[run].tried_here())
            paid = int(rewards[run] > 0)
            step = [*before[run].tolist(), action, *after[run].tolist(), paid, int(materials[run])]
            self._experience[run].add(RealStep(*step))

    def end(self, runs: Int64s, materials: Int64s, scores: Float64s) -> None:
        """End the episodes of the named runs; materials and scores are of all runs."""
        for run in runs.tolist():
            self._experience[run].end(int(materials[run]), float(scores[run]))

    def has_experience(self, run: int) -> bool:
        """Return whether anything is known of what that run's actions do."""
        return len(self._experience[run].steps) > 0

    def first_tries(self, run: int) -> FirstTries:
        """Return what that run has tried of its actions; its arrays are the run's own."""
        is_so = bool(self._explores[run]), bool(self._falls_short[run]), self._experience[run].is_stuck
        return FirstTries(*is_so, self._untried[run], self._unclear[run], self._tries[run])

    def probes(self, run: int, material: int) -> frozenset[Cell]:
        """Return the unknown cells where that run's policy should place blocks next, with that material."""
        if not self.has_experience(run):
            return frozenset()
        here, beliefs = self._given_facts[run], self.beliefs(run)
        row, others = np.array([self._row(run, material)]), self._appended(material)

        def policy(state: tuple[int, int, int]) -> int:
            states = np.array([[*state, *others]])
            return int(self._low_level.act(states, np.zeros(1), np.ones((1, CHOICE_NUMBERS)), row)[0])

        arena = imagined_arena(self.rules(run), beliefs)
        landings = expected_landings(arena, here.start, here.step_limit, policy, self.first_tries(run).copied())
        return frozenset(cell for cell in landings if beliefs.cells[cell] in (Belief.UNKNOWN, Belief.BELIEVED))

    def known_arena(self, run: int) -> KnownArena:
        seen, here, rules = self._experience[run], self._given_facts[run], self.rules(run)
        evidence = evidence_of(seen.steps, rules.lands, here.size)
        return known_arena(seen, rules.lands, believe(evidence, rules.lands, here.start[2], walls=rules.walls))

    def episodes(self, run: int) -> int:
        return self._experience[run].episodes

    def begin_from(self, earlier: Mapping[str, NDArray[Any]], *, pays: bool, materials: bool) -> None:
        """Let every run know what another run's ``learnt_game`` holds; KeyError or ValueError if its shape differs.

        Without ``pays`` the cells' pay isn't taken over, without ``materials`` not what each material brought.
        """
        self._rules = {}
        for run, seen in enumerate(self._experience):
            seen.begin_from(part_of(earlier, "seen"), pays=pays, materials=materials)
            self._untried[run], self._tries[run] = earlier["untried"], earlier["tries"]

    def state(self) -> Arrays:
        """Return everything that later steps depend on, by name."""
        return {
            "explores": self._explores,
            "falls_short": self._falls_short,
            "untried": self._untried,
            "unclear": self._unclear,
            "tries": self._tries,
            **named_parts({str(run): seen.state() for run, seen in enumerate(self._experience)}),
        }

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned; KeyError or ValueError if its shape differs."""
        self._explores[:], self._falls_short[:] = state["explores"], state["falls_short"]
        self._untried[:], self._unclear[:] = state["untried"], state["unclear"]
        self._tries[:] = state["tries"]
        self._rules = {}
        for run, seen in enumerate(self._experience):
            seen.load(part_of(state, str(run)))

    def _row(self, run: int, material: int) -> int:
        return run if self._rows_a_run == 1 else run * self._rows_a_run + material

    def _appended(self, material: int) -> Int64s:
        """Return what follows x, y and b in a state of the low-level agent: the nested agent's a_M."""
        return np.array([material] * (len(self._space.strides) - 3), dtype=np.int64)

    def _real_transitions(self, run: int, material: int, landed: Int64s) -> RealTransitions:
        """Return the run's transitions as its low-level agent of that material saw them.

        There are none where the replay has none.
        """
        steps = self._experience[run].steps
        if not self._rule.real_transitions:
            steps, landed = steps[:0], landed[:0]
        own: Bools = steps[:, 2] <= self._given_facts[run].start[2]  # an earlier design may have had more blocks
        if self._rows_a_run > 1:
            own &= steps[:, 8] == material
        steps, landed = steps[own], landed[own]
        last = np.repeat(steps[:, 8:], len(self._space.strides) - 3, axis=1)
        before, after = (self._space.encoded(np.hstack((seen, last))) for seen in (steps[:, 0:3], steps[:, 4:7]))
        return RealTransitions(before, after, steps[:, 3], landed, steps[:, 6] == 0)
