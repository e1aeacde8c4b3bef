"""Where 26.4's boxes lie on a picture: as they were drawn, before any world."""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.devices import Region
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.group_boxes import FACTS_GREY, TITLE_GREY, GroundPart, ground_parts
from sim.client.drawing.f3_layers import paint
from sim.client.drawing.scenery import WORLDS, random_world
from sim.client.game.f3_screen import F3Screen
from tests.sim.client.playing import FONT

TARGET = Target((4, -61, 11), "minecraft:oak_log")
SCREEN = F3Screen(
    "26.4", 1, (-12.3, -59.0, -6.011), 58.0, 3.3, TARGET, (("axis", "y"), ("lit", "true")), ("minecraft:logs",)
)
SCREEN = dataclasses.replace(
    SCREEN, entries=("fps", "looking_at_block_state", "looking_at_block_tags", "memory", "player_position")
)


@pytest.mark.parametrize("scale", [1, 2, 3])
def test_each_ground_lies_where_it_was_drawn(scale: int) -> None:
    bare = np.full((300 * scale, 700 * scale, 3), 100, np.uint8)
    frame = paint(bare, dataclasses.replace(SCREEN, gui_scale=scale, has_f3=False), FONT)
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
def test_they_are_found_before_any_world(kind: str) -> None:
    world = random_world(np.random.default_rng(1), kind, 854, 480)
    plain = ground_parts(paint(np.full_like(world, 100), SCREEN, FONT), 1)
    found = ground_parts(paint(world, SCREEN, FONT), 1)
    assert len(set(found) & set(plain)) >= 0.7 * len(plain)


def test_titles_lie_on_a_darker_ground() -> None:
    parts = ground_parts(paint(np.full((300, 700, 3), 100, np.uint8), SCREEN, FONT), 1)
    assert {part.grey for part in parts} == {TITLE_GREY, FACTS_GREY}
    assert all(part.region.height == 9 for part in parts if part.grey == TITLE_GREY)


@pytest.mark.parametrize("layout", ["1.20.1", "26.1"])
def test_older_screens_have_none(layout: str) -> None:
    old = F3Screen("1.21.9-26.3" if layout == "26.1" else "1.19.3-1.21.8", 1, (0.5, 64.0, 0.5), 0.0, 65.0)
    assert ground_parts(paint(np.full((300, 700, 3), 100, np.uint8), old, FONT), 1) == []
    assert GroundPart(Region(0, 0, 1, 1), 80) not in ground_parts(np.full((300, 700, 3), 100, np.uint8), 1)
