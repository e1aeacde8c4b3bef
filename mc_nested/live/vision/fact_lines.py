"""A line of the debug screen from 26.4 on: a name, and a value in colours of its own, read as ``name: value``.

The names of a box end in one column, its values begin in another. What is a value is white, what stands between values
is darker, ``true`` and ``false`` are green and red; a title is white, all other lines have the names' colour (FACTS:
The F3 debug screen). A line is taken whole where nothing can have begun to lie over it just behind its last ink: the
ground goes on there as it was, isn't of one colour, or ends with the box; or the same world as under it goes on behind
the box's end. Letters that shine through another box are seen as such.
"""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid, GridPosition
from mc_nested.live.vision.layout import (
    BOX_ALPHA,
    BOX_GREY,
    GLUE,
    PURE_GREEN,
    PURE_RED,
    TITLE_GREY,
    WHITE,
    Colour,
    Overlay,
)
from mc_nested.live.vision.text_lines import (
    BRIGHTEST,
    DARKEST,
    LEFT_PART,
    LONGEST,
    MOSTLY,
    UNKNOWN,
    Line,
    columns_of,
    decode,
    ink_of,
    pixels_from,
    up_to_break,
)

VALUES = (WHITE, GLUE, PURE_GREEN, PURE_RED)
"""The colours of values, and of titles."""

_GAP = 5
"""Columns from where the names end, before their colon, to where the values begin."""

_BEHIND = 2
"""Columns of ground behind the last ink of a box's widest row."""

_DARKEST = 22
"""Of the ground under a title, which is 27 at least."""

_SOME = 3
"""Rows in which ground of one colour that began to lie over a line would hardly be like the ground beside it."""

_COVERED = tuple(round(255 + (grey - 255) * BOX_ALPHA) for grey in (BOX_GREY, TITLE_GREY))
"""What the white of a value is like under another box, or its title."""

_FLAT = 2
"""Levels by which ground of one colour may vary, or differ from the column beside it where it goes on."""


def fact_from(dots: GlyphGrid, font: Font, overlay: Overlay, start: GridPosition, end: int | None = None) -> Line:
    """Return the line whose first ink is in this row and column, read to the right.

    What stands behind column ``end`` is left out.
    """
    left, colour = dots.columns // LEFT_PART, overlay.colour
    line, is_bounded = _fact_in(pixels_from(dots, start, MOSTLY), font, colour, start, left, end)
    if not is_bounded:
        line, _ = _fact_in(pixels_from(dots, start, LONGEST), font, colour, start, left, end)
    return line


@lru_cache(64)  # most lines look as they did in the picture before
def _fact_in(
    pixels: bytes, font: Font, colour: Colour, start: GridPosition, left: int, end: int | None = None
) -> tuple[Line, bool]:
    """Return the line that begins a picture (8, columns, 3), and whether its box is seen to end in it.

    ``colour`` is that of the names. A line of the left column begins before the column ``left``. Ink behind the column
    ``end`` isn't read.
    """
    row, first = start
    read = None if end is None else end - first + 1
    picture = np.frombuffer(pixels, np.uint8).reshape(GLYPH_ROWS, -1, 3)
    names, values = ink_of(picture, colour), ink_of(picture, *VALUES)
    ink = names | values
    darkest = _DARKEST if values[:, :1].any() else DARKEST
    ground = np.asarray(cv2.inRange(picture, (darkest,) * 3, (BRIGHTEST,) * 3), np.uint8)
    boxed = np.bitwise_and.reduce(ink | ground, axis=0).tobytes()
    name_columns, value_columns = columns_of(names)[:read], columns_of(values)[:read]
    at = len(value_columns) - len(value_columns.lstrip(b"\0"))
    name, last = decode(up_to_break(name_columns[:at], boxed), font)
    text = name
    if at < len(boxed_values := up_to_break(value_columns, boxed)):
        text, last = _with_value(name, at, boxed_values, font, last)
        if any(name_columns[at : last + 1]):  # something else is written over it
            text = name + UNKNOWN
    is_whole = _is_whole(picture, columns_of(ink), ground > 0, boxed, last)
    is_whole = is_whole and not _shines_through(picture[:, last + 2 : last + 4], font)
    return Line(text, row, first, first + last, is_whole, first < left, last >= at), 0 in boxed


def _with_value(name: str, at: int, columns: bytes, font: Font, last: int) -> tuple[str, int]:
    """Return a name with the value whose ink begins in the column ``at``, or a title, which begins the picture."""
    if not name:
        return decode(columns, font)
    pen = len(font.columns(name[:-1])) + _GAP if name.endswith(":") and UNKNOWN not in name else -1
    if not 0 <= pen <= at:
        return name + UNKNOWN, last
    value, end = decode(columns[pen:], font)
    is_aligned = value and value[0] in font.glyphs and at - pen == _lead(font, value[0])
    return (f"{name} {value}", pen + end) if is_aligned else (name + UNKNOWN, last)


def _lead(font: Font, char: str) -> int:
    columns = font.glyphs[char]
    return len(columns) - len(columns.lstrip(b"\0"))


def _is_whole(picture: Frame, ink: bytes, ground: Bools, boxed: bytes, last: int) -> bool:
    """Return whether nothing can lie over what would stand behind the column ``last``."""
    behind = slice(last + 1, last + 1 + _BEHIND)
    if last < 0 or 0 in boxed[behind] or any(ink[behind]) or len(boxed) < last + 1 + _BEHIND:
        return False
    before, one, two = (picture[:, last + step].astype(np.int16) for step in (0, 1, 2))
    if _goes_on(before[ground[:, last]], one[ground[:, last]]) and _goes_on(one, two):
        return True
    if _ends_in_same_world(picture[:, last + 2 :]):
        return True
    three = picture[:, last + 3 : last + 4]
    is_flat = np.ptp(two, axis=0).max() <= _FLAT
    return not is_flat or not three.size or int(np.abs(two - three[:, 0]).max()) > _FLAT


def _shines_through(behind: Frame, font: Font) -> bool:
    """Return whether a letter under another box begins in a part (8, 2, 3), where a value's next letter would be."""
    for level in _COVERED:
        is_covered = np.abs(behind.astype(np.int16) - level).max(2, initial=0) <= _FLAT
        seen = columns_of(np.where(is_covered, 255, 0).astype(np.uint8))
        if any(seen) and any((glyph + b"\0")[:2] == seen for glyph in font.glyphs.values()):
            return True
    return False


def _ends_in_same_world(behind: Frame) -> bool:
    """Return whether a part (8, columns, 3) begins as ground of one colour, and ends in the world seen through it."""
    columns = behind.astype(np.float64)
    is_other = np.abs(columns - columns[:, :1]).max((0, 2), initial=0) > _FLAT
    if not is_other.any():
        return False
    world = columns[:, is_other.argmax()]
    return float(np.abs(world + (BOX_GREY - world) * BOX_ALPHA - columns[:, 0]).max()) <= _FLAT


def _goes_on(one: NDArray[np.int16], other: NDArray[np.int16]) -> bool:
    """Return whether one column of ground (rows, 3) goes on in the next, in some of its rows."""
    alike = np.abs(one - other).max(1, initial=0) <= _FLAT
    return int(np.count_nonzero(alike)) >= min(_SOME, len(one))
