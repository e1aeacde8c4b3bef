import numpy as np
import pytest

from mc_nested.live.devices import Frame
from sim.client.drawing.layers import draw_all
from sim.client.drawing.letters import Letters, drawn_atlas
from sim.client.game.widgets import WHITE
from tests.sim.client.playing import FONT

SHADOW = (63, 63, 63)


def text_in(frame: Frame, colour: tuple[int, int, int]) -> np.ndarray:
    return np.asarray((frame == colour[::-1]).all(2))


@pytest.mark.parametrize("scale", [1, 3])
def test_a_text_has_its_shadow_one_gui_pixel_to_the_right_and_below(scale: int) -> None:
    frame = np.zeros((20 * scale, 60 * scale, 3), np.uint8)
    text = Letters(FONT, scale).text("Quit", 5, 6, WHITE, shadow=True)
    draw_all(frame, [text], (0, 0, 60 * scale, 20 * scale))
    ink, shadow = text_in(frame, WHITE), text_in(frame, SHADOW)
    moved = np.roll(ink, (scale, scale), (0, 1))
    assert ink.any()
    assert np.array_equal(shadow, moved & ~ink)
    assert np.flatnonzero(ink.any(1))[0] == 6 * scale
    assert np.flatnonzero(ink.any(0))[0] == 5 * scale


def test_a_text_is_as_wide_as_its_letters_with_a_gap_after_each() -> None:
    letters = Letters(FONT, 1)
    assert letters.width("") == 0
    assert letters.width(" ") == 4
    assert letters.width("i") == len(FONT.glyphs["i"]) + 1
    assert letters.width("Quit game") == sum(letters.width(char) for char in "Quit game")


def test_a_character_that_the_font_lacks_is_a_question_mark() -> None:
    letters = Letters(FONT, 1)
    assert letters.width("\u6728") == letters.width("?")
    shown, expected = (letters.text(text, 0, 0, WHITE).dots()[0] for text in ("\u6728", "?"))
    assert np.array_equal(shown, expected)


@pytest.mark.parametrize(("shadow", "rect"), [(False, (6, 9, 6 + 12, 9 + 48)), (True, (6, 9, 6 + 18, 9 + 54))])
def test_a_large_text_covers_twice_the_size_at_its_scale(shadow: bool, rect: tuple[int, int, int, int]) -> None:
    letters = Letters(FONT, 3)
    text = letters.text("!", 2, 3, WHITE, shadow=shadow, size=2)
    assert letters.width("!") == 2
    assert text.rect == rect
    mask, colours = text.dots()
    assert mask.shape == (rect[3] - rect[1], rect[2] - rect[0])
    assert colours.shape == (*mask.shape, 3)


def test_a_texts_colours_are_blue_green_red_and_its_shadow_has_a_quarter_of_them() -> None:
    mask, colours = Letters(FONT, 1).text("!", 0, 0, (200, 101, 7), shadow=True).dots()
    assert colours[0, 0].tolist() == [7, 101, 200]
    assert colours[1, 1].tolist() == [1, 25, 50]
    assert (mask[0, 0], mask[1, 1], mask[0, 1]) == (255, 255, 0)


def test_an_empty_text_has_no_dots() -> None:
    mask, colours = Letters(FONT, 2).text("", 0, 0, WHITE).dots()
    assert mask.size == colours.size == 0


@pytest.mark.parametrize("scale", [1, 2, 3, 4])
def test_a_slanted_text_leans_to_the_right_by_a_quarter_of_its_height(scale: int) -> None:
    letters = Letters(FONT, scale)
    upright, slanted = letters.text("l", 4, 0, WHITE), letters.text("l", 4, 0, WHITE, is_slanted=True)
    assert slanted.rect == (upright.rect[0] - scale, 0, upright.rect[2] + scale, 8 * scale)
    ink, leaning = upright.dots()[0] > 0, slanted.dots()[0] > 0
    for row in range(8 * scale):
        shift = round(scale - 0.25 * (row + 0.5))
        there, now = np.flatnonzero(ink[row]) + scale, np.flatnonzero(leaning[row])
        assert len(now) == len(there)
        assert all(abs(now - there - shift) <= 1)
    assert np.flatnonzero(leaning.any(1)).tolist() == np.flatnonzero(ink.any(1)).tolist()


def test_the_shadow_of_a_slanted_text_is_a_dot_to_the_right_and_below() -> None:
    plain, shadowed = (
        Letters(FONT, 2).text("k", 0, 0, WHITE, shadow=shadow, is_slanted=True) for shadow in (False, True)
    )
    ink, (mask, colours) = plain.dots()[0] > 0, shadowed.dots()
    assert ((colours == 255).all(2) & (mask > 0))[:-2, :-2].tolist() == ink.tolist()
    assert (mask > 0)[2:, 2:][ink].all()


def test_every_printable_letter_is_drawn_in_a_shape_of_its_own() -> None:
    shapes = set(FONT.glyphs.values())
    assert len(FONT.glyphs) == len(shapes) == ord("~") - ord("!") + 1


def test_capitals_and_digits_leave_the_lowest_row_free() -> None:
    assert not any(byte >> 7 for char in "ABCXYZ0123456789-.:" for byte in FONT.glyphs[char])


def test_a_letter_lies_in_the_atlas_cell_of_its_ascii_code() -> None:
    atlas = drawn_atlas()
    row, column = divmod(ord("!"), 16)
    cell = atlas[8 * row : 8 * row + 8, 8 * column : 8 * column + 8, 3]
    assert cell[:, 0].tolist() == [255] * 5 + [0, 255, 0]
    assert not cell[:, 1:].any()


def test_the_atlas_is_white_and_transparent_except_at_its_dots() -> None:
    atlas = drawn_atlas()
    assert atlas.shape == (128, 128, 4)
    assert (atlas[..., :3] == 255).all()
    assert set(np.unique(atlas[..., 3])) == {0, 255}
