"""The tables that learn in the learnt game: their values by hand, their aim, and the numbers that they use."""

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arrays import Float64s
from mc_nested.learn.imagination import table_learner
from mc_nested.learn.imagination.arena_step import GREEDY_EVERY, NOWHERE, ImaginedTask, index_of, state_at, step
from mc_nested.learn.imagination.built_values import row_of
from mc_nested.learn.imagination.table_learner import (
    AROUND,
    GAMMA_AROUND,
    GAMMA_BUILT,
    TableProgress,
    begin_tables,
    empty_tables,
    learn_table,
    longest_episode,
    prefer_best,
)
from tests.learn.imagination.made_games import BENT
from tests.learn.imagination.made_practice import arena_of

GAMMA = 0.9
STRIDES = np.array([5 * 4, 4, 1])
STATES = 5 * 5 * 4
ALL_BY_CHANCE = 0.999_999
"""As an episode's second number: so many actions by chance follow that they outlast it."""


class Learning:
    """Tables that learn the small design, with given random numbers."""

    def __init__(
        self,
        blocks: int = BENT.blocks,
        step_limit: int = BENT.step_limit,
        first_episode: int = 0,
        room: int = 1 << 12,
        aim: float | None = None,
    ) -> None:
        self.arena = arena_of()
        start = index_of(BENT.start, self.arena)
        self.task = ImaginedTask(start, blocks, step_limit, float(blocks) if aim is None else aim, STRIDES, 0)
        self.tables = empty_tables(STATES, 8, len(self.arena.empty), step_limit, room)
        begin_tables(self.tables, np.random.default_rng(9))
        self.progress = TableProgress(
            np.array([first_episode]), np.zeros(1, np.int64), np.zeros(1), np.zeros(1, np.bool_)
        )

    def go(self, numbers: Float64s) -> None:
        learn_table(numbers, self.arena, self.task, GAMMA, self.tables, self.progress)

    def by_blocks(self, x: int, y: int, blocks: int, action: Action) -> float:
        return float(self.tables.by_blocks[np.array([x, y, blocks]) @ STRIDES, action])

    def by_around(self, x: int, y: int, action: Action) -> float:
        """Return the value in the middle of free cells."""
        return float(self.tables.by_around[index_of((x, y), self.arena) << AROUND, action])

    def exact(self, x: int, y: int, action: Action) -> float:
        """Return the value in that cell before anything is built."""
        name = int(self.tables.built.here[index_of((x, y), self.arena)])
        return float(self.tables.built.values[row_of(self.tables.built, name), action])


def chosen_by_chance(*actions: Action, longest: int) -> Float64s:
    """Return numbers for one episode whose every step is by chance, with these actions."""
    numbers = np.full(longest, 0.999)
    numbers[:3] = 0.0, ALL_BY_CHANCE, 0.0
    numbers[4::2][: len(actions)] = [(action + 0.5) / 8 for action in actions]
    return numbers


def test_every_table_learns_an_episode_backwards_and_the_latest_outcome_counts_alone() -> None:
    at = Learning(step_limit=3, first_episode=1)
    # From (2, 1): left, right, and forward with a block that lands in (2, 3), which pays.
    at.go(chosen_by_chance(Action.L, Action.R, Action.FD, longest=longest_episode(at.task)))
    assert at.by_blocks(2, 1, 3, Action.FD) == pytest.approx(1.0, abs=1e-5)
    assert at.by_blocks(1, 1, 3, Action.R) == pytest.approx(GAMMA, abs=1e-5)
    assert at.by_blocks(2, 1, 3, Action.L) == pytest.approx(GAMMA**2, abs=1e-5)
    assert at.by_around(2, 1, Action.L) == pytest.approx(GAMMA_AROUND**2, abs=1e-5)
    assert at.exact(2, 1, Action.FD) == 1.0
    assert at.exact(1, 1, Action.R) == pytest.approx(GAMMA_BUILT)
    assert at.exact(2, 1, Action.L) == pytest.approx(GAMMA_BUILT**2)
    assert (at.progress.episodes[0], at.progress.steps[0]) == (2, 3)
    at.arena.pay[:] = 0.5
    at.progress.episodes[0] = 1
    at.tables.seen_in[:] = -1
    at.go(chosen_by_chance(Action.L, Action.R, Action.FD, longest=longest_episode(at.task)))
    assert at.exact(2, 1, Action.FD) == 0.5
    assert at.by_blocks(2, 1, 3, Action.FD) == pytest.approx(0.5, abs=1e-5)


def test_values_after_a_paid_step_are_not_discounted() -> None:
    at = Learning(first_episode=1, step_limit=4)
    at.arena.pay[1:] = 1.0
    # Left; forward with a block; back without; and a block in the way that it has come from.
    at.go(chosen_by_chance(Action.L, Action.FD, Action.B, Action.RD, longest=longest_episode(at.task)))
    assert at.exact(1, 1, Action.FD) == pytest.approx(1.0 + GAMMA_BUILT)
    assert at.exact(2, 1, Action.L) == pytest.approx(GAMMA_BUILT * (1.0 + GAMMA_BUILT))


def test_an_episode_ends_at_a_wasted_block_whose_value_is_0() -> None:
    at = Learning(first_episode=1)
    at.tables.by_blocks[:] = 7.0
    at.go(chosen_by_chance(Action.RD, longest=longest_episode(at.task)))
    assert at.by_blocks(2, 1, 3, Action.RD) == 0.0
    assert (at.tables.by_blocks == 7.0).sum() == at.tables.by_blocks.size - 1
    assert at.progress.steps[0] == 1


def test_the_step_that_places_the_last_block_is_worth_its_reward_alone() -> None:
    at = Learning(blocks=1, first_episode=1)
    at.tables.by_blocks[:] = 7.0
    at.go(chosen_by_chance(Action.FD, longest=longest_episode(at.task)))
    assert at.by_blocks(2, 1, 1, Action.FD) == 1.0


def test_random_numbers_too_few_for_an_episode_are_not_used() -> None:
    at = Learning()
    at.go(np.zeros(longest_episode(at.task) - 1))
    assert (at.progress.episodes[0], at.progress.steps[0]) == (0, 0)


def test_a_greedy_episode_leaves_random_numbers_for_one_more_episode() -> None:
    at = Learning()
    at.go(np.random.default_rng(0).random(3 + longest_episode(at.task)))
    # The first episode is greedy, the second isn't, and after that there are too few numbers.
    assert at.progress.episodes[0] == 2
    assert 0 < at.progress.steps[0] <= BENT.step_limit


@pytest.mark.parametrize("seed", range(5))
def test_tables_learn_to_build_the_design_and_prefer_best_makes_values_by_x_y_b_follow(seed: int) -> None:
    at = Learning()
    at.go(np.random.default_rng(seed).random(200_000))
    assert at.progress.reached[0]
    assert at.progress.score[0] == BENT.blocks
    assert at.progress.episodes[0] % GREEDY_EVERY == 1, "a greedy episode reached it"
    prefer_best(at.tables)
    once = at.tables.by_blocks.copy()
    assert greedy_score(at) == BENT.blocks
    prefer_best(at.tables)
    np.testing.assert_array_equal(at.tables.by_blocks, once)


def greedy_score(at: Learning) -> float:
    solid, position, blocks, score = at.arena.empty.copy(), at.task.start, at.task.blocks, 0.0
    for _ in range(at.task.step_limit):
        state = state_at(position, blocks, at.arena, at.task)
        position, landed = step(at.arena, position, int(at.tables.by_blocks[state].argmax()), solid)
        blocks, score = blocks - (landed != NOWHERE), score + at.arena.pay[landed]
        if blocks == 0:
            break
    return score


def test_full_exact_values_are_forgotten_but_the_best_way_is_kept() -> None:
    at = Learning(room=64, aim=BENT.blocks + 1.0)
    at.go(np.random.default_rng(3).random(60_000))
    assert at.progress.score[0] == BENT.blocks, "an aim out of reach: it goes on for ever"
    assert at.tables.built.held[0] <= 64
    ways = {tuple(at.tables.best[0, : at.tables.best_steps[0]])}
    for seed in range(5):
        at.go(np.random.default_rng(seed).random(20_000))
        assert at.progress.score[0] == BENT.blocks
        ways.add(tuple(at.tables.best[0, : at.tables.best_steps[0]]))
    assert min(len(way) for way in ways) == at.tables.best_steps[0], "no way that takes longer is taken for better"


def test_habits_come_from_the_best_way_alone() -> None:
    at = Learning()
    at.go(np.random.default_rng(1).random(5_000))
    steps = at.tables.best_steps[0]
    expected = dict(zip(at.tables.best[2, :steps].tolist(), at.tables.best[3, :steps].tolist(), strict=True))
    found = {int(around): int(at.tables.habits[around]) for around in np.flatnonzero(at.tables.habits >= 0)}
    assert found == expected
    assert found


def test_surroundings_depend_on_the_eight_cells_around_a_cell_alone() -> None:
    at = Learning()
    here = index_of((2, 2), at.arena)
    around = {table_learner._around(here, at.arena.empty, at.arena)}
    for neighbour in range(here - at.arena.side - 1, here + at.arena.side + 2):
        solid = at.arena.empty.copy()
        solid[neighbour] = True
        around.add(table_learner._around(here, solid, at.arena))
    # Each of the eight cells around makes its own; its own cell, and cells further away, make none.
    assert len(around) == 1 + AROUND
    assert {value >> AROUND for value in around} == {here}


def test_the_same_random_numbers_make_the_same_tables() -> None:
    tables = []
    for seed in (1, 1, 2):
        at = Learning()
        at.go(np.random.default_rng(seed).random(5_000))
        tables.append(at.tables.by_blocks)
    np.testing.assert_array_equal(tables[0], tables[1])
    assert (tables[0] != tables[2]).any()
