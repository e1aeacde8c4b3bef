"""The rules, worked by hand (docs/explanation/task.md). The Env over them is tested in test_env."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.rules import STEP, cells_of, end_of_episode, front_of, grid_of, is_inside, landing, moved

SIZE = 15

cells = st.tuples(st.integers(0, SIZE - 1), st.integers(0, SIZE - 1))
actions = st.sampled_from(Action)
placed_cells = st.frozensets(cells, max_size=40)


def test_actions_are_in_the_papers_order() -> None:
    assert [action.name for action in Action] == ["F", "B", "L", "R", "FD", "LD", "RD", "BD"]
    assert list(Action) == list(range(8))


@pytest.mark.parametrize(
    ("action", "leads_to"),
    [
        (Action.F, (7, 8)),
        (Action.B, (7, 6)),
        (Action.L, (6, 7)),
        (Action.R, (8, 7)),
        (Action.FD, (7, 8)),
        (Action.LD, (6, 7)),
        (Action.RD, (8, 7)),
        (Action.BD, (7, 6)),
    ],
)
def test_a_move_leads_to_the_neighbour(action: Action, leads_to: Cell) -> None:
    assert moved((7, 7), action, (), SIZE) == leads_to


@pytest.mark.parametrize(
    ("cell", "action"), [((0, 5), Action.L), ((14, 5), Action.RD), ((5, 0), Action.BD), ((5, 14), Action.F)]
)
def test_the_arenas_edge_stops_a_move(cell: Cell, action: Action) -> None:
    assert moved(cell, action, (), SIZE) == cell


def test_a_placed_block_stops_a_move() -> None:
    assert moved((7, 7), Action.L, {(6, 7)}, SIZE) == (7, 7)


def test_a_block_lands_in_front_of_the_cell_reached_by_the_move() -> None:
    assert landing((7, 7), Action.BD, (), SIZE) == (7, 8)


def test_a_move_without_d_places_nothing() -> None:
    assert landing((7, 7), Action.B, (), SIZE) is None


def test_a_block_outside_the_arena_is_void() -> None:
    assert landing((7, 14), Action.LD, (), SIZE) is None


@pytest.mark.parametrize(
    ("blocks_left", "steps", "end"),
    [(1, 9, (False, False)), (1, 10, (False, True)), (0, 9, (True, False)), (0, 10, (True, False))],
)
def test_an_episode_terminates_with_the_last_block_and_is_truncated_at_the_step_limit(
    blocks_left: int, steps: int, end: tuple[bool, bool]
) -> None:
    assert end_of_episode(blocks_left, steps, step_limit=10) == end


def test_a_block_onto_a_block_is_void() -> None:
    assert landing((7, 7), Action.LD, {(7, 8)}, SIZE) is None


@given(cell=cells, action=actions, placed=placed_cells)
def test_nobody_ever_leaves_the_arena_or_enters_a_block(cell: Cell, action: Action, placed: frozenset[Cell]) -> None:
    reached = moved(cell, action, placed - {cell}, SIZE)
    assert is_inside(reached, SIZE)
    assert reached not in placed - {cell}
    assert reached in (cell, (cell[0] + STEP[action][0], cell[1] + STEP[action][1]))


@given(cell=cells, action=actions, placed=placed_cells)
def test_a_block_lands_on_a_free_cell_in_front_or_nowhere(cell: Cell, action: Action, placed: frozenset[Cell]) -> None:
    block = landing(cell, action, placed, SIZE)
    assert block is None or (block == front_of(cell) and is_inside(block, SIZE) and block not in placed)


@pytest.mark.parametrize("size", [5, 14, 15, 16, 32])
def test_the_arenas_edge_follows_its_size(size: int) -> None:
    last = size - 1
    assert [is_inside((x, 2), size) for x in (-1, 0, last, size)] == [False, True, True, False]
    assert [is_inside((2, y), size) for y in (-1, 0, last, size)] == [False, True, True, False]
    assert moved((last - 1, 2), Action.R, (), size) == (last, 2)
    assert moved((last, 2), Action.R, (), size) == (last, 2)
    assert moved((2, last), Action.F, (), size) == (2, last)
    assert landing((2, last - 1), Action.LD, (), size) == (2, last)
    assert landing((2, last), Action.LD, (), size) is None


@given(st.integers(5, 32), st.data())
def test_a_grid_of_any_size_holds_the_placed_cells(size: int, data: st.DataObject) -> None:
    placed = data.draw(st.frozensets(st.tuples(st.integers(0, size - 1), st.integers(0, size - 1))))
    grid = grid_of(placed, size)
    assert grid.shape == (size, size)
    assert cells_of(grid) == placed
