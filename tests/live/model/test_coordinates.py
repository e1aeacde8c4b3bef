"""The arena's cells laid into the world, the four ways it can face."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.model.coordinates import (
    Facing,
    block_of,
    cell_at,
    centre_of,
    facing_of,
    position_of,
    turn_between,
    yaw_of,
)

FACINGS: list[Facing] = ["north", "south", "west", "east"]
facings = st.sampled_from(FACINGS)
cells = st.tuples(st.integers(-20, 20), st.integers(-20, 20))
blocks = st.tuples(st.integers(-1000, 1000), st.integers(-60, 300), st.integers(-1000, 1000))


@pytest.mark.parametrize(
    ("facing", "block"),
    [("north", (12, 64, -5)), ("south", (8, 64, 1)), ("west", (7, 64, -4)), ("east", (13, 64, 0))],
)
def test_two_right_and_three_forward_lands_where_the_game_says(facing: Facing, block: tuple[int, int, int]) -> None:
    assert block_of((10, 64, -2), facing, (2, 3)) == block


@given(facings)
def test_forward_is_where_the_yaw_looks_and_right_a_quarter_turn_on(facing: Facing) -> None:
    for cell, turn in (((0, 1), 0.0), ((1, 0), 90.0)):
        x, _, z = block_of((0, 0, 0), facing, cell)
        yaw = math.radians(yaw_of(facing) + turn)
        assert (x, z) == (round(-math.sin(yaw)), round(math.cos(yaw)))


@given(blocks, facings, cells)
def test_the_position_of_a_cells_middle_is_the_cell(
    origin: tuple[int, int, int], facing: Facing, cell: tuple[int, int]
) -> None:
    assert position_of(origin, facing, centre_of(origin, facing, cell)) == cell


@given(blocks, facings, cells, st.floats(-0.49, 0.49), st.floats(-0.49, 0.49))
def test_any_point_over_a_cells_block_is_in_that_cell(
    origin: tuple[int, int, int], facing: Facing, cell: tuple[int, int], east: float, south: float
) -> None:
    x, y, z = centre_of(origin, facing, cell)
    assert cell_at(position_of(origin, facing, (x + east, y, z + south))) == cell


@given(facings, st.floats(-44, 44), st.integers(-2, 2))
def test_a_player_who_looks_roughly_along_an_axis_faces_it(facing: Facing, off: float, turns: int) -> None:
    assert facing_of(yaw_of(facing) + off + 360 * turns) == facing


def test_north_is_the_same_from_both_sides() -> None:
    assert turn_between(180.0, -179.8) == pytest.approx(0.2)
    assert turn_between(-90.0, 90.0) == 180.0
