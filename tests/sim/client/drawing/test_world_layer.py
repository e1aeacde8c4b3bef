"""The eye is at height 1.62 over the floor and looks south (yaw 0) unless a test says otherwise."""

from collections.abc import Mapping

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Block
from sim.client.drawing.block_faces import brightness
from sim.client.drawing.world_layer import WorldLayers
from sim.client.drawing.world_shapes import block_colour
from sim.client.game.view import Eye, Sight

SIZE = (200, 100)
SKY_BGR = (255, 166, 120)
"""0.47, 0.65 and 1 of 255."""


def sight(
    built: Mapping[Block, str] | None = None,
    *,
    at: tuple[float, float, float] = (0.5, 65.62, 0.5),
    yaw: float = 0.0,
    pitch: float = 0.0,
    target: Block | None = None,
    held: str | None = None,
) -> Sight:
    return Sight(Eye(at, yaw, pitch), built or {}, 64, "bedrock", target, held)


def drawn(seen: Sight) -> Frame:
    layer = WorldLayers(SIZE).of(seen)
    frame = np.zeros((SIZE[1], SIZE[0], 3), np.uint8)
    layer.draw(frame, layer.rect)
    return frame


def shade(block: str, light: float) -> list[int]:
    inside, _ = brightness()
    return [round(part * light * inside) for part in reversed(block_colour(block))]


def test_the_sky_is_above_the_horizon_and_the_floor_below_it() -> None:
    picture = drawn(sight())
    assert tuple(picture[0, 0]) == SKY_BGR
    assert tuple(picture[49, 100]) == SKY_BGR
    # Straight ahead at the lower edge the floor is 1.62 / tan 35 degrees = 2.31 blocks away: inside the third block.
    assert picture[99, 100].tolist() == shade("bedrock", 1.0)


def test_a_block_is_drawn_at_its_place_in_its_colour_and_its_sides_light() -> None:
    # Its face is 2.5 blocks ahead, its middle 1.12 lower than the eye: 50 + 50 * 1.12 / 2.5 / 0.7002 = 82.
    picture = drawn(sight({(0, 64, 3): "stone"}))
    assert picture[82, 100].tolist() == shade("stone", 0.8)
    # Half a block to each side: 50 * 0.5 / 2.5 / 0.7002 = 14.3 pixels.
    assert picture[82, 112].tolist() == shade("stone", 0.8)
    assert picture[82, 117].tolist() != shade("stone", 0.8)


def test_west_is_to_the_right_of_a_player_who_looks_south() -> None:
    picture = drawn(sight({(-1, 64, 3): "stone"}))
    assert picture[82, 125].tolist() == shade("stone", 0.8)
    assert picture[82, 75].tolist() == shade("bedrock", 1.0)


@pytest.mark.parametrize(("yaw", "ahead"), [(0, (0, 64, 3)), (90, (-3, 64, 0)), (180, (0, 64, -3)), (-90, (3, 64, 0))])
def test_a_turned_view_shows_the_block_ahead(yaw: float, ahead: Block) -> None:
    light = 0.8 if yaw in (0, 180) else 0.62
    assert drawn(sight({ahead: "stone"}, yaw=yaw))[82, 100].tolist() == shade("stone", light)


def test_a_nearer_block_hides_a_farther_one() -> None:
    both = {(0, 64, 3): "stone", (0, 64, 4): "oak_planks", (0, 65, 4): "oak_planks"}
    picture = drawn(sight(both))
    assert picture[82, 100].tolist() == shade("stone", 0.8)
    # Over the nearer one's top, half a block lower than the eye, 3.5 blocks away: the face of the upper one.
    assert picture[55, 100].tolist() == shade("oak_planks", 0.8)


def test_looking_straight_down_shows_the_block_under_the_feet() -> None:
    assert drawn(sight({(0, 63, 0): "sand"}, pitch=90.0))[50, 100].tolist() == shade("sand", 1.0)


def test_a_block_beside_the_eye_is_cut_where_it_reaches_behind_it() -> None:
    # Its south face is behind the picture, its near side fills the right half from top to bottom.
    picture = drawn(sight({(-1, 65, 0): "stone"}))
    assert picture[50, 199].tolist() == shade("stone", 0.62)
    assert tuple(picture[20, 20]) == SKY_BGR


def test_the_block_looked_at_has_a_black_outline() -> None:
    built = {(0, 64, 3): "stone"}
    plain, outlined = drawn(sight(built)), drawn(sight(built, target=(0, 64, 3)))
    changed = outlined[(plain != outlined).any(2)]
    assert len(changed) > 50
    assert not changed.any()


def test_the_block_in_the_hand_is_seen_in_the_lower_right() -> None:
    changed = np.argwhere((drawn(sight()) != drawn(sight(held="stone"))).any(2))
    assert changed[:, 0].min() > 50
    assert changed[:, 1].min() > 110


def test_the_far_floor_fades_into_the_sky() -> None:
    # A row below the horizon the floor is 1.62 / (0.7002 / 100) = 231 blocks away.
    assert tuple(drawn(sight())[50, 100]) == SKY_BGR


@given(
    st.tuples(st.floats(-3, 3), st.floats(-3, 3)),
    st.floats(-180, 180),
    st.floats(0, 90),
    st.tuples(st.integers(0, 199), st.integers(0, 99), st.integers(1, 200), st.integers(1, 100)),
)
def test_a_part_drawn_alone_equals_that_part_of_the_whole_picture(
    at: tuple[float, float], yaw: float, pitch: float, part: tuple[int, int, int, int]
) -> None:
    built = {(1, 64, 2): "stone", (1, 65, 2): "dirt", (-4, 64, -2): "sand", (4, 63, 3): "obsidian", (0, 64, 4): "stone"}
    seen = sight(built, at=(at[0], 65.62, at[1]), yaw=yaw, pitch=pitch, held="sand")
    left, top = part[0], part[1]
    right, bottom = min(200, left + part[2]), min(100, top + part[3])
    alone = np.zeros((100, 200, 3), np.uint8)
    WorldLayers(SIZE).of(seen).draw(alone, (left, top, right, bottom))
    assert np.array_equal(alone[top:bottom, left:right], drawn(seen)[top:bottom, left:right])
    alone[top:bottom, left:right] = 0
    assert not alone.any()


def test_the_layer_stays_the_same_until_something_moves_or_changes() -> None:
    worlds = WorldLayers(SIZE)
    built = {(0, 64, 3): "stone"}
    first = worlds.of(sight(built))
    assert worlds.of(sight(built)) is first
    moved = worlds.of(sight(built, at=(0.5, 65.62, 0.6)))
    assert moved is not first
    changed = worlds.of(sight({(0, 64, 3): "sand"}))
    frame = np.zeros((100, 200, 3), np.uint8)
    changed.draw(frame, (0, 0, 200, 100))
    assert frame[82, 100].tolist() == shade("sand", 0.8)
