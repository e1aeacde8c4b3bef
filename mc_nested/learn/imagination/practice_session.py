"""Practice of one learner in its learnt game, until its greedy policy plays it well enough, or a budget ends."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.random import Generator

from mc_nested.arena.action import Cell
from mc_nested.arrays import Bools, Float64s, Int64s
from mc_nested.learn.dqn.compiled_engine.cell_networks import passes_for
from mc_nested.learn.dqn.compiled_engine.engine import Networks, compiled_engine
from mc_nested.learn.dqn.compiled_engine.networks import initial_parameters, parameter_count
from mc_nested.learn.dqn.states import numbered
from mc_nested.learn.imagination.arena_step import NOWHERE, ImaginedArena, ImaginedTask, index_of
from mc_nested.learn.imagination.practice_kernel import PracticeReplay, PracticeRule, Progress, Workspace, practise
from mc_nested.learn.imagination.table_learner import QTables, TablePractice, empty_tables, empty_trail, longest_episode
from mc_nested.learn.learner import Learner
from mc_nested.learn.preset import MOST_BEFORE_PRACTICE, ImaginationRule, Preset

CAPACITY = MOST_BEFORE_PRACTICE
"""Imagined transitions that are kept, the last ones; a practice begins with the real ones alone."""

NUMBERS_AT_ONCE = 65_536
"""Random numbers that are drawn at once: for a tenth of a second of practice."""

BY_TABLE = 0.5
"""This share of the imagined episodes that a network learns from is played by the table, the rest by the network."""


class RealTransitions(NamedTuple):
    """The real game's transitions as indices of states, (k,) each; ``landed`` are cells of the imagined arena."""

    states: Int64s
    next_states: Int64s
    actions: Int64s
    landed: Int64s
    terminated: Bools


class Goal(NamedTuple):
    """What is practised: from which cell, with how many blocks and steps, up to which score.

    For at most so many updates of the networks, after at most so many imagined steps of the tables. ``anew``: the
    networks first forget all; what they learnt in vain can keep them from learning (Nikishin et al., 2022).
    """

    start: Cell
    blocks: int
    step_limit: int
    aim: float
    most_updates: int
    most_table_steps: int
    anew: bool = False


class Practised(NamedTuple):
    """What a practice came to: its updates and imagined episodes, the best greedy score, whether that was enough."""

    updates: int
    episodes: int
    score: float
    reached: bool


class PracticeSession:
    """One practice of one row, which can be stopped and gone on with.

    A policy that learns gets worse now and then. What practice leaves, and what plays, is the one that did best.

    Args:
        own: the row's networks, which are updated.
        begin: called before the first update.
        practise: uses up the numbers it gets for practising those networks; DivergedError if they are no numbers then.
        goal: what is practised.
        random: all its random numbers come from here.
        numbers_at_once: how many ``practise`` gets.
    """

    def __init__(
        self,
        own: Networks,
        begin: Callable[[], None],
        practise: Callable[[Float64s, Networks, Progress], None],
        goal: Goal,
        random: Generator,
        numbers_at_once: int,
    ) -> None:
        self._own = self._parts = own
        self._begin, self._practise = begin, practise
        self._random, self._numbers_at_once = random, numbers_at_once
        self._has_begun = False
        self._first, self._goal = int(own.updates[0]), goal
        self._progress = Progress(np.zeros(1, np.int64), np.zeros(1), np.zeros(1, np.bool_), own.online.copy())

    @property
    def practised(self) -> Practised:
        """What it came to so far."""
        done, score = self._progress, float(self._progress.best_score[0])
        reached = bool(done.reached[0]) and score >= self._goal.aim
        return Practised(self._updates, int(done.episodes[0]), score, reached)

    @property
    def is_over(self) -> bool:
        """Whether the aim is reached, or all that the table reached, or the budget used up."""
        return bool(self._progress.reached[0]) or self._updates >= self._goal.most_updates

    def prepare(self) -> None:
        """Compile what practice runs, if that isn't done: a compiler doesn't leave Python's lock to other threads."""
        self._practise(np.empty(0), self._parts, self._progress)

    def run(self, goes_on: Callable[[], bool] = lambda: True) -> None:
        """Practise until it is over, or ``goes_on``, which is asked about ten times a second, says no.

        DivergedError if a parameter is no number any more.
        """
        while not self.is_over and goes_on():
            if not self._has_begun:
                self._begin()
                self._has_begun = True
            self._practise(self._random.random(self._numbers_at_once), self._parts, self._progress)
        if self.is_over:
            self._parts.online[:] = self._parts.target[:] = self._progress.best

    def go_on_with_a_copy(self) -> None:
        """Update a copy of the networks from now on, until ``take_over``; the row has the best ones meanwhile."""
        self._parts = Networks(*(part.copy() for part in self._own))
        self._own.online[:] = self._own.target[:] = self._progress.best

    def take_over(self) -> None:
        """Put the best networks, and the moments of those that are updated, into the row."""
        own, practised = self._own, self._parts
        own.online[:] = own.target[:] = self._progress.best
        own.first_moment[:], own.second_moment[:] = practised.first_moment, practised.second_moment
        own.updates[:] = practised.updates

    @property
    def _updates(self) -> int:
        return int(self._parts.updates[0]) - self._first


class NetworkPractice:
    """Practises the rows of one learner, one at a time.

    Args:
        learner: its networks are updated; its own replay isn't touched.
        preset: the hyper-parameters.
        rule: its table [imagination].
    """

    def __init__(self, learner: Learner, preset: Preset, rule: ImaginationRule) -> None:
        self._engine, self._space = compiled_engine(learner.engine), numbered(learner.states)
        update = preset.update
        own = update.gamma, update.learning_rate, update.target_period, update.huber_delta, update.learning_starts
        epsilons = rule.highest_epsilon, rule.lowest_epsilon
        self._rule = PracticeRule(*own, *epsilons, rule.double, rule.n_steps, BY_TABLE)
        self._batch = update.batch
        self._replay = PracticeReplay(
            states=np.zeros(CAPACITY, np.int32),
            next_states=np.zeros(CAPACITY, np.int32),
            actions=np.zeros(CAPACITY, np.uint8),
            landed=np.zeros(CAPACITY, np.int16),
            terminated=np.zeros(CAPACITY, np.bool_),
            added=np.zeros(1, np.int64),
        )
        self._tables: QTables | None = None
        self._workspaces = [self._workspace(row) for row in range(self._space.rows)]

    def session(
        self, row: int, arena: ImaginedArena, goal: Goal, others: Int64s, real: RealTransitions, random: Generator
    ) -> "PracticeSession":
        """Return a practice of that row, to be run; ``others`` are the integers of its state after x, y and b.

        ``real`` are in its replay from the beginning. A learner's sessions share arrays: once one has begun, those
        before it can't go on.
        """
        space, engine = self._space, self._engine
        offset = int(others @ space.strides[3:])
        task = ImaginedTask(
            index_of(goal.start, arena), goal.blocks, goal.step_limit, goal.aim, space.strides[:3], offset
        )
        tables, rule = self._tables_for(arena, goal.step_limit), self._rule
        table = TablePractice(tables, arena, task, rule.gamma, goal.most_table_steps, random)
        own = engine.row(row)
        work = self._workspaces[row]._replace(table=tables.by_blocks)
        if not goal.most_table_steps:
            rule = rule._replace(by_table=0.0)

        def begin() -> None:
            count = min(len(real.states), CAPACITY)
            for kept, given in zip(self._replay, real, strict=False):
                kept[:count] = given[-CAPACITY:]
            self._replay.added[0] = count
            work.seen_in[:] = -1
            if goal.anew:
                own.online[:] = own.target[:] = initial_parameters(engine.sizes, random)
                own.first_moment[:] = own.second_moment[:] = 0.0
            table.begin()

        def practise_on(numbers: Float64s, parts: Networks, progress: Progress) -> None:
            if not table.is_over:
                table.learn(numbers)
                if len(numbers):
                    return
            table.end()
            practise(numbers, arena, task._replace(aim=table.aim), rule, parts, self._replay, work, progress)
            engine.check_finite(row, parts.online)

        longest = max(2 + goal.step_limit * (2 + self._batch), longest_episode(task))
        return PracticeSession(own, begin, practise_on, goal, random, max(NUMBERS_AT_ONCE, 2 * longest))

    def _tables_for(self, arena: ImaginedArena, step_limit: int) -> QTables:
        """Return this learner's tables, made anew if the arena has another number of cells than before."""
        space, cells = self._space, len(arena.empty)
        if self._tables is None or len(self._tables.built.here) != cells:
            self._tables = empty_tables(space.count, space.actions, cells)
        return self._tables._replace(
            trail=empty_trail(step_limit), best=empty_trail(step_limit), best_steps=np.zeros(1, np.int64)
        )

    def _workspace(self, row: int) -> Workspace:
        sizes, space = self._engine.sizes, self._space
        return Workspace(
            sizes=np.array(sizes),
            numbers=space.rest_of(row),
            acting=passes_for(sizes, 1),
            batch=passes_for(sizes, self._batch),
            next_batch=passes_for(sizes, self._batch),
            scratch=passes_for(sizes, self._batch),
            slope=np.zeros((sizes[-1], self._batch), np.float32),
            gradient=np.zeros(parameter_count(sizes), np.float32),
            seen_in=np.full(space.count, -1, np.int64),
            table=np.zeros((0, space.actions), np.float32),
        )


def landed_cells(steps: Int64s, lands: Cell, arena: ImaginedArena) -> Int64s:
    """Return where the block of each real transition (steps, 9) landed, as cells of the arena.

    It is NOWHERE where none did.
    """
    used = steps[:, 2] > steps[:, 6]
    cells = np.array([index_of((x + lands[0], y + lands[1]), arena) for x, y in steps[:, 4:6].tolist()], dtype=np.int64)
    return np.where(used, cells, NOWHERE)
