"""The sign that no block is looked at: the same as long as none is, another one as soon as one is."""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.debug_screen import read_lines
from mc_nested.live.vision.no_block import shows_no_block, sign_of_no_block
from mc_nested.live.vision.overlay import find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines
from sim.client.drawing.f3_layers import paint
from sim.client.drawing.scenery import random_world
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS
from tests.sim.client.playing import FONT

GAMES = [layout for layout in LAYOUTS if layout != "standin"]


def sky(layout: Layout, **more: object) -> F3Screen:
    return dataclasses.replace(F3Screen(layout, 1, (8.5, 64.0, 3.5), 0.0, 65.0), **more)  # type: ignore[arg-type]


def painted(shown: F3Screen, seed: int = 0) -> Frame:
    return paint(random_world(np.random.default_rng(seed), "grey noise", 860, 480) // 2, shown, FONT)


def lines_of(frame: Frame) -> ScreenLines:
    found = find_debug_screen(frame, FONT)
    assert found is not None
    lines = ScreenLines(found.dots, FONT, found.overlay)
    assert read_lines(lines).problem is None
    return lines


@pytest.mark.parametrize("layout", GAMES)
def test_it_is_there_while_the_player_moves_and_gone_with_a_block(layout: Layout) -> None:
    lines = lines_of(painted(sky(layout)))
    sign = sign_of_no_block(lines, FONT)
    assert sign is not None
    assert shows_no_block(painted(sky(layout, xyz=(9.25, 64.0, 3.5), yaw=90.0), 1), lines.overlay, sign)
    block = sky(layout, target=Target((8, 63, 4), "minecraft:stone"))
    assert not shows_no_block(painted(block), lines.overlay, sign)


@pytest.mark.parametrize("layout", ["1.21.9-26.3", "26.4"])
def test_there_is_none_beside_something_else_that_is_looked_at(layout: Layout) -> None:
    entries = ("looking_at_block_state", "looking_at_entity", "player_position")
    shown = sky(layout, entries=entries, entity=(8.5, 64.0, 5.5), has_f3=False)
    assert sign_of_no_block(lines_of(painted(shown)), FONT) is None


def test_there_is_none_where_a_block_might_have_no_room() -> None:
    frame = painted(sky("26.4"))
    assert sign_of_no_block(lines_of(frame), FONT) is not None
    assert sign_of_no_block(lines_of(frame[:260]), FONT) is None


def test_there_is_none_in_a_shifted_picture_of_boxes() -> None:
    assert sign_of_no_block(lines_of(np.pad(painted(sky("26.4")), ((31, 0), (5, 5), (0, 0)))), FONT) is None
