"""Which positions of the mouse are corners of a screen."""

import pytest

from mc_nested.live.input.panic import corners_of


@pytest.mark.parametrize("corner", [(0, 0), (1919, 0), (0, 1079), (1919, 1079)])
def test_the_last_point_of_each_side_is_a_corner(corner: tuple[int, int]) -> None:
    assert corner in corners_of(1920, 1080)


@pytest.mark.parametrize("point", [(1, 0), (1920, 0), (0, 1080), (960, 540), (1918, 1079)])
def test_any_other_point_is_no_corner(point: tuple[int, int]) -> None:
    assert point not in corners_of(1920, 1080)
