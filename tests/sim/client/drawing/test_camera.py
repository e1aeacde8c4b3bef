import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from sim.client.drawing.camera import held_block, projection, view
from sim.client.game.ray import direction

ANGLES = st.tuples(st.floats(-180, 180), st.floats(-89, 89))


def seen(point: tuple[float, float, float], yaw: float, pitch: float) -> NDArray[np.float64]:
    """Where a point is drawn, for an eye at (0.5, 1.62, 0.5) in a window twice as wide as high: -1 to 1."""
    camera = projection(200, 100) @ view((0.5, 1.62, 0.5), yaw, pitch)
    x, y, z, w = camera @ np.array([*point, 1.0])
    assert w > 0, "it lies in front"
    return np.array([x / w, y / w, z / w])


@given(ANGLES, st.floats(0.1, 50.0))
def test_what_is_looked_at_is_in_the_middle(angles: tuple[float, float], away: float) -> None:
    x, y, z = (own + away * part for own, part in zip((0.5, 1.62, 0.5), direction(*angles), strict=True))
    assert seen((x, y, z), *angles)[:2] == pytest.approx((0, 0), abs=1e-3)


def test_facing_south_west_is_to_the_right_and_the_sky_above() -> None:
    assert seen((-0.5, 1.62, 5.5), 0, 0)[0] > 0
    assert seen((1.5, 1.62, 5.5), 0, 0)[0] < 0
    assert seen((0.5, 2.62, 5.5), 0, 0)[1] > 0


def test_seventy_degrees_fit_from_top_to_bottom_and_a_nearer_point_is_in_front() -> None:
    # The tangent of 35 degrees is 0.7002.
    assert seen((0.5, 1.62 + 0.7002 * 4, 4.5), 0, 0)[1] == pytest.approx(1, abs=1e-3)
    assert seen((0.5, 1.62, 2.5), 0, 0)[2] < seen((0.5, 1.62, 4.5), 0, 0)[2] < 1


def test_the_block_in_the_hand_is_in_the_lower_right() -> None:
    x, y, _, w = projection(200, 100) @ held_block() @ np.array([0.5, 0.5, 0.5, 1.0])
    assert 0 < x / w < 1
    assert -1 < y / w < 0
