"""26.4's boxes on a picture of the whole window, without a font: where they lie, and how grey each part of them is.

A box's lines stand below each other without a gap. In the left column its ground begins one dot left of dot 3, in the
right one it ends 3 dots from the window's side; its widest line ends, or begins, beside its other side
(FACTS: The F3 debug screen).
"""

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import cv2
import numpy as np

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.facts import VALUES
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS
from mc_nested.live.vision.layout import BOXES
from mc_nested.live.vision.text_colours import INK_SPREAD, PLAIN, WHITE, Colour

FACTS_GREY, TITLE_GREY = 80, 48
"""Of the ground of facts and lines, and of a title's, before the world shines through."""

_DARKEST, _BRIGHTEST = 22, 175
"""No ground is as dark or as bright: a title's is 27 at least, all are 157 at most."""

_TOP, _SIDE = 2, 3
"""The first row, and the first column of a box's text."""

_INDENT = 3
"""Columns by which a title begins farther right."""

_SHORTEST, _WIDEST_GAP = 8, 13
"""Columns of a line, and of a gap in it."""

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
    """The grounds of all boxes, the left column's first; empty where no box has a title.

    ``scale`` is that of the debug screen. What is written beside a line on nothing but such ground is taken for a part
    of it.
    """
    dots = np.ascontiguousarray(frame[scale // 2 :: scale, scale // 2 :: scale])
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
    """Where a picture (rows, columns, 3) has one of these colours."""
    spread = INK_SPREAD
    masks = [
        cv2.inRange(picture, (b - spread, g - spread, r - spread), (b + spread, g + spread, r + spread))
        for r, g, b in colours
    ]
    return np.asarray(np.bitwise_or.reduce(masks) > 0)


def _lines(dots: Frame, side: int, farthest: int) -> Iterator[_TextRow]:
    """The lines of the column at a picture's left side, beginning between two columns, the upper ones first."""
    ink, white = has_colour(dots, PLAIN, *VALUES), has_colour(dots, WHITE)
    inside = ink | (cv2.inRange(dots, (_DARKEST,) * 3, (_BRIGHTEST,) * 3) > 0)
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
    """The lines of each box: those without a gap between them."""
    box: list[_TextRow] = []
    for line in lines:
        if box and line.row - box[-1].row > BOXES.pitch:
            yield box
            box = []
        box.append(line)
    if box:
        yield box


def _has_title(lines: Sequence[_TextRow], is_right: bool) -> bool:
    """Whether the first line stands where a title does, in white."""
    title, others = lines[0], lines[1:]
    if not others or not title.is_white:
        return False
    wide = max(line.last for line in others)
    return title.last + _INDENT >= wide if is_right else title.first == _SIDE + _INDENT


def _grounds(lines: Sequence[_TextRow], has_title: bool) -> Iterator[tuple[int, int, int]]:
    """From which row to before which a box's grounds lie, and how grey."""
    top, end = lines[0].row - 1, lines[-1].row + BOXES.pitch + 1
    if has_title:
        yield top, top + BOXES.pitch, TITLE_GREY
    yield top + BOXES.pitch if has_title else top, end, FACTS_GREY


def _in_pixels(rows: Sequence[int], first: int, end: int, scale: int) -> Region:
    top, below = rows
    return Region(max(0, first) * scale, top * scale, (end - max(0, first)) * scale, (below - top) * scale)
