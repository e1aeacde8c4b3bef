"""Arenas side by side: planes, steps, and cells that can't be built any more."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import is_inside, landing, moved
from mc_nested.learn.dqn.states import AGENT, LOSES, OCCUPIED, ORDER_PLANES, REACH_PLANES, WANTED
from mc_nested.learn.objectives.arenas import (
    NOWHERE,
    framed,
    framed_cells,
    in_circles,
    look_ahead,
    order_planes,
    outside,
    reach_planes,
    side_for,
    step,
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


def test_a_cell_lies_one_further_in_its_frame() -> None:
    assert framed((0, 4)) == (1, 5)


def test_planes_show_what_is_wanted_what_stands_and_where_the_agent_is() -> None:
    planes = reach_planes(framed_cells({(1, 2)}, SIDE)[None], arena((3, 3)), np.array([[1, 1]]))[0]
    assert len(planes) == REACH_PLANES
    assert np.argwhere(planes[WANTED]).tolist() == [[2, 3]]
    assert planes[OCCUPIED, 4, 4]
    assert planes[OCCUPIED, 0].all()
    assert np.argwhere(planes[AGENT]).tolist() == [[1, 1]]


def test_an_agent_that_is_shown_the_objective_alone_sees_nothing_of_what_stands_but_the_frames_edge() -> None:
    occupied = outside(3, SIDE)[None] | framed_cells({(0, 2)}, SIDE)
    planes = reach_planes(framed_cells({(1, 2)}, SIDE)[None], occupied, np.array([[1, 1]]), "objective")[0]
    assert np.array_equal(planes[OCCUPIED], outside(SIZE, SIDE))
    assert np.argwhere(planes[WANTED]).tolist() == [[2, 3]]
    assert occupied[0, 1, 3], "what stands there still does"


def test_an_agent_that_is_shown_the_surroundings_alone_sees_no_cell_that_differs_as_the_objective() -> None:
    wanted = framed_cells({(1, 2)}, SIDE)[None]
    planes = reach_planes(wanted, arena((3, 3)), np.array([[1, 1]]), "surroundings")[0]
    assert planes[WANTED].all()
    assert np.array_equal(planes[OCCUPIED], arena((3, 3))[0])
    assert wanted.sum() == 1, "it is the objective still"


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
    assert look_ahead(to_build, arena(*stands), np.array([framed(agent)]))[1].tolist() == [len(lost)]
    assert np.array_equal(to_build[0], framed_cells(wanted - lost, SIDE))


@pytest.mark.parametrize(
    ("stands", "agent", "wanted", "cuts_off"),
    [
        ([], (2, 2), {(0, 4), (4, 4)}, set()),
        # The only way to (0, 3), before (0, 4), is through (0, 2).
        ([(1, 3), (1, 4)], (2, 1), {(0, 4), (0, 2)}, {(0, 2)}),
        # (0, 4) can't be built any more: so (0, 2) cuts off nothing.
        ([(1, 3), (1, 4), (0, 3)], (2, 1), {(0, 4), (0, 2)}, set()),
        # A block on (1, 1) leaves the agent in the corner below, and all else is beyond.
        ([(0, 1)], (1, 2), {(1, 1), (4, 4)}, set()),
        ([(0, 1), (2, 0)], (1, 2), {(1, 1), (4, 4)}, {(1, 1)}),
    ],
)
def test_the_main_agent_sees_which_cells_would_cut_off_another(
    stands: list[Cell], agent: Cell, wanted: set[Cell], cuts_off: set[Cell]
) -> None:
    to_build, agents = framed_cells(wanted, SIDE)[None], np.array([framed(agent)])
    (planes,), _ = order_planes(to_build, arena(*stands), agents)
    assert len(planes) == ORDER_PLANES
    assert np.array_equal(planes[LOSES], framed_cells(cuts_off, SIDE))
    assert np.array_equal(to_build[0], framed_cells(wanted, SIDE))


def test_of_two_cells_that_cut_off_one_another_one_is_lost() -> None:
    # Each lies above a cell of its own that is open at its top alone: whoever builds one is walled in.
    stands = [(0, 0), (1, 1), (2, 1), (3, 1), (4, 0)]
    wanted = {(0, 2), (4, 2)}
    to_build = framed_cells(wanted, SIDE)[None]
    _, lost = look_ahead(to_build, arena(*stands), np.array([framed((2, 3))]))
    assert lost.tolist() == [1]
    assert to_build.sum() == 1


def lost_after(wanted: set[Cell], stands: set[Cell], agent: Cell) -> bool:
    """Return whether a cell is lost: none but a cell that cuts off another is left to be the next one."""

    def reached(stands: set[Cell], cell: Cell) -> set[Cell]:
        found = {cell}
        while new := {
            there
            for x, y in found
            for there in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1))
            if is_inside(there, SIZE) and there not in stands and there not in found
        }:
            found |= new
        return found

    def cut_off(cell: Cell) -> set[Cell]:
        after = reached(stands | {cell}, (cell[0], cell[1] - 1))
        return {(x, y) for x, y in wanted if (x, y - 1) not in after} - {cell}

    now, left = reached(stands, agent), set(wanted)
    if any((x, y - 1) not in now for x, y in wanted):
        return True
    cuts = {cell: cut_off(cell) for cell in wanted}
    while turn := {cell for cell in left if not cuts[cell] & left}:
        left -= turn
    return bool(left)


@settings(deadline=None, max_examples=60)
@given(st.integers(0, 10_000))
def test_what_a_block_would_lose_is_what_is_lost_once_it_stands(seed: int) -> None:
    random = np.random.default_rng(seed)
    cells = [(x, y) for x in range(SIZE) for y in range(SIZE)]
    order = [cells[place] for place in random.permutation(len(cells))]
    stands, agent = set(order[:7]), order[7]
    wanted = {cell for cell in order[8:16] if cell[1]}
    planes, lost = order_planes(framed_cells(wanted, SIDE)[None], arena(*stands), np.array([framed(agent)]))
    assert (lost[0] > 0) == lost_after(wanted, stands, agent)
    left = {(int(x) - 1, int(y) - 1) for x, y in np.argwhere(planes[0, WANTED])}
    assert len(left) == len(wanted) - lost[0]
    losing = {(x, y) for x, y in left if lost_after(left - {(x, y)}, stands | {(x, y)}, (x, y - 1))}
    assert np.array_equal(planes[0, LOSES], framed_cells(losing, SIDE))


def test_cells_are_left_out_until_none_cuts_off_a_later_one() -> None:
    def cuts(*pairs: tuple[int, int]) -> "np.ndarray[tuple[int, ...], np.dtype[np.bool_]]":
        found = np.zeros((4, 4), np.bool_)
        for own, other in pairs:
            found[own, other] = True
        return found

    assert in_circles(cuts()).tolist() == []
    assert in_circles(cuts((0, 1), (1, 2), (2, 3))).tolist() == []  # 3, 2, 1, 0
    assert in_circles(cuts((0, 1), (1, 0), (0, 2))).tolist() == [0]
    assert in_circles(cuts((0, 1), (1, 2), (2, 0))).tolist() == [0]
    assert in_circles(cuts((0, 1), (1, 0), (2, 3), (3, 2))).tolist() == [0, 2]
