"""A line of the debug screen as text, by exact lookup of its glyphs: what matches none is ``UNKNOWN``, never guessed.

Behind each line lies a grey box (FACTS: The F3 debug screen), from one dot left of the text to two right of its last
ink. So within a line a dot is either ink, of the text's colour, or ground: the world dimmed by the box, neither near
black nor near white. Where a column is neither, the line ends, or something lies over it.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import SPACE, Font, Glyph
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid, GridPosition
from mc_nested.live.vision.layout import GREEN, INK_SPREAD, RED, Box, Colour, Overlay

UNKNOWN = "\N{REPLACEMENT CHARACTER}"

_VALUE_COLOURS = (GREEN, RED)
"""``true`` and ``false`` (FACTS: The F3 debug screen)."""

DARKEST, BRIGHTEST = 40, 190
"""Darkest and brightest ground under any box: 45 to 157 in vanilla, 55 to 183 in the stand-in; the rest is slack for
screens that change colours."""

_WIDEST_BLANK = 13
"""Blank columns after which a line has ended: three spaces and the gap of one. A hidden digit is 6 columns wide."""

LONGEST = 480
"""Columns that a line can have: the narrowest screen has 320 (FACTS: The F3 debug screen), and no known line uses many
more."""

LEFT_PART = 4
"""A line that begins in the first part of so many of a screen's width stands in the left column."""

_BITS = (1 << np.arange(8, dtype=np.uint8))[:, np.newaxis]
_THREE_LETTERS = 24
"""Columns that hold three letters or more in any font."""

MOSTLY = 288
"""Columns within which most lines end: reading only these is faster."""

_FLAT = 2
_LIKE_THE_BOX = 5
"""A world that is this near to the box's own grey looks the same beside the box as under it."""


@dataclass(frozen=True)
class Line:
    """A line of a screen, read.

    Attributes:
        text: with ``UNKNOWN`` for what matched no glyph.
        row: of its glyphs' uppermost dots.
        start: its first column.
        end: its last column of ink.
        whole: its box is seen to go on behind its end, and to end there; otherwise something may lie over the rest.
        is_left: it stands in the left column: lines of the right one begin farther right on any screen.
        has_value: it ends in a value's own colour.
    """

    text: str
    row: int
    start: int
    end: int
    whole: bool
    is_left: bool
    has_value: bool = False


class _Strip(NamedTuple):
    """One line: its pixels, and a byte a column of ink and of lying in a box."""

    picture: Frame
    ink: bytes
    boxed: bytes


def positions_of(dots: GlyphGrid, font: Font, text: str) -> list[GridPosition]:
    """Return each row and column at which ``text`` stands."""
    return dots.find(font.columns(text)[:-1])


def line_from(dots: GlyphGrid, font: Font, overlay: Overlay, start: GridPosition, edge: int | None = None) -> Line:
    """Return the line whose first glyph stands at this row and column, read to the right.

    Where text is aligned at a last column ``edge``, and the line is seen to end there, what lies behind is not read.
    """
    left, colour, box = dots.columns // LEFT_PART, overlay.colour, overlay.layout.box
    line, is_bounded = _line_in(pixels_from(dots, start, MOSTLY), font, colour, box, start, left, edge)
    if not is_bounded:
        line, _ = _line_in(pixels_from(dots, start, LONGEST), font, colour, box, start, left, edge)
    return line


@lru_cache(64)  # most lines look as they did in the picture before
def _line_in(
    pixels: bytes, font: Font, colour: Colour, box: Box, start: GridPosition, left: int, edge: int | None
) -> tuple[Line, bool]:
    """Return the line that begins a picture (8, columns, 3), and whether its box is seen to end in it.

    A line of the left column begins before the column ``left``.
    """
    row, first = start
    strip = _strip_of(_picture(pixels), colour)
    columns = up_to_break(strip.ink, strip.boxed)
    text, last = decode(columns, font)
    if edge is not None and first + last > edge:
        aligned, end = decode(columns[: edge - first + 1], font)
        text, last = (aligned, end) if first + end == edge and UNKNOWN not in aligned else (text, last)
    is_whole = _is_whole(strip, last, box)
    return Line(text, row, first, first + last, is_whole, first < left), 0 in strip.boxed


def is_text(dots: GlyphGrid, font: Font, overlay: Overlay, start: GridPosition) -> bool:
    """Return whether a line begins at this row and column, as far as its first three characters say."""
    row, first = start
    if not (0 <= row < dots.rows and 0 <= first < dots.columns):
        return False
    strip = _strip_of(dots.strip(row, first, first + _THREE_LETTERS), overlay.colour)
    text, _ = decode(up_to_break(strip.ink, strip.boxed), font)
    return len(text) > 2 and UNKNOWN not in text[:3]


def line_up_to(dots: GlyphGrid, font: Font, overlay: Overlay, end: GridPosition) -> Line | None:
    """Return the line whose last ink is in this row and column, back to a wide gap or its box's side.

    Return None without ink.
    """
    row, last = end
    if not 0 <= row < dots.rows:
        return None
    first = max(0, last + 1 - LONGEST)
    pixels = pixels_from(dots, (row, first), last + 4 - first)
    left = dots.columns // LEFT_PART
    return _line_ending_in(pixels, font, overlay.colour, overlay.layout.box, (row, first), left, last)


@lru_cache(64)
def _line_ending_in(
    pixels: bytes, font: Font, colour: Colour, box: Box, begin: GridPosition, left: int, end: int
) -> Line | None:
    """Return the line that ends in the column ``end`` of a picture that begins at this row and column."""
    row, first = begin
    last = end - first
    picture = _picture(pixels)
    strip = _strip_of(picture, colour)
    has_value = not strip.ink[last]
    if has_value:
        strip = _strip_of(picture, colour, *_VALUE_COLOURS)
    if not strip.ink[last] or any(strip.ink[last + 1 : last + 2]):
        return None
    at = strip.boxed.rfind(0, 0, last + 1) + 1
    gap = strip.ink.rfind(b"\0" * (_WIDEST_BLANK + 1), at, last)
    at, text, stop = gap + _WIDEST_BLANK + 1 if gap >= 0 else at, "", -1
    while stop < last:
        at += len(strip.ink[at:]) - len(strip.ink[at:].lstrip(b"\0"))
        text, width = decode(strip.ink[at : last + 1], font)
        at, start, stop = at + width + 1, at, at + width
    is_whole = _is_whole(strip, last, box)
    return Line(text, row, first + start, end, is_whole, first + start < left, has_value)


@lru_cache(1024)  # most lines say what they said in the frame before
def decode(columns: bytes, font: Font) -> tuple[str, int]:
    """Return the text that begins in the first column, up to a wide gap, and its last column of ink (-1 without any).

    A glyph counts only where the pen, moved by the glyphs and spaces before it, would draw it.
    """
    lookup = font.lookup
    text, at, pen, end = "", 0, 0, -1
    for run in columns.split(b"\0"):
        if run and at >= pen:  # else it is the right part of a glyph with a gap inside
            if at - pen > _WIDEST_BLANK:
                break
            char, lead, width = lookup.get(run) or _gapped(columns, at, font) or (UNKNOWN, 0, len(run))
            if text and at - pen != lead:
                spaces, rest = divmod(at - pen - lead, SPACE)
                if rest and char == UNKNOWN:
                    break
                char = UNKNOWN + char if rest else " " * spaces + char
            text += char
            end, pen = at + width - 1, at + width + 1
        at += len(run) + 1
    return text, end


def _gapped(columns: bytes, at: int, font: Font) -> Glyph | None:
    """Return the glyph with a gap inside whose ink begins at ``at``."""
    for glyph, known in font.gapped.items():
        if columns.startswith(glyph, at) and not any(columns[at + len(glyph) : at + len(glyph) + 1]):
            return known
    return None


def pixels_from(dots: GlyphGrid, begin: GridPosition, columns: int) -> bytes:
    """Return the eight rows of dots from ``begin`` on, so many columns of them."""
    row, first = begin
    return dots.strip(row, first, first + columns).tobytes()


def _picture(pixels: bytes) -> Frame:
    return np.frombuffer(pixels, np.uint8).reshape(GLYPH_ROWS, -1, 3)


def _strip_of(picture: Frame, *colours: Colour) -> _Strip:
    """Return a picture (8, columns, 3) with these colours as ink."""
    ink = ink_of(picture, *colours)
    ground = np.asarray(cv2.inRange(picture, (DARKEST,) * 3, (BRIGHTEST,) * 3), np.uint8)
    return _Strip(picture, columns_of(ink), np.bitwise_and.reduce(ink | ground, axis=0).tobytes())


def up_to_break(columns: bytes, boxed: bytes) -> bytes:
    """Return the columns from the first one on, as far as the box goes without a break."""
    end = boxed.find(0)
    return columns if end < 0 else columns[:end]


def ink_of(picture: Frame, *colours: Colour) -> NDArray[np.uint8]:
    """Return a mask (rows, columns), 255 where a picture has one of these colours, else 0."""
    near = INK_SPREAD
    masks = [
        np.asarray(cv2.inRange(picture, (b - near, g - near, r - near), (b + near, g + near, r + near)), np.uint8)
        for r, g, b in colours
    ]
    return masks[0] if len(masks) == 1 else np.bitwise_or.reduce(masks)


def columns_of(ink: NDArray[np.uint8]) -> bytes:
    """Turn a mask (8, columns) of 0 and 255 into a byte a column."""
    columns: NDArray[np.uint8] = np.bitwise_or.reduce(ink & _BITS, axis=0)
    return columns.tobytes()


def _is_whole(strip: _Strip, last: int, box: Box) -> bool:
    """Return whether the box is seen to go on behind the last ink, and to end there.

    The box changes every ground but one that is as grey as itself. If its last column and the one beside it are alike
    all the way, something is drawn over both, and may hide more of the line.
    """
    if 0 in strip.boxed[last + 1 : last + 1 + box.behind] or any(strip.ink[last + 1 : last + 1 + box.behind]):
        return False
    first, second = (strip.picture[:, last + box.behind + side : last + box.behind + side + 1] for side in (0, 1))
    if second.size == 0 or cv2.norm(first, second, cv2.NORM_INF) > _FLAT:
        return True
    grey = np.full_like(first, box.grey)
    return max(cv2.norm(side, grey, cv2.NORM_INF) for side in (first, second)) <= _LIKE_THE_BOX
