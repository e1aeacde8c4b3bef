"""The table that learns in the learnt game: its values by hand, its aim, and the numbers that it uses."""

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arrays import Float64s
from mc_nested.learn.imagination.arena_step import NOWHERE, index_of, step
from mc_nested.learn.imagination.imagined_task import GREEDY_EVERY, ImaginedTask, state_at
from mc_nested.learn.imagination.table_learner import QTable, TableProgress, learn_table, longest_episode
from tests.learn.imagination.made_games import BENT
from tests.learn.imagination.made_practice import arena_of

GAMMA = 0.9
STRIDES = np.array([5 * 4, 4, 1])


class Learning:
    """A table that learns the small design, by the numbers that are given."""

    def __init__(self, blocks: int = BENT.blocks, step_limit: int = BENT.step_limit, first_episode: int = 0) -> None:
        self.arena = arena_of()
        start = index_of(BENT.start, self.arena)
        self.task = ImaginedTask(start, blocks, step_limit, float(blocks), STRIDES, 0)
        values, seen_in = np.zeros((5 * 5 * 4, 8), np.float32), np.full(5 * 5 * 4, -1)
        self.table = QTable(values, seen_in, np.zeros((3, step_limit + 1), np.int64))
        self.progress = TableProgress(np.array([first_episode]), np.zeros(1, np.int64), np.zeros(1, np.bool_))

    def go(self, numbers: Float64s, lowest: float = 0.001) -> None:
        learn_table(numbers, self.arena, self.task, GAMMA, 1.0, lowest, self.table, self.progress)

    def value(self, x: int, y: int, blocks: int, action: Action) -> float:
        return float(self.table.values[np.array([x, y, blocks]) @ STRIDES, action])


def chosen_by_chance(*actions: Action, longest: int) -> Float64s:
    """Numbers for one episode whose every step is by chance, with these actions."""
    numbers = np.full(longest, 0.999)
    numbers[4::2][: len(actions)] = [(action + 0.5) / 8 for action in actions]
    numbers[3::2][: len(actions)] = 0.0
    return numbers


def test_an_episode_is_learnt_from_backwards_and_the_last_outcome_counts_alone() -> None:
    at = Learning(step_limit=3, first_episode=1)
    # From (2, 1): left, right, and forward with a block that lands in (2, 3), which pays.
    at.go(chosen_by_chance(Action.L, Action.R, Action.FD, longest=longest_episode(at.task)))
    assert at.value(2, 1, 3, Action.FD) == 1.0
    assert at.value(1, 1, 3, Action.R) == pytest.approx(GAMMA)
    assert at.value(2, 1, 3, Action.L) == pytest.approx(GAMMA**2)
    assert np.count_nonzero(at.table.values) == 3
    assert (at.progress.episodes[0], at.progress.steps[0]) == (2, 3)
    at.arena.pay[:] = 0.5
    at.progress.episodes[0] = 1
    at.table.seen_in[:] = -1
    at.go(chosen_by_chance(Action.L, Action.R, Action.FD, longest=longest_episode(at.task)))
    assert at.value(2, 1, 3, Action.FD) == 0.5


def test_an_episode_ends_where_a_block_is_wasted_and_nothing_follows_it() -> None:
    at = Learning(first_episode=1)
    at.table.values[:] = 7.0
    at.go(chosen_by_chance(Action.RD, longest=longest_episode(at.task)))
    assert at.value(2, 1, 3, Action.RD) == 0.0
    assert (at.table.values == 7.0).sum() == at.table.values.size - 1
    assert at.progress.steps[0] == 1


def test_the_last_blocks_step_has_no_value_after_it() -> None:
    at = Learning(blocks=1, first_episode=1)
    at.table.values[:] = 7.0
    at.go(chosen_by_chance(Action.FD, longest=longest_episode(at.task)))
    assert at.value(2, 1, 1, Action.FD) == 1.0


def test_numbers_that_do_not_suffice_for_an_episode_are_not_used() -> None:
    at = Learning()
    at.go(np.zeros(longest_episode(at.task) - 1))
    assert (at.progress.episodes[0], at.progress.steps[0]) == (0, 0)


def test_a_greedy_episode_teaches_nothing_and_ends_where_it_would_go_round() -> None:
    at = Learning()
    at.go(np.random.default_rng(0).random(longest_episode(at.task)))
    # The first episode is greedy, the second isn't, and after that there are too few numbers.
    assert at.progress.episodes[0] == 2
    assert 0 < at.progress.steps[0] <= BENT.step_limit


@pytest.mark.parametrize("seed", range(5))
def test_it_learns_to_build_the_design_and_its_greedy_policy_does(seed: int) -> None:
    at = Learning()
    at.go(np.random.default_rng(seed).random(200_000))
    assert at.progress.reached[0]
    assert at.progress.episodes[0] % GREEDY_EVERY == 1, "a greedy episode reached it"
    assert greedy_score(at) == BENT.blocks


def greedy_score(at: Learning) -> float:
    solid, position, blocks, score = at.arena.empty.copy(), at.task.start, BENT.blocks, 0.0
    for _ in range(BENT.step_limit):
        state = state_at(position, blocks, at.arena, at.task)
        position, landed = step(at.arena, position, int(at.table.values[state].argmax()), solid)
        blocks, score = blocks - (landed != NOWHERE), score + at.arena.pay[landed]
        if blocks == 0:
            break
    return score


def test_the_same_numbers_make_the_same_table() -> None:
    tables = []
    for seed in (1, 1, 2):
        at = Learning()
        at.go(np.random.default_rng(seed).random(5_000))
        tables.append(at.table.values)
    np.testing.assert_array_equal(tables[0], tables[1])
    assert (tables[0] != tables[2]).any()
