import numpy as np
import pytest

from sim.client.drawing.block_faces import NEAR_FLOOR, brightness, cube_faces, faces_of, floor_faces, inside_rims
from sim.client.drawing.world_shapes import FACES, HOLE, block_colour


def test_a_block_on_the_floor_shows_its_top_and_four_sides() -> None:
    faces = faces_of({(3, 64, -2): "stone"}, floor=64)
    assert [FACES[side] for side in faces.sides].count(((2, 0, 1), 0)) == 0
    assert len(faces.sides) == 5
    assert faces.corners.min((0, 1)).tolist() == [3, 64, -2]
    assert faces.corners.max((0, 1)).tolist() == [4, 65, -1]


def test_two_blocks_side_by_side_hide_the_faces_between_them() -> None:
    faces = faces_of({(0, 64, 0): "stone", (1, 64, 0): "dirt"}, floor=64)
    assert len(faces.sides) == 8
    assert not ((faces.corners[..., 0] == 1).all(1)).any()


def test_a_top_has_the_blocks_colour_and_a_side_less_light() -> None:
    faces = faces_of({(0, 64, 0): "stone"}, floor=64)
    axes = [FACES[side][0][2] for side in faces.sides]
    lit = {(axis, *colour) for axis, colour in zip(axes, faces.colours.tolist(), strict=True)}
    assert lit == {(0, 77.5, 77.5, 77.5), (1, 125, 125, 125), (2, 100, 100, 100)}


def test_a_block_in_the_floor_shows_only_its_top_and_a_hole_is_black() -> None:
    faces = faces_of({(0, 63, 0): "obsidian", (5, 63, 0): "air"}, floor=64)
    assert faces.corners[..., 1].tolist() == [[64] * 4, [64] * 4]
    assert faces.colours.tolist() == [list(block_colour("obsidian")), list(HOLE)]


def test_floor_faces_leaves_out_blocks_with_anything_built_in_or_on_them() -> None:
    side = 2 * NEAR_FLOOR + 1
    faces = floor_faces(
        (10, 64, 20), {(10, 63, 20): "dirt", (11, 64, 21): "stone", (11, 65, 20): "stone"}, 64, "bedrock"
    )
    assert len(faces.sides) == side * side - 2
    assert (faces.corners[..., 1] == 64).all()
    assert faces.blocks.min(0).tolist() == [10 - NEAR_FLOOR, 63, 20 - NEAR_FLOOR]


def test_each_face_goes_counter_clockwise_seen_from_outside() -> None:
    for corners, (axis, side) in zip(
        cube_faces((1, 2, 3)).corners, [(axes[2], side) for axes, side in FACES], strict=True
    ):
        normal = np.cross(corners[1] - corners[0], corners[2] - corners[1])
        assert normal[axis] == (1 if side else -1)


def test_a_rim_is_one_of_sixteen_dots_on_each_side_and_darker() -> None:
    square = np.array([[(0.0, 0.0), (16.0, 0.0), (16.0, 16.0), (0.0, 16.0)]])
    assert inside_rims(square)[0].tolist() == [[1, 1], [15, 1], [15, 15], [1, 15]]
    inside, rim = brightness()
    assert inside == pytest.approx(0.92, abs=0.01)
    assert rim == pytest.approx(0.84 * inside)
