"""The hotbar's look, on dots drawn by hand.

The line being typed, on pictures painted for the test: where it stands, whether it is one, what it holds.
"""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.font import font_of
from mc_nested.live.vision.glyph_grid import dots_in
from mc_nested.live.vision.window_bottom import (
    FIRST_COLUMNS,
    HotbarLook,
    begins_a_line,
    bottom_region,
    hotbar_look,
    reads_as,
    typed_dots,
    typed_line_region,
)
from sim.client.drawing.letters import drawn_atlas
from tests.live.vision.menu_painter import MenuPainter

SIZE, GUI_HEIGHT = (854, 480), 240


def dots(black: float = 0, light: float = 0x93, grey: float = 0x7E) -> Frame:
    """Return the bottom of a window at GUI scale 2, noise with a hotbar whose rows have these greys."""
    region = bottom_region(SIZE, 2)
    noise = np.random.default_rng(0).integers(0, 256, (21, region.width // 2, 3)).astype(np.uint8)
    for row, shade in ((0, black), (1, light), (19, grey)):
        noise[row, -182:] = round(shade)
    return noise


def test_the_region_begins_at_the_first_letter_and_ends_with_the_hotbar() -> None:
    region = bottom_region(SIZE, 2)
    assert (region.left, region.left + region.width) == (8, (427 // 2 + 1 + 90) * 2)
    assert (region.top, region.height) == ((240 - 22) * 2, 21 * 2)


def test_a_window_that_cuts_its_last_dot_has_all_21_rows_of_dots() -> None:
    region = bottom_region((1920, 1057), 4)
    frame = np.zeros((region.height, region.width, 3), np.uint8)
    assert region.top + region.height <= 1057
    assert dots_in(frame, 4).shape[0] == 21


@pytest.mark.parametrize(
    ("drawn", "look"),
    [
        (dots(), "clear"),
        (dots(grey=0x7E / 2), "behind the chat"),
        (dots(light=0x93 * 0.95), None),
        (dots(black=10), None),
        (np.zeros((21, 300, 3), np.uint8), None),
        (np.full((21, 300, 3), 0x93, np.uint8), None),
        (dots()[:10], None),
        (dots()[:, :100], None),
    ],
)
def test_the_hotbar_is_clear_only_in_its_own_greys(drawn: Frame, look: HotbarLook | None) -> None:
    assert hotbar_look(drawn, GUI_HEIGHT) == look


@pytest.mark.parametrize(("covered", "look"), [(120, "clear"), (130, None)])
def test_text_may_cover_the_hotbars_left_part(covered: int, look: HotbarLook | None) -> None:
    drawn = dots()
    drawn[:, -182 : -182 + covered] = 109
    assert hotbar_look(drawn, GUI_HEIGHT) == look


def test_a_hotbar_reddened_by_its_height_looks_like_death() -> None:
    drawn = dots()
    for row, grey in ((0, 0), (1, 0x93)):
        down = (GUI_HEIGHT - 22 + row + 0.5) / GUI_HEIGHT
        alpha = (0x60 + (0xA0 - 0x60) * down) / 255
        red, other = 0x50 + (0x80 - 0x50) * down, 0x30 * down
        shades = [grey * (1 - alpha) + part * alpha for part in (other, other, red)]
        drawn[row, -182:] = np.rint(shades)
    assert hotbar_look(drawn, GUI_HEIGHT) == "death"


@given(st.floats(0.0, 0.95), st.integers(0, 40))
def test_a_darkened_hotbar_is_not_clear(share: float, over: int) -> None:
    drawn = dots()
    drawn[:, -182:] = np.rint(drawn[:, -182:] * share + over * (1 - share))
    assert hotbar_look(drawn, GUI_HEIGHT) != "clear"


def test_typed_dots_are_the_first_letter_of_the_typed_line() -> None:
    drawn = np.zeros((21, 300, 3), np.uint8)
    drawn[10, 0] = 224
    assert typed_dots(drawn).shape == (9, 8, 3)
    assert typed_dots(drawn)[0, 0, 0] == 224


FONT = font_of(drawn_atlas())
PLAIN, GOLD = (224, 224, 224), (255, 170, 0)


def painted(text: str, colour: tuple[int, int, int] = PLAIN, columns: int = 100) -> Frame:
    """Return the dots of a typed line, nine rows high, over a dark ground."""
    frame: Frame = np.full((9, columns, 3), 40, np.uint8)
    MenuPainter(frame, 1, FONT, np.random.default_rng(0)).text(text, 0, 0, colour)
    return frame


def test_the_typed_line_stands_12_dots_above_the_lower_edge_and_4_from_either_side() -> None:
    assert typed_line_region((854, 480), 2) == Region(8, 456, 838, 18)
    assert typed_line_region((854, 480), 2, columns=8) == Region(8, 456, 16, 18)


def test_the_typed_lines_place_is_rounded_as_in_the_game_in_a_window_with_a_cut_dot() -> None:
    # 241 rows at scale 2 are 121 dots: the line begins 109 dots down.
    assert typed_line_region((640, 241), 2) == Region(8, 218, 624, 18)


def test_dots_in_takes_the_middle_pixel_of_each_dot() -> None:
    frame = np.zeros((27, 6, 3), np.uint8)
    frame[1, 1] = frame[25, 4] = 9
    dots = dots_in(frame, 3)
    assert dots.shape == (9, 2, 3)
    assert [dots[0, 0, 0], dots[8, 1, 0], int(dots.sum())] == [9, 9, 54]


@pytest.mark.parametrize("colour", [PLAIN, GOLD, (255, 85, 85), (220, 228, 224)])
def test_a_shadowed_letter_of_any_of_its_colours_begins_a_line(colour: tuple[int, int, int]) -> None:
    assert begins_a_line(painted("/tp", colour)[:, :FIRST_COLUMNS], FONT)


def test_letters_of_another_colour_do_not_begin_a_line() -> None:
    assert not begins_a_line(painted("/tp", (224, 224, 170))[:, :FIRST_COLUMNS], FONT)


def test_letters_without_a_shadow_do_not_begin_a_line() -> None:
    dots = painted("/tp")
    dots[(dots == 56).all(2)] = 40
    assert not begins_a_line(dots[:, :FIRST_COLUMNS], FONT)


def test_shadowed_specks_do_not_begin_a_line() -> None:
    dots = np.full((9, FIRST_COLUMNS, 3), 40, np.uint8)
    for row, column in ((1, 1), (3, 1), (5, 3), (6, 5)):
        dots[row, column], dots[row + 1, column + 1] = 224, 56
    assert not begins_a_line(dots, FONT)


def test_an_empty_line_does_not_begin_a_line() -> None:
    assert not begins_a_line(painted("")[:, :FIRST_COLUMNS], FONT)


@pytest.mark.parametrize("shown", ["/tp 1 2 3", "/tp 1 2 3_"])
def test_a_line_reads_as_its_text_with_its_cursor_or_without(shown: str) -> None:
    assert reads_as(painted(shown), "/tp 1 2 3", FONT)


@pytest.mark.parametrize("shown", ["/tp 1 2 34", "/tp 1 2", "tp 1 2 3", "", "/tp 1 2 3        ."])
def test_a_line_does_not_read_as_another_text(shown: str) -> None:
    assert not reads_as(painted(shown), "/tp 1 2 3", FONT)


def test_an_empty_line_reads_as_nothing_typed() -> None:
    assert reads_as(painted(""), "", FONT)
    assert reads_as(painted("_"), "", FONT)
    assert not reads_as(painted("t"), "", FONT)


def test_the_visible_end_of_a_too_long_line_reads_as_the_line() -> None:
    text = "/fill 100 200 300 minecraft:stone"
    end = text[-14:]
    wide = len(FONT.columns(end).rstrip(b"\0"))
    assert reads_as(painted(end, columns=wide), text, FONT)
    assert reads_as(painted(end, columns=wide + 14), text, FONT)
    assert not reads_as(painted(end, columns=wide + 15), text, FONT), "another letter or two would have fitted"
    assert not reads_as(painted(end[:-1], columns=wide), text, FONT)


def test_a_line_that_exactly_fits_may_lack_its_first_letter() -> None:
    # The game counts the free column behind the last letter too, so such a line is too long for it.
    text = "/fill 100 200 300 minecraft:stone"
    wide = len(FONT.columns(f"{text}_").rstrip(b"\0"))
    for shown in (text, text[1:]):
        assert reads_as(painted(f"{shown}_", columns=wide), text, FONT)
    assert not reads_as(painted(f"{text[1:]}_", columns=wide + 1), text, FONT), "the whole line would have fitted"
