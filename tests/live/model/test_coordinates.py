"""The arena's cells laid into the world, the four ways it can face.

Click range: from which positions a click lands on the floor in front of a cell.
"""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.model.coordinates import (
    Facing,
    GroundVector,
    block_of,
    cell_at,
    centre_of,
    facing_of,
    hits_floor,
    is_click_right,
    is_near,
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
def test_a_cell_two_right_and_three_forward_is_the_expected_block_for_each_facing(
    facing: Facing, block: tuple[int, int, int]
) -> None:
    assert block_of((10, 64, -2), facing, (2, 3)) == block


@given(facings)
def test_forward_points_along_the_yaw_and_right_a_quarter_turn_further(facing: Facing) -> None:
    for cell, turn in (((0, 1), 0.0), ((1, 0), 90.0)):
        x, _, z = block_of((0, 0, 0), facing, cell)
        yaw = math.radians(yaw_of(facing) + turn)
        assert (x, z) == (round(-math.sin(yaw)), round(math.cos(yaw)))


@given(blocks, facings, cells)
def test_the_middle_of_a_cell_has_the_cells_own_coordinates(
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


def test_the_turn_between_two_yaws_crosses_180_degrees() -> None:
    assert turn_between(180.0, -179.8) == pytest.approx(0.2)
    assert turn_between(-90.0, 90.0) == 180.0


CELL = (7, 7)


@pytest.mark.parametrize(
    ("right", "forward", "expected"),
    [(7.0, 7.0, True), (7.125, 6.875, True), (6.875, 7.125, True), (7.25, 7.0, False), (7.0, 6.75, False)],
)
def test_a_position_is_near_a_cell_within_the_tolerance_on_both_axes(
    right: float, forward: float, expected: bool
) -> None:
    assert is_near(GroundVector(right, forward), CELL, 0.125) is expected


@pytest.mark.parametrize(
    ("right", "forward", "expected"),
    [
        (0.0, 0.0, True),
        (0.39, 0.0, True),
        (-0.39, 0.0, True),
        (0.41, 0.0, False),
        (-0.41, 0.0, False),
        (0.0, 0.18, True),
        (0.0, 0.2, False),
        (0.0, -0.19, True),
        (0.0, -0.21, False),
    ],
)
def test_the_floor_ahead_is_hit_from_a_little_beside_behind_and_before_the_middle(
    right: float, forward: float, expected: bool
) -> None:
    assert hits_floor(GroundVector(CELL[0] + right, CELL[1] + forward), CELL) is expected


def test_a_click_is_right_only_if_the_floor_is_hit_from_now_until_the_latest_end() -> None:
    near, far = GroundVector(6.7, 7.0), GroundVector(6.5, 7.0)
    assert is_click_right(near, GroundVector(7.2, 7.0), CELL, 15)
    assert not is_click_right(far, GroundVector(7.2, 7.0), CELL, 15)
    assert not is_click_right(near, GroundVector(7.5, 7.0), CELL, 15)


@pytest.mark.parametrize(
    ("cell", "towards", "expected"),
    [
        ((12, 7), (0.1, 0.0), True),
        ((13, 7), (0.1, 0.0), False),
        ((13, 7), (-0.1, 0.0), True),
        ((2, 7), (-0.1, 0.0), True),
        ((1, 7), (-0.1, 0.0), False),
        ((1, 7), (0.1, 0.0), True),
        ((7, 12), (0.05, 0.1), True),
        ((7, 13), (0.05, 0.1), False),
        ((7, 13), (0.1, 0.05), True),
        ((7, 1), (0.0, -0.1), False),
        ((13, 7), (0.1, 0.1), True),
    ],
)
def test_no_early_click_is_right_one_cell_before_the_edge_that_the_agent_moves_towards(
    cell: tuple[int, int], towards: tuple[float, float], expected: bool
) -> None:
    end = GroundVector(cell[0] + towards[0], cell[1] + towards[1])
    assert is_click_right(GroundVector(*cell), end, cell, 15) is expected
    assert is_click_right(GroundVector(*cell), end, cell, 20) is (expected or min(cell) > 1)
