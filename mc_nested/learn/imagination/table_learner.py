"""Q-learning with tables in the learnt game, compiled: they find the way, and the networks learn from where it goes.

Tables learn a hundred times as fast as a network (Watkins, 1989; in a learnt game, Sutton, 1991). They never play the
real game: they play imagined episodes, from whose transitions the networks learn by double Q-learning, beside their own
(practice_kernel.py).

Three tables learn from every episode, backwards, with a learning rate of 1. The values by the cell and the cells built
(built_values.py) are exact, but say nothing of a state that was never seen. There, the others guess: the values by the
agent's own state (x, y, b), and those by its cell and what is built around it. An episode goes as the exact values say
up to a step that is drawn, does a few actions by chance, and goes on (first return, then explore; Ecoffet et al.,
2021): where the surroundings are those of a step of the best way known, as that way does, and else as a guess.
"""

from typing import NamedTuple

import numpy as np
from numpy.random import Generator

from mc_nested.arrays import Bools, Float32s, Float64s, Int8s, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.imagination.arena_step import (
    GREEDY_EVERY,
    NOWHERE,
    ImaginedArena,
    ImaginedTask,
    is_wasted,
    state_at,
    step,
)
from mc_nested.learn.imagination.built_values import BuiltValues, begin_values, empty_values, forget, is_full, row_of

AROUND = 8
"""The cells around a cell: whether each is built makes as many bits of its surroundings."""

ROOM = 1 << 21
"""States that the exact values have room for."""

ANOTHER_BY_CHANCE, STRAYS = 0.7, 0.01
"""How likely another action by chance follows one, where an episode explores; and how likely any later one is."""

BY_BLOCKS = 0.5
"""In this share of the episodes a new state is guessed by (x, y, b), in the rest by what is built around."""

GAMMA_BUILT, GAMMA_AROUND = 0.999, 0.8
"""What a step without pay makes the exact values count for less; and any step those by what is built around."""

PREFERRED = 1.001
"""How many times the highest value the best way's has in the end."""

ENDS, GOES_ON = 0, 1
"""Whether an episode ended where nothing more could be paid, or where it could go on."""

NEARLY_0 = 1e-6
"""Guesses begin below this, each at another, so that among equal ones chance decides."""

FIRST_STEPS = 250_000
"""Steps after which the tables begin anew for the first time; each time after that it is twice as many.

Most designs take less. Where the first ways found lead nowhere, other ways are found sooner than better ones.
"""

NEARLY_1 = 1 - 1e-6
"""The same blocks in another order may add up to this share of the score."""


class QTables(NamedTuple):
    """The values by cell and cells built, by (x, y, b) (states, actions), and by cell and surroundings (2^8 of a cell).

    ``habits`` (cells x surroundings,) has what the best way known does there, -1 elsewhere. ``seen_in`` (states,) is
    the episode in which each state was last seen. ``trail`` (5, steps + 1) has the last episode's names
    (built_values.py), states, surroundings, actions and landed blocks' cells, and last the state that it ended in.
    ``best`` is the same of the last greedy episode, the best way known, ``best_steps`` (1,) how many steps that has.
    """

    built: BuiltValues
    by_blocks: Float32s
    by_around: Float32s
    habits: Int8s
    seen_in: Int64s
    trail: Int64s
    best: Int64s
    best_steps: Int64s


class TableProgress(NamedTuple):
    """What it came to, (1,) each: imagined episodes, steps learnt from, the last greedy score, whether it is enough."""

    episodes: Int64s
    steps: Int64s
    score: Float64s
    reached: Bools


def empty_trail(steps: int) -> Int64s:
    """Return a trail for an episode of at most so many steps."""
    return np.zeros((5, steps + 1), np.int64)


def empty_tables(states: int, actions: int, cells: int, steps: int = 0, room: int = ROOM) -> QTables:
    """Make tables for so many states of the agent, cells of the arena (border included), and steps; not yet begun."""
    by_blocks, by_around = (np.zeros((count, actions), np.float32) for count in (states, cells << AROUND))
    habits, seen_in = np.zeros(cells << AROUND, np.int8), np.zeros(states, np.int64)
    trails = empty_trail(steps), empty_trail(steps), np.zeros(1, np.int64)
    return QTables(empty_values(room, actions, cells), by_blocks, by_around, habits, seen_in, *trails)


def begin_tables(tables: QTables, random: Generator) -> None:
    """Forget everything."""
    begin_values(tables.built, random)
    for guesses in (tables.by_blocks, tables.by_around):
        guesses[:] = NEARLY_0 * random.random(guesses.shape, np.float32)
    tables.habits[:] = -1
    tables.seen_in[:] = -1
    tables.best_steps[0] = 0


@compiled(nogil=True)
def longest_episode(task: ImaginedTask) -> int:
    """Return how many numbers an episode uses at most."""
    return 3 + 2 * task.step_limit


@compiled(nogil=True)
def learn_table(
    uniforms: Float64s, arena: ImaginedArena, task: ImaginedTask, gamma: float, tables: QTables, progress: TableProgress
) -> None:
    """Learn until the greedy policy reaches the aim, or the numbers in [0, 1) don't suffice for another episode.

    Where an episode comes to a state again, a policy would go round for ever: it goes on by chance. ``gamma`` discounts
    the values by (x, y, b).
    """
    used = 0
    solid = arena.empty.copy()
    while used + longest_episode(task) <= len(uniforms) and not progress.reached[0]:
        if is_full(tables.built):
            forget(tables.built)
            _learn_backwards(tables, tables.best, tables.best_steps[0], arena, gamma)
        greedy = progress.episodes[0] % GREEDY_EVERY == 0
        explores_from = int(uniforms[used] * (tables.best_steps[0] + 1))
        explores_until = explores_from + 1 + int(np.log(1.0 - uniforms[used + 1]) / np.log(ANOTHER_BY_CHANCE))
        by_blocks = uniforms[used + 2] < BY_BLOCKS
        used += 3
        solid[:] = arena.empty
        position, blocks, score, steps = task.start, task.blocks, 0.0, 0
        wasted, built = False, 0
        state = state_at(position, blocks, arena, task)
        while blocks > 0 and steps < task.step_limit and not wasted:
            been_here = tables.seen_in[state] == progress.episodes[0]
            if greedy and been_here:
                break
            tables.seen_in[state] = progress.episodes[0]
            name, around = tables.built.here[position] ^ built, _around(position, solid, arena)
            action = _best_action(tables, name, state, around, by_blocks, greedy)
            if not greedy:
                explores = explores_from <= steps < explores_until
                strays = steps > explores_from and uniforms[used] < STRAYS
                if been_here or explores or strays:
                    action = int(uniforms[used + 1] * len(arena.moves))
                used += 2
            position, landed = step(arena, position, action, solid)
            if landed:
                blocks -= 1
                built ^= tables.built.built[landed]
                score += arena.pay[landed]
                wasted = not greedy and is_wasted(landed, arena)
            tables.trail[:, steps] = name, state, around, action, landed
            steps += 1
            state = state_at(position, blocks, arena, task)
        ends = blocks == 0 or wasted
        around = _around(position, solid, arena)
        tables.trail[:, steps] = tables.built.here[position] ^ built, state, around, ENDS if ends else GOES_ON, NOWHERE
        progress.episodes[0] += 1
        if greedy:
            progress.score[0], progress.reached[0] = score, score >= task.aim
            _follow(tables, steps)
        else:
            progress.steps[0] += steps
            _learn_backwards(tables, tables.trail, steps, arena, gamma)


@compiled(nogil=True)
def prefer_best(tables: QTables) -> None:
    """Make the values by (x, y, b) choose what the best way known does, in its states."""
    for at in range(tables.best_steps[0]):
        values, action = tables.by_blocks[tables.best[1, at]], tables.best[3, at]
        if np.argmax(values) != action:
            values[action] = PREFERRED * values.max() + NEARLY_0


@compiled(nogil=True)
def _around(position: int, solid: Bools, arena: ImaginedArena) -> int:
    """Return the index of that cell with what is built around it."""
    around = position
    for across in (-arena.side, 0, arena.side):
        for along in (-1, 0, 1):
            if across != 0 or along != 0:
                around = 2 * around + int(solid[position + across + along])
    return around


@compiled(nogil=True)
def _best_action(tables: QTables, name: int, state: int, around: int, by_blocks: bool, greedy: bool) -> int:
    """Return what the exact values say, or a guess where they know nothing."""
    exact = tables.built.values[row_of(tables.built, name)]
    if exact.max() > 0.0:
        return int(np.argmax(exact))
    if not greedy and tables.habits[around] >= 0:
        return int(tables.habits[around])
    return int(np.argmax(tables.by_blocks[state])) if by_blocks else int(np.argmax(tables.by_around[around]))


@compiled(nogil=True)
def _follow(tables: QTables, steps: int) -> None:
    """Take the last episode, of so many steps, for the best way known."""
    for at in range(tables.best_steps[0]):
        tables.habits[tables.best[2, at]] = -1
    tables.best[:] = tables.trail
    tables.best_steps[0] = steps
    for at in range(steps):
        tables.habits[tables.best[2, at]] = tables.best[3, at]


@compiled(nogil=True)
def _learn_backwards(tables: QTables, trail: Int64s, steps: int, arena: ImaginedArena, gamma: float) -> None:
    """Set the values of an episode's steps in every table, from the last to the first."""
    exact = by_blocks = by_around = 0.0
    if trail[3, steps] == GOES_ON:
        exact = float(tables.built.values[row_of(tables.built, trail[0, steps])].max())
        by_blocks = float(tables.by_blocks[trail[1, steps]].max())
        by_around = float(tables.by_around[trail[2, steps]].max())
    for at in range(steps - 1, -1, -1):
        name, state, around, action, landed = trail[:, at]
        pay = arena.pay[landed]
        values = tables.built.values[row_of(tables.built, name)]
        values[action] = pay + (1.0 if pay > 0 else GAMMA_BUILT) * exact
        tables.by_blocks[state, action] = pay + gamma * by_blocks
        tables.by_around[around, action] = pay + GAMMA_AROUND * by_around
        exact, by_blocks = float(values.max()), float(tables.by_blocks[state].max())
        by_around = float(tables.by_around[around].max())


class TablePractice:
    """One practice of the tables.

    Args:
        tables: they are begun anew by ``begin``.
        arena, task: what is practised.
        gamma: discounts the values by (x, y, b).
        most_steps: imagined steps after which it ends; at 0 there is none.
        random: the tables' first values come from here.
    """

    def __init__(
        self,
        tables: QTables,
        arena: ImaginedArena,
        task: ImaginedTask,
        gamma: float,
        most_steps: int,
        random: Generator,
    ) -> None:
        self._tables, self._arena, self._task, self._gamma = tables, arena, task, gamma
        self._most_steps, self._random = most_steps, random
        self._progress = TableProgress(np.zeros(1, np.int64), np.zeros(1, np.int64), np.zeros(1), np.zeros(1, np.bool_))
        self._anew_at, self._anew_after = FIRST_STEPS, FIRST_STEPS

    @property
    def steps(self) -> int:
        """Imagined steps so far that were learnt from."""
        return int(self._progress.steps[0])

    @property
    def is_over(self) -> bool:
        """Whether a way that is good enough was found, or the steps are used up."""
        return bool(self._progress.reached[0]) or self.steps >= self._most_steps

    @property
    def aim(self) -> float:
        """What the networks can learn of it: the task's aim, or less if the best way known earns less."""
        return min(self._task.aim, NEARLY_1 * float(self._progress.score[0])) if self._most_steps else self._task.aim

    def begin(self) -> None:
        """Forget what was practised before."""
        if self._most_steps:
            begin_tables(self._tables, self._random)

    def learn(self, uniforms: Float64s) -> None:
        """Use up these numbers in [0, 1) for learning."""
        learn_table(uniforms, self._arena, self._task, self._gamma, self._tables, self._progress)
        if not self.is_over and self.steps >= self._anew_at:
            self._anew_after *= 2
            self._anew_at += self._anew_after
            begin_tables(self._tables, self._random)

    def end(self) -> None:
        """Make the values by (x, y, b) follow the best way known."""
        if self._most_steps:
            prefer_best(self._tables)
