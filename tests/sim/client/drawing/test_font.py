import numpy as np

from sim.client.drawing.font import drawn_atlas
from tests.sim.client.playing import FONT


def test_every_printable_letter_is_drawn_in_a_shape_of_its_own() -> None:
    shapes = set(FONT.glyphs.values())
    assert len(FONT.glyphs) == len(shapes) == ord("~") - ord("!") + 1


def test_capitals_and_digits_leave_the_lowest_row_free() -> None:
    assert not any(byte >> 7 for char in "ABCXYZ0123456789-.:" for byte in FONT.glyphs[char])


def test_a_letter_lies_in_the_cell_of_its_number() -> None:
    atlas = drawn_atlas()
    row, column = divmod(ord("!"), 16)
    cell = atlas[8 * row : 8 * row + 8, 8 * column : 8 * column + 8, 3]
    assert cell[:, 0].tolist() == [255] * 5 + [0, 255, 0]
    assert not cell[:, 1:].any()


def test_dots_are_white_and_the_others_transparent() -> None:
    atlas = drawn_atlas()
    assert atlas.shape == (128, 128, 4)
    assert (atlas[..., :3] == 255).all()
    assert set(np.unique(atlas[..., 3])) == {0, 255}
