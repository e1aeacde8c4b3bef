"""Notices over the right column: seen by their left edge, on any world; debug screens alone are none."""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.debug_screen import read_debug_screen
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.glyph_grid import GlyphGrid
from mc_nested.live.vision.hidden_lines import may_hide_lines
from mc_nested.live.vision.layout import Scales
from scripts.benches.f3_cases import frames
from sim.client.drawing.letters import drawn_atlas
from sim.client.drawing.painter import WORLDS, Painter
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS
from sim.client.game.screens import MenuState
from sim.client.game.view import View

FONT = font_of(drawn_atlas())
GAME_LAYOUTS = [layout for layout in LAYOUTS if layout != "standin"]
TARGET = Target((-9, 63, 12), "minecraft:stone")


def painted(layout: Layout, notices: tuple[str, ...], target: Target | None = TARGET, world: str = "noise") -> Frame:
    entries = ("looking_at_block_state", "player_position") if layout == "26.4" else None
    shown = F3Screen(layout, 2, (-8.5, 64.0, 12.25), 90.0, 65.0, target, entries=entries, has_f3=not entries)
    painter = Painter((854, 480), Scales(2, 2), FONT, shown.edition, world, 3)
    return painter.grab(View(MenuState("world"), (0, 0, 0), shown, notices=notices))


@pytest.mark.parametrize("count", [1, 2, 3, 4, 5])
@pytest.mark.parametrize("layout", GAME_LAYOUTS)
def test_a_block_under_notices_is_read_right_or_reported_as_unread(layout: Layout, count: int) -> None:
    reading = read_debug_screen(painted(layout, ("Open your inventory",) * count), FONT)
    assert reading.problem is not None or reading.target == TARGET


@pytest.mark.parametrize("place", range(5))
@pytest.mark.parametrize("layout", GAME_LAYOUTS)
def test_a_block_under_one_remaining_notice_is_read_right_or_reported_as_unread(layout: Layout, place: int) -> None:
    reading = read_debug_screen(painted(layout, ("",) * place + ("Look around",)), FONT)
    assert reading.problem is not None or reading.target == TARGET


@pytest.mark.parametrize("layout", GAME_LAYOUTS)
def test_a_screen_without_notices_and_target_reads_as_no_target(layout: Layout) -> None:
    reading = read_debug_screen(painted(layout, (), None), FONT)
    assert (reading.problem, reading.target) == (None, None)


@pytest.mark.parametrize("world", [*WORLDS, "bright", "dark"])
def test_a_notice_is_seen_in_front_of_any_world(world: str) -> None:
    dots = GlyphGrid(painted("1.19.3-1.21.8", ("", "", "", "Find a tree"), None, world), 2, 200)
    assert may_hide_lines(dots)


def test_no_notice_is_seen_on_random_debug_screens_without_one() -> None:
    cases = (next_case for next_case, _ in zip(frames(FONT, 5), range(120), strict=False))
    for shown, frame in cases:
        if shown.layout != "standin":
            assert not may_hide_lines(GlyphGrid(frame, shown.gui_scale, 200)), dataclasses.astuple(shown)


def test_no_notice_is_seen_on_a_plain_sky() -> None:
    assert not may_hide_lines(GlyphGrid(np.full((480, 854, 3), 200, np.uint8), 2, 200))
    assert not may_hide_lines(GlyphGrid(np.full((20, 30, 3), 200, np.uint8), 2, 200))
