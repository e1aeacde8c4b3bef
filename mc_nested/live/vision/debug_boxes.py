"""The debug screen's boxes on a picture of the whole window, without a font, and the world that shines through them.

To 26.3 each line has a box. A line is found by its ink: in the left column it begins at dot 2, in the right one it ends
4 dots from the window's side, and its box goes on two dots behind its last ink. The box's grey is half-transparent, so
it can be undone.

From 26.4 on a box holds lines that stand below each other without a gap. In the left column its ground begins one dot
left of dot 3, in the right one it ends 3 dots from the window's side; its widest line ends, or begins, beside its other
side (FACTS: The F3 debug screen).
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import cv2
import numpy as np

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.fact_lines import VALUES
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, dots_in
from mc_nested.live.vision.layout import BOX_GREY, BOXES, GREEN, PLAIN, RED, TITLE_GREY, VANILLA, WHITE, Colour
from mc_nested.live.vision.text_lines import ink_of

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
    """Return the boxes of the debug screen's lines on a picture of the whole window, in pixels, the upper ones first.

    ``scale`` is the GUI scale. What has exactly the letters' colour beside a line is taken for a part of it. Empty
    where there is no debug screen. Where a line's end isn't seen, as behind a notice, its box ends there.
    """
    dots = np.ascontiguousarray(dots_in(frame, scale))
    is_ink = has_letters(dots)
    may_be_ground = cv2.inRange(dots, (_DARKEST,) * 3, (BRIGHTEST,) * 3) > 0
    boxes = []
    for row in range(_FIRST, dots.shape[0] - GLYPH_ROWS, VANILLA.pitch):
        ink = is_ink[row : row + GLYPH_ROWS]
        in_a_box = np.all(ink | may_be_ground[row : row + GLYPH_ROWS], axis=0)
        rows = row - 1, row - 1 + VANILLA.pitch
        boxes += [_in_pixels(rows, *columns, scale) for columns in _lines_in(np.any(ink, axis=0), in_a_box)]
    return boxes


def has_letters(picture: Frame) -> Bools:
    """Return where a picture (rows, columns, 3) has a colour of the debug screen's letters."""
    return has_colour(picture, PLAIN, GREEN, RED)


def _lines_in(has_ink: Bools, in_a_box: Bools) -> Iterator[tuple[int, int]]:
    """Return the first column of each box in a row of text, and the column behind its last."""
    count = len(has_ink)
    if length := _length(has_ink[_FIRST:], in_a_box[_FIRST:]):
        yield _FIRST - 1, min(count, _FIRST + length + VANILLA.box.behind)
    edge = count - (VANILLA.right_edge or 0)
    if length := _length(has_ink[edge::-1], in_a_box[edge::-1]):
        yield max(0, edge - length), count - 1


def _length(has_ink: Bools, in_a_box: Bools) -> int:
    """Return the columns of a line that begins at the first or second one, going on while there is a box.

    Return 0 if no line begins there.
    """
    outside = np.flatnonzero(~in_a_box)
    ink = np.flatnonzero(has_ink[: outside[0]] if len(outside) else has_ink)
    if not len(ink) or ink[0] not in _BEGINNINGS:
        return 0
    gaps = np.flatnonzero(np.diff(ink) > _WIDEST_GAP + 1)
    length = int(ink[gaps[0]] if len(gaps) else ink[-1]) + 1
    return length if length >= _SHORTEST else 0


_DARKEST_TITLE = 22
"""No title's ground is as dark: it is 27 at least."""

_TOP, _SIDE = 2, 3
"""The first row, and the first column of a box's text."""

_INDENT = 3
"""Columns by which a title begins farther right."""

_FARTHEST = (130, 330)
"""Columns from the window's side within which a left box's line begins, and a right one's ends."""


class GroundPart(NamedTuple):
    """A part of the window, in pixels, on which a ground of one grey lies."""

    region: Region
    grey: int


class _TextRow(NamedTuple):
    """A line: its first row of dots, its first and last column, and whether it is all white, as a title is."""

    row: int
    first: int
    last: int
    is_white: bool


def ground_parts(frame: Frame, scale: int) -> list[GroundPart]:
    """Return the grounds of all boxes, the left column's first; empty where no box has a title.

    ``scale`` is that of the debug screen. What is written beside a line on nothing but such ground is taken for a part
    of it.
    """
    dots = np.ascontiguousarray(dots_in(frame, scale))
    columns = dots.shape[1]
    parts = []
    for picture, is_right in ((dots, False), (np.ascontiguousarray(dots[:, ::-1]), True)):
        for lines in _boxes(list(_lines(picture, _SIDE + is_right, _FARTHEST[is_right]))):
            has_title = _has_title(lines, is_right)
            ends = [line.last for line in lines]
            if is_right and has_title:
                ends[0] += _INDENT
            wide = max(ends) + (1 if is_right else BOXES.box.behind)
            first, end = (columns - 1 - wide, columns - _SIDE + 1) if is_right else (_SIDE - 1, wide + 1)
            parts += [
                GroundPart(_in_pixels(each, first, end, scale), grey) for *each, grey in _grounds(lines, has_title)
            ]
    return parts if any(part.grey == TITLE_GREY for part in parts) else []


def has_colour(picture: Frame, *colours: Colour) -> Bools:
    """Return where a picture (rows, columns, 3) has one of these colours."""
    return np.asarray(ink_of(picture, *colours) > 0)


def _lines(dots: Frame, side: int, farthest: int) -> Iterator[_TextRow]:
    """Return the lines of the column at a picture's left side, beginning between two columns, the upper ones first."""
    ink, white = has_colour(dots, PLAIN, *VALUES), has_colour(dots, WHITE)
    inside = ink | (cv2.inRange(dots, (_DARKEST_TITLE,) * 3, (BRIGHTEST,) * 3) > 0)
    for row in range(_TOP, dots.shape[0] - GLYPH_ROWS, BOXES.pitch):
        rows = slice(row, row + GLYPH_ROWS)
        outside = np.flatnonzero(~inside[rows, side:].all(axis=0))
        has_ink = ink[rows, side : side + int(outside[0]) if len(outside) else None].any(axis=0)
        at = np.flatnonzero(has_ink)
        if not len(at) or at[0] > farthest or ink[rows, side - 1].any():
            continue
        gaps = np.flatnonzero(np.diff(at) > _WIDEST_GAP + 1)
        last = int(at[gaps[0]] if len(gaps) else at[-1])
        if last - at[0] >= _SHORTEST:
            first, end = int(at[0]) + side, last + side
            is_white = bool(white[rows, first : end + 1].sum() == ink[rows, first : end + 1].sum())
            yield _TextRow(row, first, end, is_white)


def _boxes(lines: Sequence[_TextRow]) -> Iterator[list[_TextRow]]:
    """Return the lines of each box: those without a gap between them."""
    box: list[_TextRow] = []
    for line in lines:
        if box and line.row - box[-1].row > BOXES.pitch:
            yield box
            box = []
        box.append(line)
    if box:
        yield box


def _has_title(lines: Sequence[_TextRow], is_right: bool) -> bool:
    """Return whether the first line stands where a title does, in white."""
    title, others = lines[0], lines[1:]
    if not others or not title.is_white:
        return False
    wide = max(line.last for line in others)
    return title.last + _INDENT >= wide if is_right else title.first == _SIDE + _INDENT


def _grounds(lines: Sequence[_TextRow], has_title: bool) -> Iterator[tuple[int, int, int]]:
    """Return the first row of each of a box's grounds, the row behind its last, and its grey."""
    top, end = lines[0].row - 1, lines[-1].row + BOXES.pitch + 1
    if has_title:
        yield top, top + BOXES.pitch, TITLE_GREY
    yield top + BOXES.pitch if has_title else top, end, BOX_GREY


def _in_pixels(rows: Sequence[int], first: int, end: int, scale: int) -> Region:
    top, below = rows
    return Region(max(0, first) * scale, top * scale, (end - max(0, first)) * scale, (below - top) * scale)
