"""Dots of a frame and patterns of columns in them, on pictures made of single dots."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.live.devices import Frame
from mc_nested.live.vision.glyph_grid import GlyphGrid

BAR, CORNER = 0b11111111, 0b00000001
"""Columns of eight dots: all of them, and the uppermost alone."""


def frame_with(columns: bytes, row: int, column: int, scale: int, size: tuple[int, int] = (30, 40)) -> Frame:
    """Return a black frame of so many rows and columns of dots, with these columns of white dots in it."""
    dots = np.zeros(size, np.uint8)
    for right, byte in enumerate(columns):
        for down in range(8):
            dots[row + down, column + right] = 255 * (byte >> down & 1)
    return np.repeat(dots.repeat(scale, 0).repeat(scale, 1)[..., np.newaxis], 3, 2)


@pytest.mark.parametrize("scale", [1, 2, 3, 4])
@pytest.mark.parametrize("position", [(0, 0), (13, 7), (22, 37)])
def test_a_pattern_is_found_only_at_its_position(scale: int, position: tuple[int, int]) -> None:
    pattern = bytes((BAR, CORNER, BAR))
    assert GlyphGrid(frame_with(pattern, *position, scale), scale, 200).find(pattern) == [position]


def test_a_pattern_is_searched_for_only_in_the_rows_of_a_given_pitch() -> None:
    pattern = bytes((BAR, CORNER, BAR))
    for row in (2, 10, 11, 20):
        found = GlyphGrid(frame_with(pattern, row, 5, 2), 2, 200, first=2, pitch=9).find(pattern)
        assert found == ([(row, 5)] if row in (2, 11, 20) else [])


def test_a_pattern_that_stands_twice_is_found_twice() -> None:
    pattern = bytes((BAR, CORNER))
    frame = np.maximum(frame_with(pattern, 1, 3, 1), frame_with(pattern, 12, 38, 1))
    assert GlyphGrid(frame, 1, 200).find(pattern) == [(1, 3), (12, 38)]


def test_a_pattern_is_not_found_across_the_end_of_a_row() -> None:
    pattern = bytes((BAR, CORNER, BAR))
    frame = np.maximum(frame_with(pattern[:2], 3, 38, 1), frame_with(pattern[2:], 4, 0, 1))
    assert GlyphGrid(frame, 1, 200).find(pattern) == []


@pytest.mark.parametrize("pattern", [b"", bytes((BAR,)), bytes((BAR,)) * 2000])
def test_a_pattern_shorter_than_two_columns_or_wider_than_the_frame_is_not_found(pattern: bytes) -> None:
    assert GlyphGrid(frame_with(bytes((BAR,)), 3, 3, 1), 1, 200).find(pattern) == []


def test_ink_is_where_green_is_bright_enough() -> None:
    pattern = bytes((BAR, CORNER))
    frame = frame_with(pattern, 3, 3, 1)
    frame[frame == 255] = 200
    for pitch in (1, 9):
        assert GlyphGrid(frame, 1, 200, 3 % pitch, pitch).find(pattern) == [(3, 3)]
        assert GlyphGrid(frame, 1, 201, 3 % pitch, pitch).find(pattern) == []
    frame[..., (0, 2)] = 0
    assert GlyphGrid(frame, 1, 200).find(pattern) == [(3, 3)]


@pytest.mark.parametrize(
    ("height", "width", "scale", "rows", "columns"),
    [
        (8, 1, 1, 1, 1),
        (7, 5, 1, 0, 5),
        (0, 0, 1, 0, 0),
        (24, 9, 3, 1, 3),
        (23, 8, 3, 1, 3),
        (22, 7, 3, 0, 2),
        (16, 4, 2, 1, 2),
        (15, 3, 2, 0, 1),
        (480, 854, 2, 233, 427),
        (1440, 2560, 8, 173, 320),
    ],
)
def test_a_dot_counts_if_its_middle_pixel_is_in_the_frame(
    height: int, width: int, scale: int, rows: int, columns: int
) -> None:
    grid = GlyphGrid(np.zeros((height, width, 3), np.uint8), scale, 200)
    assert (grid.rows, grid.columns) == (rows, columns)


def test_a_pattern_in_a_row_whose_dots_are_cut_off_is_not_found() -> None:
    # Of the last row of dots the middles are cut off: glyphs begin in rows 0 to 21.
    pattern = bytes((BAR, CORNER))
    cut = frame_with(pattern, 22, 5, 2)[:-1]
    assert GlyphGrid(cut, 2, 200).find(pattern) == []
    assert GlyphGrid(cut, 2, 200, first=4, pitch=9).find(pattern) == []


def test_a_strip_holds_the_middle_pixel_of_each_dot() -> None:
    frame = np.random.default_rng(0).integers(0, 256, (60, 90, 3), np.uint8)
    strip = GlyphGrid(frame, 3, 200).strip(5, 2, 6)
    np.testing.assert_array_equal(strip, frame[16:40:3, 7:19:3])


@given(st.binary(min_size=2, max_size=6), st.integers(1, 3), st.integers(0, 22), st.integers(0, 34))
def test_any_pattern_is_found_at_its_row_and_column(pattern: bytes, scale: int, row: int, column: int) -> None:
    grid = GlyphGrid(frame_with(pattern, row, column, scale), scale, 200)
    assert (row, column) in grid.find(pattern)
    assert (row, column) in GlyphGrid(grid.frame, scale, 200, row % 9, 9).find(pattern)
