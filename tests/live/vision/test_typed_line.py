"""The line being typed, on pictures painted for the test: where it stands, whether it is one, what it holds."""

import numpy as np
import pytest

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.typed_line import (
    FIRST_COLUMNS,
    begins_a_line,
    reads_as,
    typed_line_dots,
    typed_line_region,
)
from sim.client.drawing.font import drawn_atlas
from tests.live.vision.menu_painter import MenuPainter

FONT = font_of(drawn_atlas())
PLAIN, GOLD = (224, 224, 224), (255, 170, 0)


def painted(text: str, colour: tuple[int, int, int] = PLAIN, columns: int = 100) -> Frame:
    """The dots of a typed line, nine rows high, over a dark ground."""
    frame: Frame = np.full((9, columns, 3), 40, np.uint8)
    MenuPainter(frame, 1, FONT, np.random.default_rng(0)).text(text, 0, 0, colour)
    return frame


def test_it_stands_4_dots_from_the_left_and_12_above_the_lower_edge_as_far_as_4_from_the_right() -> None:
    assert typed_line_region((854, 480), 2) == Region(8, 456, 838, 18)
    assert typed_line_region((854, 480), 2, columns=8) == Region(8, 456, 16, 18)


def test_where_the_last_dots_are_cut_it_stands_as_the_game_counts_them() -> None:
    # 241 rows at scale 2 are 121 dots: the line begins 109 dots down.
    assert typed_line_region((640, 241), 2) == Region(8, 218, 624, 18)


def test_of_each_dot_the_middle_pixel_counts() -> None:
    frame = np.zeros((27, 6, 3), np.uint8)
    frame[1, 1] = frame[25, 4] = 9
    dots = typed_line_dots(frame, 3)
    assert dots.shape == (9, 2, 3)
    assert [dots[0, 0, 0], dots[8, 1, 0], int(dots.sum())] == [9, 9, 54]


@pytest.mark.parametrize("colour", [PLAIN, GOLD, (255, 85, 85), (220, 228, 224)])
def test_a_shadowed_letter_of_any_of_its_colours_begins_a_line(colour: tuple[int, int, int]) -> None:
    assert begins_a_line(painted("/tp", colour)[:, :FIRST_COLUMNS], FONT)


def test_letters_of_another_colour_begin_none() -> None:
    assert not begins_a_line(painted("/tp", (224, 224, 170))[:, :FIRST_COLUMNS], FONT)


def test_ink_without_its_shadow_begins_none() -> None:
    dots = painted("/tp")
    dots[(dots == 56).all(2)] = 40
    assert not begins_a_line(dots[:, :FIRST_COLUMNS], FONT)


def test_shadowed_specks_that_are_no_letter_begin_none() -> None:
    dots = np.full((9, FIRST_COLUMNS, 3), 40, np.uint8)
    for row, column in ((1, 1), (3, 1), (5, 3), (6, 5)):
        dots[row, column], dots[row + 1, column + 1] = 224, 56
    assert not begins_a_line(dots, FONT)


def test_an_empty_line_begins_none() -> None:
    assert not begins_a_line(painted("")[:, :FIRST_COLUMNS], FONT)


@pytest.mark.parametrize("shown", ["/tp 1 2 3", "/tp 1 2 3_"])
def test_a_line_reads_as_its_text_with_its_cursor_or_without(shown: str) -> None:
    assert reads_as(painted(shown), "/tp 1 2 3", FONT)


@pytest.mark.parametrize("shown", ["/tp 1 2 34", "/tp 1 2", "tp 1 2 3", "", "/tp 1 2 3        ."])
def test_a_line_reads_as_no_other_text(shown: str) -> None:
    assert not reads_as(painted(shown), "/tp 1 2 3", FONT)


def test_an_empty_line_reads_as_nothing_typed() -> None:
    assert reads_as(painted(""), "", FONT)
    assert reads_as(painted("_"), "", FONT)
    assert not reads_as(painted("t"), "", FONT)


def test_of_a_line_too_long_its_end_is_enough_where_it_fills_the_line() -> None:
    text = "/fill 100 200 300 minecraft:stone"
    end = text[-14:]
    wide = len(FONT.columns(end).rstrip(b"\0"))
    assert reads_as(painted(end, columns=wide), text, FONT)
    assert reads_as(painted(end, columns=wide + 14), text, FONT)
    assert not reads_as(painted(end, columns=wide + 15), text, FONT), "another letter or two would have fitted"
    assert not reads_as(painted(end[:-1], columns=wide), text, FONT)


def test_of_a_line_that_would_end_at_the_very_edge_the_first_letter_may_be_gone() -> None:
    # The game counts the free column behind the last letter too, so such a line is too long for it.
    text = "/fill 100 200 300 minecraft:stone"
    wide = len(FONT.columns(f"{text}_").rstrip(b"\0"))
    for shown in (text, text[1:]):
        assert reads_as(painted(f"{shown}_", columns=wide), text, FONT)
    assert not reads_as(painted(f"{text[1:]}_", columns=wide + 1), text, FONT), "the whole line would have fitted"
