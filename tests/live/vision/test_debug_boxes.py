"""Boxes are in pixels; a GUI scale of 2 doubles all of the facts' lengths.

Where 26.4's boxes lie on a picture: as they were drawn, before any world.
"""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.debug_boxes import (
    GroundPart,
    ground_parts,
    has_letters,
    line_boxes,
)
from mc_nested.live.vision.layout import BOX_ALPHA, BOX_GREY, TITLE_GREY
from scripts.benches.painted_screen import paint
from sim.client.drawing.painter import WORLDS, random_world
from sim.client.game.f3_screen import F3Screen
from tests.sim.client.f3_lines import left_lines, right_lines
from tests.sim.client.playing import FONT

SCREEN = F3Screen("1.19.3-1.21.8", 1, (0.5, 64.0, 0.5), 0.0, 65.0)


def screen_at(scale: int) -> F3Screen:
    return F3Screen("1.19.3-1.21.8", scale, (0.5, 64.0, 0.5), 0.0, 65.0)


def bare(width: int, height: int) -> Frame:
    return np.full((height, width, 3), 100, np.uint8)


@pytest.mark.parametrize("scale", [1, 2, 3])
def test_each_line_has_its_box_with_a_dot_around_the_text(scale: int) -> None:
    size = (600 * scale, 300 * scale)
    boxes = line_boxes(paint(bare(*size), screen_at(scale), FONT), scale)
    lines = [line.text for lines in (left_lines(SCREEN), right_lines(SCREEN)) for line in lines if line.text]
    assert len(boxes) == len(lines)
    # The first line: from dot 1 in both directions, nine dots high.
    assert boxes[0].left == boxes[0].top == scale
    assert boxes[0].height == 9 * scale
    assert {box.left + box.width for box in boxes if box.left > size[0] / 2} == {size[0] - scale}


@pytest.mark.parametrize("kind", [*(kind for kind in WORLDS if kind != "specks"), "bright", "dark"])
def test_a_box_is_as_wide_as_it_was_drawn_over_any_world(kind: str) -> None:
    world = random_world(np.random.default_rng(1), kind, 854, 480)
    frame = paint(world, SCREEN, FONT)
    is_changed = (frame != world).any(2)
    for box in line_boxes(frame, 1):
        rows, columns = slice(box.top, box.top + 9), slice(box.left, box.left + box.width)
        assert is_changed[rows, columns].mean() > 0.9


def test_a_picture_without_a_debug_screen_has_no_boxes() -> None:
    assert line_boxes(bare(400, 200), 1) == []


def test_a_lines_box_ends_where_something_dark_covers_it() -> None:
    frame = paint(bare(600, 300), SCREEN, FONT)
    whole = line_boxes(frame, 1)[0]
    frame[0:12, 40:] = 0
    ended = line_boxes(frame, 1)[0]
    assert (ended.left, ended.top, ended.height) == (1, 1, 9)
    assert 36 <= ended.width <= 42 < 60 < whole.width


def test_a_box_mixes_the_world_with_its_grey() -> None:
    frame = paint(bare(600, 300), SCREEN, FONT)
    box = line_boxes(frame, 1)[0]
    under = frame[box.top, box.left]
    assert under.tolist() == [round(BOX_GREY * BOX_ALPHA + 100 * (1 - BOX_ALPHA))] * 3


def test_letters_are_white_green_or_red() -> None:
    picture = np.array([[(224, 224, 224), (221, 221, 221), (85, 255, 85), (85, 85, 255), (200, 200, 200)]], np.uint8)
    assert has_letters(picture).tolist() == [[True, True, True, True, False]]


TARGET = Target((4, -61, 11), "minecraft:oak_log")
BOXED_SCREEN = F3Screen(
    "26.4", 1, (-12.3, -59.0, -6.011), 58.0, 3.3, TARGET, (("axis", "y"), ("lit", "true")), ("minecraft:logs",)
)
BOXED_SCREEN = dataclasses.replace(
    BOXED_SCREEN, entries=("fps", "looking_at_block_state", "looking_at_block_tags", "memory", "player_position")
)


@pytest.mark.parametrize("scale", [1, 2, 3])
def test_each_ground_lies_where_it_was_drawn(scale: int) -> None:
    bare = np.full((300 * scale, 700 * scale, 3), 100, np.uint8)
    frame = paint(bare, dataclasses.replace(BOXED_SCREEN, gui_scale=scale, has_f3=False), FONT)
    covered = np.zeros(frame.shape[:2], bool)
    for region, grey in ground_parts(frame, scale):
        rows = slice(region.top, region.top + region.height)
        columns = slice(region.left, region.left + region.width)
        covered[rows, columns] = True
        assert (frame[rows, columns][0, 0] == round(100 * 111 / 255 + grey * 144 / 255)).all()
    # The bars at both sides are no ground.
    changed = (frame != bare).any(2)
    changed[:, :scale] = changed[:, -scale:] = False
    assert np.array_equal(covered, changed)


@pytest.mark.parametrize("kind", [*(kind for kind in WORLDS if kind != "specks"), "bright", "dark"])
def test_most_grounds_are_found_over_any_world(kind: str) -> None:
    world = random_world(np.random.default_rng(1), kind, 854, 480)
    plain = ground_parts(paint(np.full_like(world, 100), BOXED_SCREEN, FONT), 1)
    found = ground_parts(paint(world, BOXED_SCREEN, FONT), 1)
    assert len(set(found) & set(plain)) >= 0.7 * len(plain)


def test_titles_lie_on_a_ground_of_their_own_grey() -> None:
    parts = ground_parts(paint(np.full((300, 700, 3), 100, np.uint8), BOXED_SCREEN, FONT), 1)
    assert {part.grey for part in parts} == {TITLE_GREY, BOX_GREY}
    assert all(part.region.height == 9 for part in parts if part.grey == TITLE_GREY)


@pytest.mark.parametrize("layout", ["1.20.1", "26.1"])
def test_older_debug_screens_have_no_boxes(layout: str) -> None:
    old = F3Screen("1.21.9-26.3" if layout == "26.1" else "1.19.3-1.21.8", 1, (0.5, 64.0, 0.5), 0.0, 65.0)
    assert ground_parts(paint(np.full((300, 700, 3), 100, np.uint8), old, FONT), 1) == []
    assert GroundPart(Region(0, 0, 1, 1), 80) not in ground_parts(np.full((300, 700, 3), 100, np.uint8), 1)
