"""The debug screen's lines as boxes, and the world behind them: their grey is half-transparent, so it can be undone.

A line is found by its ink, without a font: in the left column it begins at dot 2, in the right one it ends 4 dots from
the window's side, and its box goes on two dots behind its last ink (FACTS: The F3 debug screen).
"""

from collections.abc import Iterator

import cv2
import numpy as np

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS
from mc_nested.live.vision.layout import VANILLA
from mc_nested.live.vision.text_colours import GREEN, INK_SPREAD, PLAIN, RED, Colour

ALPHA = 0x90 / 255
"""How much of a box's grey is over the world: 0x90 of 0xFF (FACTS: The F3 debug screen)."""

GREY = 80
"""Of a box, before the world shines through: 0x50."""

BRIGHTEST = 175
"""No ground under a box is as bright: it is 157 at most; no ink is as dark in all its channels."""

_DARKEST = 40
"""No ground under a box is as dark: it is 45 at least."""

_FIRST = 2
"""Row and column of the left column's first dot."""

_SHORTEST = 8
"""Columns that every line has: what is shorter is the world's."""

_BEGINNINGS = (0, 1, 4, 5)
"""Columns before a line's first ink: none, or one in some fonts, or a space."""

_WIDEST_GAP = 13
"""Blank columns within a line: three spaces and the gap of one (text_lines.py)."""


def line_boxes(frame: Frame, scale: int) -> list[Region]:
    """The boxes of the debug screen's lines on a picture of the whole window, in pixels, the upper ones first.

    ``scale`` is the GUI scale. What has exactly the letters' colour beside a line is taken for a part of it. Empty
    where there is no debug screen. Where a line's end isn't seen, as behind a notice, its box ends there.
    """
    dots = np.ascontiguousarray(frame[scale // 2 :: scale, scale // 2 :: scale])
    is_ink = ink_of(dots)
    may_be_ground = cv2.inRange(dots, (_DARKEST,) * 3, (BRIGHTEST,) * 3) > 0
    boxes = []
    for row in range(_FIRST, dots.shape[0] - GLYPH_ROWS, VANILLA.pitch):
        ink = is_ink[row : row + GLYPH_ROWS]
        in_a_box = np.all(ink | may_be_ground[row : row + GLYPH_ROWS], axis=0)
        boxes += [_in_pixels(row, columns, scale) for columns in _lines_in(np.any(ink, axis=0), in_a_box)]
    return boxes


def ink_of(picture: Frame) -> Bools:
    """Where a picture (rows, columns, 3) has a colour of the debug screen's letters."""
    found: Bools = np.any([_has_colour(picture, colour) for colour in (PLAIN, GREEN, RED)], axis=0)
    return found


def _has_colour(picture: Frame, colour: Colour) -> Bools:
    least, most = (tuple(part + spread for part in colour[::-1]) for spread in (-INK_SPREAD, INK_SPREAD))
    return np.asarray(cv2.inRange(picture, least, most) > 0)


def _in_pixels(row: int, columns: tuple[int, int], scale: int) -> Region:
    first, end = columns
    return Region(first * scale, (row - 1) * scale, (end - first) * scale, VANILLA.pitch * scale)


def _lines_in(has_ink: Bools, in_a_box: Bools) -> Iterator[tuple[int, int]]:
    """The first column of each box in a row of text, and the column behind its last."""
    count = len(has_ink)
    if length := _length(has_ink[_FIRST:], in_a_box[_FIRST:]):
        yield _FIRST - 1, min(count, _FIRST + length + VANILLA.box.behind)
    edge = count - (VANILLA.right_edge or 0)
    if length := _length(has_ink[edge::-1], in_a_box[edge::-1]):
        yield max(0, edge - length), count - 1


def _length(has_ink: Bools, in_a_box: Bools) -> int:
    """The columns of a line that begins at the first or second one, going on while there is a box; 0 if none does."""
    outside = np.flatnonzero(~in_a_box)
    ink = np.flatnonzero(has_ink[: outside[0]] if len(outside) else has_ink)
    if not len(ink) or ink[0] not in _BEGINNINGS:
        return 0
    gaps = np.flatnonzero(np.diff(ink) > _WIDEST_GAP + 1)
    length = int(ink[gaps[0]] if len(gaps) else ink[-1]) + 1
    return length if length >= _SHORTEST else 0
