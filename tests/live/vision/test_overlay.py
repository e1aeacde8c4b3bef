"""Finding the debug screen on painted frames: by which line, at which scale, in which colour and layout."""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.font import Font, font_of
from mc_nested.live.vision.glyph_grid import GlyphGrid
from mc_nested.live.vision.layout import BOXES, STANDIN, VANILLA, Overlay, Scales
from mc_nested.live.vision.overlay import find_debug_screen, find_overlay
from mc_nested.live.vision.text_lines import positions_of
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.drawing.painter import WORLDS, Painter, random_world
from sim.client.game.edition import Edition, Layout
from sim.client.game.f3_screen import F3Screen
from sim.client.game.f3_text import LAYOUTS
from sim.client.game.screens import MenuState, ScreenName
from sim.client.game.view import View

FONT = font_of(drawn_atlas())
VANILLA_INK, STANDIN_INK = (224, 224, 224), (255, 255, 255)


def screen(layout: Layout = "1.16-1.19.2", scale: int = 2) -> F3Screen:
    name = "stone" if layout == "standin" else "minecraft:stone"
    return F3Screen(layout, scale, (-8.5, 64.0, 12.25), 90.0, 65.0, Target((-9, 63, 12), name))


def painted(shown: F3Screen) -> Frame:
    scale = shown.gui_scale
    return paint(np.full((240 * scale, 430 * scale, 3), 120, np.uint8), shown, FONT)


def start_of(frame: Frame, scale: int, text: str) -> tuple[int, int]:
    return positions_of(GlyphGrid(frame, scale, 200), FONT, text)[0]


def cover_line(frame: Frame, scale: int, text: str) -> None:
    row, _ = start_of(frame, scale, text)
    frame[scale * row : scale * (row + 8), : frame.shape[1] // 2] = 0


@pytest.mark.parametrize("scale", [1, 2, 3, 4, 6, 8])
@pytest.mark.parametrize("layout", LAYOUTS)
def test_every_layout_is_found_at_every_scale_by_its_position_line(layout: Layout, scale: int) -> None:
    found = find_debug_screen(painted(screen(layout, scale)), FONT)
    assert found is not None
    drawn = Overlay(
        scale,
        {"standin": STANDIN, "26.4": BOXES}.get(layout, VANILLA),
        STANDIN_INK if layout == "standin" else VANILLA_INK,
    )
    assert (found.overlay, found.label) == (drawn, "XYZ:")


@pytest.mark.parametrize("version", ["1.12.2", "1.20.1", "26.1"])
@pytest.mark.parametrize("screen_name", ["title", "servers"])
@pytest.mark.parametrize("overlay", [None, Overlay(2, VANILLA, VANILLA_INK)])
def test_the_games_name_on_a_menu_is_not_taken_for_a_debug_screen(
    version: str, screen_name: ScreenName, overlay: Overlay | None
) -> None:
    painter = Painter((854, 480), Scales(2, 2), FONT, Edition(version), "noise", 0)
    frame = painter.grab(View(MenuState(screen_name), (0, 0, 0)))
    assert positions_of(GlyphGrid(frame, 2, 200), FONT, "Minecraft "), "the name stands there"
    assert find_debug_screen(frame, FONT, overlay) is None


def test_a_debug_screen_is_found_by_its_line_with_the_games_name() -> None:
    frame = painted(screen())
    for label in ("XYZ:", "Block:", "Chunk:", "Facing", "Targeted "):
        for row, _ in positions_of(GlyphGrid(frame, 2, 200), FONT, label):
            frame[2 * row : 2 * (row + 8)] = 0
    found = find_debug_screen(frame, FONT)
    assert found is not None
    assert found.label == "Minecraft "


@pytest.mark.parametrize("layout", ["1.16-1.19.2", "standin"])
def test_a_debug_screen_without_its_position_line_is_found_by_another_line(layout: Layout) -> None:
    frame = painted(screen(layout))
    cover_line(frame, 2, "XYZ:")
    found = find_debug_screen(frame, FONT)
    assert found is not None
    assert (found.overlay.layout, found.label) == (STANDIN if layout == "standin" else VANILLA, "Facing")


def test_a_reduced_debug_screen_is_found_by_its_own_line() -> None:
    found = find_debug_screen(painted(dataclasses.replace(screen(), reduced=True)), FONT)
    assert found is not None
    assert found.label == "Chunk-relative:"


def test_a_debug_screen_with_a_covered_left_column_is_found_by_the_right_one() -> None:
    frame = painted(screen())
    frame[:, : frame.shape[1] // 3] = 0
    found = find_debug_screen(frame, FONT)
    assert found is not None
    assert found.overlay == Overlay(2, VANILLA, VANILLA_INK)


def test_a_position_line_in_the_right_column_is_found_there() -> None:
    frame = painted(screen())
    moved = np.roll(frame, 2 * 200, axis=1)
    found = find_debug_screen(moved, FONT)
    assert found is not None
    assert (found.overlay.scale, found.label) == (2, "XYZ:")


def test_the_overlays_colour_is_the_inks_as_red_green_blue() -> None:
    frame = painted(screen())
    frame[(frame == 224).all(axis=2)] = (222, 223, 221)
    assert find_overlay(frame, FONT) == Overlay(2, VANILLA, (221, 223, 222))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", [*WORLDS, "bright", "dark"])
def test_no_debug_screen_is_found_in_noise(kind: str, seed: int) -> None:
    world = random_world(np.random.default_rng(seed), kind, 854, 480)
    assert find_debug_screen(world, FONT) is None
    assert find_overlay(world, FONT) is None


def test_no_debug_screen_is_found_with_another_font() -> None:
    other = Font({char: columns[::-1] + b"\7" for char, columns in FONT.glyphs.items()})
    assert find_overlay(painted(screen()), other) is None


def test_a_known_overlay_is_kept_as_it_is() -> None:
    known = Overlay(2, VANILLA, (223, 224, 222))
    found = find_debug_screen(painted(screen()), FONT, known)
    assert found is not None
    assert found.overlay is known


@pytest.mark.parametrize(
    "known",
    [Overlay(3, VANILLA, VANILLA_INK), Overlay(1, VANILLA, VANILLA_INK), Overlay(2, VANILLA, STANDIN_INK)],
    ids=["a larger scale", "a smaller scale", "a brighter ink"],
)
def test_a_debug_screen_that_differs_from_the_known_overlay_is_not_found(known: Overlay) -> None:
    assert find_debug_screen(painted(screen()), FONT, known) is None


def test_ink_more_than_4_darker_than_the_known_colour_is_not_found() -> None:
    # 4 below 228 is 224; 4 below 229 is more than that.
    frame = painted(screen())
    assert find_debug_screen(frame, FONT, Overlay(2, VANILLA, (255, 228, 255))) is not None
    assert find_debug_screen(frame, FONT, Overlay(2, VANILLA, (255, 229, 255))) is None


@pytest.mark.parametrize(
    ("layout", "label", "is_found"), [("1.16-1.19.2", "Targeted ", False), ("standin", "Looking at:", True)]
)
def test_a_line_outside_the_grid_is_ignored_in_vanilla_and_found_in_the_stand_in(
    layout: Layout, label: str, is_found: bool
) -> None:
    frame = painted(screen(layout))
    right = frame[:, 2 * 215 :]
    right[:] = np.roll(right, 2, axis=0)  # a dot lower
    found = find_debug_screen(frame, FONT)
    assert found is not None
    assert bool(positions_of(found.dots, FONT, label)) is is_found
    assert positions_of(found.dots, FONT, "XYZ:") == [start_of(frame, 2, "XYZ:")]
