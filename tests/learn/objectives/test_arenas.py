"""Arenas side by side: planes, steps, and cells that can't be built any more."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import landing, moved
from mc_nested.learn.dqn.states import AGENT, OCCUPIED, WANTED
from mc_nested.learn.objectives.arenas import (
    NOWHERE,
    framed,
    framed_cells,
    out_of_frame,
    outside,
    planes_of,
    side_for,
    step,
    take_out_lost,
)

SIZE = 5
SIDE = side_for(SIZE)


def arena(*stands: Cell) -> "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]":
    return (outside(SIZE, SIDE) | framed_cells(stands, SIDE))[None]


def test_an_arena_of_five_cells_lies_in_a_frame_of_seven_and_all_beside_it_is_occupied() -> None:
    empty = outside(SIZE, SIDE)
    assert empty.shape == (7, 7)
    assert empty.sum() == 7 * 7 - 5 * 5
    assert not empty[1:6, 1:6].any()


def test_an_arena_smaller_than_its_frame_begins_at_the_frames_first_corner() -> None:
    small = outside(5, side_for(8))
    assert not small[1:6, 1:6].any()
    assert small[6:, :].all()
    assert small[:, 6:].all()


def test_a_cell_goes_into_its_frame_and_out_of_it() -> None:
    assert framed((0, 4)) == (1, 5)
    assert out_of_frame(framed((2, 3))) == (2, 3)


def test_planes_show_what_is_wanted_what_stands_and_where_the_agent_is() -> None:
    planes = planes_of(framed_cells({(1, 2)}, SIDE)[None], arena((3, 3)), np.array([[1, 1]]))[0]
    assert np.argwhere(planes[WANTED]).tolist() == [[2, 3]]
    assert planes[OCCUPIED, 4, 4]
    assert planes[OCCUPIED, 0].all()
    assert np.argwhere(planes[AGENT]).tolist() == [[1, 1]]


@given(
    st.sets(st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1)), max_size=12),
    st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1)),
    st.sampled_from(Action),
)
def test_a_step_leads_where_the_rules_say(placed: set[Cell], cell: Cell, action: Action) -> None:
    placed -= {cell}
    occupied, agents, landed = arena(*placed), np.array([framed(cell)]), np.empty((1, 2), np.int64)
    step(occupied, agents, np.array([int(action)]), np.array([0]), landed)
    there = moved(cell, action, placed, SIZE)
    block = landing(there, action, placed, SIZE)
    assert agents.tolist() == [list(framed(there))]
    assert landed.tolist() == [[NOWHERE, NOWHERE] if block is None else list(framed(block))]
    assert np.array_equal(occupied, arena(*placed, *([] if block is None else [block])))


def test_only_the_named_arenas_do_a_step() -> None:
    occupied, agents = np.repeat(arena(), 2, axis=0), np.array([[3, 3], [3, 3]])
    step(occupied, agents, np.array([int(Action.R)]), np.array([1]), np.empty((1, 2), np.int64))
    assert agents.tolist() == [[3, 3], [4, 3]]


@pytest.mark.parametrize(
    ("stands", "agent", "lost"),
    [
        ([], (2, 2), set()),
        ([(0, 3), (1, 4)], (2, 2), {(0, 4)}),  # the cell before it is occupied
        ([(0, 4)], (2, 2), {(0, 4)}),  # something else stands there
        ([(1, 4), (1, 3), (0, 2)], (2, 2), {(0, 4)}),  # the cell before it can't be reached
        ([(0, 1), (1, 0)], (0, 0), {(0, 4), (4, 4)}),  # the agent is walled in
    ],
)
def test_cells_that_cant_be_built_any_more_are_taken_out(stands: list[Cell], agent: Cell, lost: set[Cell]) -> None:
    wanted = {(0, 4), (4, 4)}
    to_build = framed_cells(wanted, SIDE)[None]
    assert take_out_lost(to_build, arena(*stands), np.array([framed(agent)])).tolist() == [len(lost)]
    assert np.array_equal(to_build[0], framed_cells(wanted - lost, SIDE))
