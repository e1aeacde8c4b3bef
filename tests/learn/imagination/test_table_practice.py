"""A practice of the tables ends at its aim or budget, begins anew, and says what the networks can learn of it."""

import numpy as np
import pytest

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.imagination import table_learner
from mc_nested.learn.imagination.arena_step import ImaginedTask, index_of
from mc_nested.learn.imagination.table_learner import NEARLY_1, TablePractice, empty_tables
from tests.learn.imagination.made_games import BENT
from tests.learn.imagination.made_practice import arena_of

ALL = float(BENT.blocks)


def practice(aim: float = ALL, most_steps: int = 10_000) -> TablePractice:
    arena = arena_of()
    start = index_of(BENT.start, arena)
    task = ImaginedTask(start, BENT.blocks, BENT.step_limit, aim, np.array([5 * 4, 4, 1]), 0)
    tables = empty_tables(5 * 5 * 4, 8, len(arena.empty), BENT.step_limit, 1 << 12)
    made = TablePractice(tables, arena, task, 0.9, most_steps, np.random.default_rng(2))
    made.begin()
    return made


def run(table: TablePractice) -> None:
    numbers = np.random.default_rng(4)
    while not table.is_over:
        table.learn(numbers.random(2_000))


def test_a_table_practice_ends_at_its_aim_and_gives_the_networks_the_same_aim() -> None:
    table = practice()
    run(table)
    assert 0 < table.steps < 10_000
    assert table.aim == pytest.approx(ALL)


def test_a_table_practice_out_of_steps_gives_the_networks_the_score_found_as_aim() -> None:
    table = practice(aim=ALL + 2)
    run(table)
    assert 10_000 <= table.steps < 12_000
    assert table.aim == pytest.approx(NEARLY_1 * ALL)
    assert table.aim < ALL, "the same blocks in another order reach it, too"


def test_a_table_practice_without_steps_is_over_at_once_and_keeps_the_aim() -> None:
    table = practice(aim=ALL + 2, most_steps=0)
    assert table.is_over
    assert table.aim == ALL + 2


def test_a_table_practice_begins_anew_after_twice_as_many_steps_each_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(table_learner, "FIRST_STEPS", 2_000)
    anew: list[int] = []
    table = practice(aim=ALL + 2, most_steps=30_000)
    monkeypatch.setattr(table_learner, "begin_tables", lambda *_: anew.append(table.steps))
    run(table)
    assert [round(at / 2_000) for at in anew] == [1, 3, 7], "after 2,000 steps, 4,000 more, and 8,000 more"


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_a_table_practice_finds_how_to_build_a_house_of_forty_blocks(seed: int) -> None:
    house = load_scenario("house")
    arena = arena_of(house)
    strides = np.array([house.size * (house.blocks + 1), house.blocks + 1, 1])
    start = index_of(house.start, arena)
    task = ImaginedTask(start, house.blocks, house.step_limit, float(house.blocks), strides, 0)
    tables = empty_tables(house.size**2 * (house.blocks + 1), 8, len(arena.empty), house.step_limit)
    table = TablePractice(tables, arena, task, 0.93, 60_000_000, np.random.default_rng(seed))
    table.begin()
    numbers = np.random.default_rng(seed + 100)
    while not table.is_over:
        table.learn(numbers.random(65_536))
    assert table.aim == pytest.approx(house.blocks)


def test_learning_without_random_numbers_takes_no_steps() -> None:
    table = practice()
    table.learn(np.empty(0))
    assert (table.steps, table.is_over) == (0, False)
