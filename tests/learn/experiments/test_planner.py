"""The script that explores and builds from a learnt map."""

import numpy as np

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import landing, moved
from mc_nested.learn.experiments.planner import next_test, plan_of_build
from mc_nested.learn.imagination.beliefs import Belief, Beliefs
from tests.learn.made_experiments import BAR

SIZE, BLOCKS, STEPS = 15, 3, 60


def beliefs(pays: set[Cell], pays_not: set[Cell]) -> Beliefs:
    cells = np.full((SIZE, SIZE), Belief.UNKNOWN, dtype=np.int8)
    for cell in pays:
        cells[cell] = Belief.PAYS
    for cell in pays_not:
        cells[cell] = Belief.PAYS_NOT
    return Beliefs(cells, np.zeros((SIZE, SIZE), np.float32), len(pays) < BLOCKS, 0.0)


def landings(start: Cell, placed: set[Cell], actions: list[Action]) -> list[Cell]:
    """Where the blocks of these actions land by the rules."""
    cell = start
    landed: list[Cell] = []
    for action in actions:
        cell = moved(cell, action, placed | set(landed), SIZE)
        block = landing(cell, action, placed | set(landed), SIZE)
        landed += [block] if block else []
    return landed


def test_it_tests_the_cell_beside_a_paying_one_though_others_are_nearer() -> None:
    known = beliefs({(7, 9)}, {(7, 8), (6, 8)})
    plan = next_test((7, 5), set(), STEPS, known, BLOCKS, np.random.default_rng(0))
    assert landings((7, 5), set(), plan) == [(8, 8)]


def test_with_nothing_known_it_tests_a_cell_one_step_away() -> None:
    plan = next_test((7, 7), set(), STEPS, beliefs(set(), set()), BLOCKS, np.random.default_rng(0))
    assert len(plan) == len(landings((7, 7), set(), plan)) == 1


def test_the_cell_in_front_of_it_takes_a_step_away_and_back() -> None:
    others = {(x, y) for x in range(SIZE) for y in range(SIZE)} - {(7, 8)}
    plan = next_test((7, 7), set(), STEPS, beliefs(set(), others), BLOCKS, np.random.default_rng(0))
    assert (len(plan), landings((7, 7), set(), plan)) == (2, [(7, 8)])
    at_the_edge = {(x, y) for x in range(SIZE) for y in range(SIZE)} - {(0, 8)}
    plan = next_test((0, 7), set(), STEPS, beliefs(set(), at_the_edge), BLOCKS, np.random.default_rng(0))
    assert (len(plan), landings((0, 7), set(), plan)) == (1, [(0, 8)])


def test_where_nothing_unknown_can_be_reached_in_time_there_is_nothing_to_do() -> None:
    others = {(x, y) for x in range(SIZE) for y in range(SIZE)} - {(7, 14)}
    random = np.random.default_rng(0)
    assert next_test((7, 7), set(), 5, beliefs(set(), others), BLOCKS, random) == []
    assert landings((7, 7), set(), next_test((7, 7), set(), 6, beliefs(set(), others), BLOCKS, random)) == [(7, 14)]
    assert next_test((7, 7), {(7, 14)}, STEPS, beliefs(set(), others), BLOCKS, random) == []


def test_it_builds_the_cells_that_are_known_to_pay_and_no_others() -> None:
    known = {(3, 3), (4, 4)}
    assert set(landings(BAR.start, set(), plan_of_build(BAR, beliefs(known, set())))) == known
