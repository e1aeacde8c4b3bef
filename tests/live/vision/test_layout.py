"""The layouts' constants, compared with what the virtual client paints."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.glyph_grid import GlyphGrid
from mc_nested.live.vision.layout import BOXES, LAYOUTS, LINE_PITCH, STANDIN, VANILLA, Overlay, ScreenLayout
from mc_nested.live.vision.text_lines import positions_of
from scripts.benches.painted_screen import paint
from sim.client.drawing.letters import drawn_atlas
from sim.client.game.edition import Layout
from sim.client.game.f3_screen import F3Screen

FONT = font_of(drawn_atlas())
COLUMNS = 430
SKY = 200
"""The grey behind the debug screen: brighter than any box, and darker than its text."""

BOTH: list[tuple[Layout, ScreenLayout]] = [("1.16-1.19.2", VANILLA), ("standin", STANDIN)]


def painted(layout: Layout, sky: int = SKY) -> Frame:
    """At GUI scale 1, so that a dot is a pixel."""
    name = "stone" if layout == "standin" else "minecraft:stone"
    shown = F3Screen(layout, 1, (-8.5, 64.0, 12.25), 90.0, 65.0, Target((-9, 63, 12), name))
    return paint(np.full((240, COLUMNS, 3), sky, np.uint8), shown, FONT)


def start_of(frame: Frame, text: str) -> tuple[int, int]:
    return positions_of(GlyphGrid(frame, 1, 210), FONT, text)[0]


def test_the_vanilla_layout_has_the_games_lengths_and_colours() -> None:
    assert ScreenLayout("vanilla", 9, (224, 224, 224), VANILLA.box, True, 4, False) == VANILLA
    assert (VANILLA.box.grey, VANILLA.box.behind) == (80, 2)


def test_the_stand_in_layout_has_its_lengths_and_colours() -> None:
    assert ScreenLayout("stand-in", 10, (255, 255, 255), STANDIN.box, False, None, True) == STANDIN
    assert (STANDIN.box.grey, STANDIN.box.behind) == (110, 1)


def test_vanillas_lines_are_as_high_as_the_chats() -> None:
    assert VANILLA.pitch == LINE_PITCH


def test_three_layouts_can_be_named_in_a_profile() -> None:
    assert LAYOUTS == {"vanilla": VANILLA, "boxes": BOXES, "stand-in": STANDIN}


def test_an_overlay_has_its_layouts_line_pitch() -> None:
    assert [Overlay(3, layout, (224,) * 3).pitch for layout in (VANILLA, STANDIN)] == [9, 10]


@pytest.mark.parametrize(("name", "layout"), BOTH)
def test_text_is_painted_in_the_layouts_colour_at_its_pitch(name: Layout, layout: ScreenLayout) -> None:
    frame = painted(name)
    below = {"1.16-1.19.2": "Block: -9 64", "standin": "Chunk:"}[name]
    row, column = start_of(frame, "XYZ:")
    assert tuple(frame[row, column, ::-1]) == layout.text_colour  # an X has ink in its upper left corner
    assert start_of(frame, below)[0] - row == layout.pitch


@pytest.mark.parametrize(("name", "layout"), BOTH)
def test_a_box_ends_the_layouts_number_of_columns_behind_the_last_ink(name: Layout, layout: ScreenLayout) -> None:
    frame = painted(name)
    row, _ = start_of(frame, "XYZ:")
    line = frame[row : row + 7, : COLUMNS // 2, 1]
    inked = np.flatnonzero((line == layout.text_colour[0]).any(axis=0))
    boxed = np.flatnonzero((line != SKY).all(axis=0))
    assert boxed[-1] - inked[-1] == layout.box.behind


@pytest.mark.parametrize(("name", "layout"), BOTH)
def test_a_box_does_not_change_a_sky_of_its_own_grey(name: Layout, layout: ScreenLayout) -> None:
    frame = painted(name, sky=layout.box.grey)
    row, column = start_of(frame, "XYZ:")
    assert set(np.unique(frame[row : row + 7, column : column + 30])) == {layout.box.grey, layout.text_colour[0]}


@pytest.mark.parametrize(("name", "layout"), BOTH)
def test_vanillas_lines_stand_in_one_grid_and_the_stand_ins_do_not(name: Layout, layout: ScreenLayout) -> None:
    frame = painted(name)
    labels = ["Prismarine" if name == "standin" else "Minecraft 1.16", "XYZ:"]  # an empty line lies between
    rows = {start_of(frame, label)[0] % layout.pitch for label in labels}
    assert (len(rows) == 1) is layout.has_one_grid


def test_vanillas_right_column_ends_at_the_layouts_right_edge() -> None:
    frame = painted("1.16-1.19.2")
    row, column = start_of(frame, "minecraft:stone")
    inked = np.flatnonzero((frame[row : row + 7, column:, 1] == 224).any(axis=0)) + column
    assert VANILLA.right_edge is not None
    assert inked[-1] == COLUMNS - VANILLA.right_edge
