"""Where the next blocks are worth most, by hand on a small arena."""

import numpy as np

from mc_nested.arena.action import Cell
from mc_nested.arrays import Bools
from mc_nested.learn.imagination.beliefs import Belief, Beliefs, believe, candidates, evidence_of
from tests.learn.imagination.test_beliefs import AHEAD, SIZE, of, tries

START = (2, 0)
EVERY_CELL = {(x, y) for x in range(SIZE) for y in range(1, SIZE)}


def buildable(*but: Cell) -> Bools:
    """Return every cell in which a block can land, but for these."""
    cells = np.ones((SIZE, SIZE), dtype=np.bool_)
    cells[:, 0] = False
    for cell in but:
        cells[cell] = False
    return cells


def test_the_first_blocks_try_the_middle_of_what_is_unknown_and_the_nearest_of_several() -> None:
    # 5 x 4 cells are unknown. Twenty are within two cells of (2, 2) and as many of (2, 3); (2, 2) is nearer to (2, 0).
    assert candidates(of(), buildable(), START, 1) == {(2, 2)}
    assert candidates(of(), buildable(), (2, 4), 1) == {(2, 3)}


def test_a_second_block_goes_where_the_first_one_leaves_most_unknown() -> None:
    # Around (2, 2) all count one less once it is chosen: (2, 3), with twenty cells around it, still has the most.
    assert candidates(of(), buildable(), START, 2) == {(2, 2), (2, 3)}


def test_no_more_cells_are_tried_than_blocks_are_left() -> None:
    assert len(candidates(of(), buildable(), START, 7)) == 7
    assert candidates(of(), buildable(), START, 99) == EVERY_CELL


def test_cells_beside_a_paying_one_come_first() -> None:
    beliefs = of(((2, 3), True), ((1, 3), False), blocks=3)
    beside = {(1, 2), (2, 2), (3, 2), (3, 3), (1, 4), (2, 4), (3, 4)}
    assert candidates(beliefs, buildable(), START, 2) == beside
    assert candidates(beliefs, buildable((3, 3)), START, 2) == beside - {(3, 3)}


def test_what_pays_is_not_built_while_cells_are_to_be_found() -> None:
    beliefs = of(((2, 3), True))
    found = candidates(beliefs, buildable(*beside_of((2, 3))), START, 99)
    assert found == EVERY_CELL - beside_of((2, 3)) - {(2, 3)}


def test_a_known_design_is_all_that_is_built() -> None:
    beliefs = of(((2, 3), True), ((0, 1), True), ((4, 4), False), blocks=2)
    assert candidates(beliefs, buildable(), START, 2) == {(2, 3), (0, 1)}
    assert candidates(beliefs, buildable((0, 1)), START, 1) == {(2, 3)}
    assert candidates(beliefs, buildable((0, 1), (2, 3)), START, 1) == frozenset()


def test_where_everything_was_tried_and_too_little_pays_it_is_tried_again() -> None:
    every = [(cell, cell == (2, 3)) for cell in sorted(EVERY_CELL)]
    beliefs = believe(evidence_of(tries(*every), AHEAD, SIZE), AHEAD, 2)
    assert candidates(beliefs, buildable((2, 3)), START, 1) == EVERY_CELL - {(2, 3)}
    assert candidates(beliefs, buildable(), START, 1) == {(2, 3)}


def test_a_row_where_no_block_can_land_does_not_count_as_unknown() -> None:
    # With the row y = 0, which never pays, (2, 2) would have 25 unknown cells around it, and (2, 3) only 20.
    cells = np.full((SIZE, SIZE), Belief.UNKNOWN, np.int8)
    pay = np.zeros((SIZE, SIZE), np.float32)
    pay[:, 1:] = 1.0
    assert candidates(Beliefs(cells, pay, True, 1.0), buildable(), (2, 4), 1) == {(2, 3)}


def beside_of(cell: Cell) -> set[Cell]:
    x, y = cell
    return {(x + across, y + along) for across in (-1, 0, 1) for along in (-1, 0, 1)} - {cell}
