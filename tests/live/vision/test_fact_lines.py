"""A line of 26.4, read: a name and its value, in their colours, at their columns."""

import dataclasses

import numpy as np
import pytest

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Target
from mc_nested.live.vision.fact_lines import fact_from
from mc_nested.live.vision.glyph_grid import GlyphGrid
from mc_nested.live.vision.layout import BOXES, Overlay
from mc_nested.live.vision.text_lines import UNKNOWN, Line, positions_of
from scripts.benches.painted_screen import paint
from sim.client.game.f3_screen import F3Screen
from tests.sim.client.playing import FONT

TARGET = Target((4, -61, 11), "minecraft:oak_log")
SCREEN = F3Screen("26.4", 1, (-12.3, -59.0, -6.011), 58.0, 3.3, TARGET, (("axis", "y"), ("lit", "true")), has_f3=False)
OVERLAY = Overlay(1, BOXES, (224, 224, 224))


def painted(grey: int = 120) -> Frame:
    entries = ("fps", "looking_at_block_state", "player_position")
    return paint(np.full((240, 640, 3), grey, np.uint8), dataclasses.replace(SCREEN, entries=entries), FONT)


def line(frame: Frame, label: str) -> Line:
    (position,) = positions_of(GlyphGrid(frame, 1, 200), FONT, label)
    return fact_from(GlyphGrid(frame, 1, 200), FONT, OVERLAY, position)


@pytest.mark.parametrize("grey", [0, 120, 240])
@pytest.mark.parametrize(
    ("label", "text"),
    [
        ("XYZ:", "XYZ: -12.300 / -59.00000 / -6.011"),
        ("Facing:", "Facing: west (Towards negative X) (58.0 / 3.3)"),
        ("Chunk:", "Chunk: -1 -4 -1 [31 31 in r.-1.-1.mca]"),
        ("Coordinates:", "Coordinates: 4, -61, 11"),
        ("Type:", "Type: minecraft:oak_log"),
        ("lit:", "lit: true"),
        ("Looking At", "Looking At Block"),
        ("120 fps", "120 fps T: 120 (fifo) @60Hz"),
    ],
)
def test_names_values_titles_and_plain_lines_are_read(label: str, text: str, grey: int) -> None:
    found = line(painted(grey), label)
    assert (found.text, found.whole) == (text, True)
    assert found.has_value == (label != "120 fps")


def test_a_text_in_the_names_colour_is_not_taken_for_a_value() -> None:
    frame = painted()
    row, _ = positions_of(GlyphGrid(frame, 1, 200), FONT, "Type:")[0]
    part = frame[row : row + 8]
    part[(part == 255).all(2)] = 224
    found = line(frame, "Type:")
    assert not found.has_value
    assert found.text.startswith(f"Type:{UNKNOWN}")


def test_a_text_outside_the_values_column_is_not_taken_for_a_value() -> None:
    frame = painted()
    found = line(frame, "Type:")
    behind = found.start + len(FONT.columns("Type:"))
    part = frame[found.row : found.row + 8, behind:]
    part[:] = np.roll(part, 1, axis=1)
    assert "minecraft" not in line(frame, "Type:").text


@pytest.mark.parametrize("cover", [60, 100, 150, 255, 0])
def test_a_value_whose_end_is_covered_is_not_whole(cover: int) -> None:
    frame = painted(200)
    found = line(frame, "Type:")
    hidden = found.start + len(FONT.columns("Type: minecraft:oak")) - 1
    frame[found.row - 1 : found.row + 9, hidden : hidden + 40] = cover
    again = line(frame, "Type:")
    assert again.text.startswith("Type: minecraft:oa")
    assert not again.whole or UNKNOWN in again.text


def test_a_line_is_whole_if_the_world_shows_behind_its_box_but_not_if_another_box_does() -> None:
    screen = dataclasses.replace(SCREEN, entries=("fps", "looking_at_block_state", "player_position"))
    screen = dataclasses.replace(screen, target=Target((-1234, -61, 123456), "minecraft:dirt"))
    world = np.full((240, 640, 3), 120, np.uint8)
    found = line(paint(world, screen, FONT), "Type:")
    world[:, found.end + 2 :] = (200, 210, 170)
    frame = paint(world, screen, FONT)
    assert line(frame, "Type:") == dataclasses.replace(found, whole=True)
    frame[found.row - 1 : found.row + 9, found.end + 2 :] = 110  # as under one box more
    assert not line(frame, "Type:").whole


def test_fact_from_leaves_out_ink_behind_the_given_end() -> None:
    frame = painted()
    dots = GlyphGrid(frame, 1, 200)
    whole = line(frame, "Coordinates:")
    end = whole.start + len(FONT.columns("Coordinates: 4, -61")) - 3
    assert fact_from(dots, FONT, OVERLAY, (whole.row, whole.start), end).text == "Coordinates: 4, -61"
