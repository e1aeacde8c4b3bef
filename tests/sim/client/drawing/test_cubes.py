import numpy as np

from sim.client.drawing.block_colours import block_colour
from sim.client.drawing.cubes import FAR, cubes, floor_square, outline, row_of, unit_cube


def test_each_face_of_the_cube_is_two_triangles_seen_from_outside() -> None:
    triangles = unit_cube().reshape(12, 3, 6)
    for corners in triangles:
        one, other, third = corners[:, :3]
        normal = corners[0, 3:]
        assert np.dot(np.cross(other - one, third - one), normal) > 0, "counter-clockwise"
        assert (np.mean(corners[:, :3], axis=0) - 0.5) @ normal > 0, "the normal points outward"
    assert len({tuple(normal) for normal in triangles[:, 0, 3:]}) == 6


def test_the_floor_is_seen_from_above_and_reaches_as_far_as_anything_is_drawn() -> None:
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


def test_what_the_fog_hides_is_left_out() -> None:
    assert len(cubes({(FAR, 0, 0): "stone", (FAR + 1, 0, 0): "stone"}, (0, 0, 0))) == 1
    assert cubes({}, (0, 0, 0)).shape == (0, 6)


def test_a_row_is_a_position_and_a_colour_from_0_to_1() -> None:
    assert np.allclose(row_of((1, 2, 3), (255, 0, 51)), [[1, 2, 3, 1, 0, 0.2]])
