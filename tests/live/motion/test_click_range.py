"""Click range: from which positions a click lands on the floor in front of a cell."""

import pytest

from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.motion.click_range import hits_floor, is_click_right, is_near

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
def test_near_the_edge_towards_which_the_agent_moves_no_early_click_is_right(
    cell: tuple[int, int], towards: tuple[float, float], expected: bool
) -> None:
    end = GroundVector(cell[0] + towards[0], cell[1] + towards[1])
    assert is_click_right(GroundVector(*cell), end, cell, 15) is expected
    assert is_click_right(GroundVector(*cell), end, cell, 20) is (expected or min(cell) > 1)
