import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from sim.client.drawing.world_shapes import (
    FAR,
    GRAIN_BLOCKS,
    block_colour,
    cubes,
    floor_square,
    grain,
    held_block,
    outline,
    projection,
    row_of,
    unit_cube,
    view,
)
from sim.client.game.world import direction


def test_each_face_of_the_cube_is_two_triangles_seen_from_outside() -> None:
    triangles = unit_cube().reshape(12, 3, 6)
    for corners in triangles:
        one, other, third = corners[:, :3]
        normal = corners[0, 3:]
        assert np.dot(np.cross(other - one, third - one), normal) > 0, "counter-clockwise"
        assert (np.mean(corners[:, :3], axis=0) - 0.5) @ normal > 0, "the normal points outward"
    assert len({tuple(normal) for normal in triangles[:, 0, 3:]}) == 6


def test_the_floor_is_level_and_reaches_as_far_as_blocks_are_drawn() -> None:
    corners = floor_square()[:, :3]
    assert corners.min() == -FAR
    assert corners.max() == FAR
    assert set(corners[:, 1]) == {0.0}


def test_the_outline_has_the_twelve_edges_of_a_block() -> None:
    edges = outline()[:, :3].reshape(12, 2, 3)
    lengths = np.abs(edges[:, 1] - edges[:, 0])
    assert len({tuple(np.round(edge.ravel(), 4)) for edge in edges}) == 12
    assert all(sorted(np.round(length, 2)) == [0, 0, 1] for length in lengths)


def test_blocks_are_placed_from_the_origin_in_their_colour_and_holes_are_dark() -> None:
    rows = cubes({(3, 64, -2): "stone", (4, 63, -2): "air"}, (1, 64, 0))
    stone, hole = rows
    assert tuple(stone[:3]) == (2, 0, -2)
    assert np.allclose(stone[3:] * 255, block_colour("stone"))
    assert tuple(hole[:3]) == (3, -1, -2)
    assert max(hole[3:]) < 0.05


def test_blocks_hidden_by_the_fog_are_left_out() -> None:
    assert len(cubes({(FAR, 0, 0): "stone", (FAR + 1, 0, 0): "stone"}, (0, 0, 0))) == 1
    assert cubes({}, (0, 0, 0)).shape == (0, 6)


def test_row_of_gives_a_position_and_a_colour_from_0_to_1() -> None:
    assert np.allclose(row_of((1, 2, 3), (255, 0, 51)), [[1, 2, 3, 1, 0, 0.2]])


def test_a_known_block_has_its_own_colour_and_an_unknown_one_always_the_same() -> None:
    assert block_colour("grass_block")[1] > block_colour("grass_block")[0]
    assert block_colour("copper_bulb") == block_colour("copper_bulb") != block_colour("tuff")
    assert all(60 <= part < 180 for part in block_colour("copper_bulb"))


def test_each_face_has_sixteen_dots_a_side_and_a_darker_rim() -> None:
    dots = grain()
    assert dots.shape == (16 * GRAIN_BLOCKS, 16 * GRAIN_BLOCKS)
    assert dots.max() <= 1.0
    inside, rim = dots[1:15, 1:15], dots[0, :16]
    assert inside.mean() - rim.mean() > 0.1
    assert np.array_equal(dots, grain()), "it is always the same"


ANGLES = st.tuples(st.floats(-180, 180), st.floats(-89, 89))


def seen(point: tuple[float, float, float], yaw: float, pitch: float) -> NDArray[np.float64]:
    """Return where a point is drawn, for an eye at (0.5, 1.62, 0.5) in a window twice as wide as high: -1 to 1."""
    camera = projection(200, 100) @ view((0.5, 1.62, 0.5), yaw, pitch)
    x, y, z, w = camera @ np.array([*point, 1.0])
    assert w > 0, "it lies in front"
    return np.array([x / w, y / w, z / w])


@given(ANGLES, st.floats(0.1, 50.0))
def test_the_point_looked_at_is_in_the_middle_of_the_window(angles: tuple[float, float], away: float) -> None:
    x, y, z = (own + away * part for own, part in zip((0.5, 1.62, 0.5), direction(*angles), strict=True))
    assert seen((x, y, z), *angles)[:2] == pytest.approx((0, 0), abs=1e-3)


def test_facing_south_west_is_to_the_right_and_the_sky_above() -> None:
    assert seen((-0.5, 1.62, 5.5), 0, 0)[0] > 0
    assert seen((1.5, 1.62, 5.5), 0, 0)[0] < 0
    assert seen((0.5, 2.62, 5.5), 0, 0)[1] > 0


def test_the_field_of_view_is_seventy_degrees_high_and_nearer_points_have_less_depth() -> None:
    # The tangent of 35 degrees is 0.7002.
    assert seen((0.5, 1.62 + 0.7002 * 4, 4.5), 0, 0)[1] == pytest.approx(1, abs=1e-3)
    assert seen((0.5, 1.62, 2.5), 0, 0)[2] < seen((0.5, 1.62, 4.5), 0, 0)[2] < 1


def test_the_block_in_the_hand_is_in_the_lower_right() -> None:
    x, y, _, w = projection(200, 100) @ held_block() @ np.array([0.5, 0.5, 0.5, 1.0])
    assert 0 < x / w < 1
    assert -1 < y / w < 0
