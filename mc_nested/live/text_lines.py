"""A line of the debug screen as text, by exact lookup of its glyphs: what matches none is ``UNKNOWN``, never guessed.

Behind each line lies a grey box (FACTS: The F3 debug screen), from one dot left of the text to two right of its last
ink. So within a line a dot is either ink, of the text's colour, or ground: the world dimmed by the box, neither near
black nor near white. Where a column is neither, the line ends, or something lies over it.
"""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame
from mc_nested.live.dots import GLYPH_ROWS, Dots
from mc_nested.live.font import SPACE, Font, Glyph

Colour = tuple[int, int, int]
"""Red, green, blue."""

UNKNOWN = "\N{REPLACEMENT CHARACTER}"

INK_SPREAD = 4
"""How far a channel of the ink may lie from the text's: 221 to 224 were seen for 224 (FACTS: The F3 debug screen)."""

STANDIN_PITCH = 10
"""Dots from line to line in the stand-in, whose boxes end one column earlier (its debug_overlay.js); vanilla has 9."""

_VALUE_COLOURS: tuple[Colour, ...] = ((85, 255, 85), (255, 85, 85))
"""``true`` and ``false`` (FACTS: The F3 debug screen)."""

_DARKEST, _BRIGHTEST = 40, 190
"""Darkest and brightest ground under any box: vanilla's gives 45 to 157, the stand-in's 55 to 183; the rest is for
screens that bend colours."""

_WIDEST_BLANK = 13
"""Blank columns after which a line has ended: three spaces and the gap of one. A hidden digit is 6 columns wide."""

_LONGEST = 480
"""Columns that a line can have: the narrowest screen has 320 (FACTS: The F3 debug screen), no line used many more."""

_BITS = (1 << np.arange(8, dtype=np.uint8))[:, np.newaxis]
_THREE_LETTERS = 24
"""Columns that hold three letters or more in any font."""

_MOSTLY = 288
"""Columns that most lines end in: reading no more of them is faster."""

_FLAT = 2
_LIKE_THE_BOX = 5
"""A world this near to the box's own grey looks the same under it as beside it."""


@dataclass(frozen=True)
class Overlay:
    """How the debug screen is drawn: what holds from frame to frame.

    ``scale`` is the GUI scale, framebuffer pixels a dot; ``pitch`` the dots from line to line (vanilla 9, the stand-in
    10); ``colour`` the text's red, green and blue (vanilla 224 each, 221 to 224 seen; the stand-in 255).
    """

    scale: int
    pitch: int
    colour: Colour


@dataclass(frozen=True)
class Line:
    """A line's text, its row, its first and last column, and whether its box is seen to go on behind that and end.

    Where ``whole`` is False something may lie over the line's end. ``has_value``: it ends in a value's own colour.
    """

    text: str
    row: int
    start: int
    end: int
    whole: bool
    has_value: bool = False


@dataclass(frozen=True)
class _Strip:
    """One line from column ``first`` on: its pixels, and a byte a column of ink and of lying in a box."""

    first: int
    picture: Frame
    ink: bytes
    boxed: bytes


def line_from(dots: Dots, font: Font, overlay: Overlay, row: int, start: int, edge: int | None = None) -> Line:
    """The line whose first glyph stands at column ``start``, read to the right.

    Where text is aligned at a last column ``edge``, and the line is seen to end there, what lies behind is not read.
    """
    line, is_bounded = _line_in(_pixels(dots, row, start, start + _MOSTLY), font, overlay, row, start, edge)
    if not is_bounded:
        line, _ = _line_in(_pixels(dots, row, start, start + _LONGEST), font, overlay, row, start, edge)
    return line


@lru_cache(64)  # most lines look as they did in the picture before
def _line_in(pixels: bytes, font: Font, overlay: Overlay, row: int, start: int, edge: int | None) -> tuple[Line, bool]:
    """The line that begins a picture (8, columns, 3), and whether its box is seen to end in it."""
    strip = _strip_of(_picture(pixels), start, overlay.colour)
    columns = _in_the_box(strip)
    text, last = decode(columns, font)
    if edge is not None and start + last > edge:
        aligned, end = decode(columns[: edge - start + 1], font)
        text, last = (aligned, end) if start + end == edge and UNKNOWN not in aligned else (text, last)
    return Line(text, row, start, start + last, _is_whole(strip, last, overlay)), 0 in strip.boxed


def is_text(dots: Dots, font: Font, overlay: Overlay, row: int, start: int) -> bool:
    """Whether a line begins there, as far as its first three characters say."""
    if not 0 <= row < dots.rows:
        return False
    text, _ = decode(
        _in_the_box(_strip_of(dots.strip(row, start, start + _THREE_LETTERS), start, overlay.colour)), font
    )
    return len(text) > 2 and UNKNOWN not in text[:3]


def line_up_to(dots: Dots, font: Font, overlay: Overlay, row: int, end: int) -> Line | None:
    """The line whose last ink is in column ``end``, back to a wide gap or its box's side; None if no ink is there."""
    if not 0 <= row < dots.rows:
        return None
    first = max(0, end + 1 - _LONGEST)
    return _line_ending_in(_pixels(dots, row, first, end + 4), font, overlay, row, first, end)


@lru_cache(64)
def _line_ending_in(pixels: bytes, font: Font, overlay: Overlay, row: int, first: int, end: int) -> Line | None:
    last = end - first
    picture = _picture(pixels)
    strip = _strip_of(picture, first, overlay.colour)
    has_value = not strip.ink[last]
    if has_value:
        strip = _strip_of(picture, first, overlay.colour, *_VALUE_COLOURS)
    if not strip.ink[last] or any(strip.ink[last + 1 : last + 2]):
        return None
    left = strip.boxed.rfind(0, 0, last + 1) + 1
    gap = strip.ink.rfind(b"\0" * (_WIDEST_BLANK + 1), left, last)
    left, text, stop = gap + _WIDEST_BLANK + 1 if gap >= 0 else left, "", -1
    while stop < last:
        left += len(strip.ink[left:]) - len(strip.ink[left:].lstrip(b"\0"))
        text, width = decode(strip.ink[left : last + 1], font)
        left, start, stop = left + width + 1, left, left + width
    return Line(text, row, strip.first + start, end, _is_whole(strip, last, overlay), has_value)


@lru_cache(1024)  # most lines say what they said in the frame before
def decode(columns: bytes, font: Font) -> tuple[str, int]:
    """The text that begins in the first column, up to a wide gap, and its last column of ink (-1 without any).

    A glyph counts only in the place where the pen, moved by the glyphs and spaces before it, would draw it.
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
    """The glyph with a gap inside whose ink begins at ``at``."""
    for glyph, known in font.gapped.items():
        if columns.startswith(glyph, at) and not any(columns[at + len(glyph) : at + len(glyph) + 1]):
            return known
    return None


def _pixels(dots: Dots, row: int, first: int, last: int) -> bytes:
    return dots.strip(row, first, last).tobytes()


def _picture(pixels: bytes) -> Frame:
    return np.frombuffer(pixels, np.uint8).reshape(GLYPH_ROWS, -1, 3)


def _strip_of(picture: Frame, first: int, *colours: Colour) -> _Strip:
    """A picture (8, columns, 3) that begins at column ``first``, with these colours as ink."""
    ink = ink_of(picture, *colours)
    ground = np.asarray(cv2.inRange(picture, (_DARKEST,) * 3, (_BRIGHTEST,) * 3), np.uint8)
    return _Strip(first, picture, columns_of(ink), np.bitwise_and.reduce(ink | ground, axis=0).tobytes())


def _in_the_box(strip: _Strip) -> bytes:
    """The ink from the first column on, as far as the box goes without a break."""
    end = strip.boxed.find(0)
    return strip.ink if end < 0 else strip.ink[:end]


def ink_of(picture: Frame, *colours: Colour) -> NDArray[np.uint8]:
    """A mask (rows, columns), 255 where a picture has one of these colours, else 0."""
    near = INK_SPREAD
    masks = [
        np.asarray(cv2.inRange(picture, (b - near, g - near, r - near), (b + near, g + near, r + near)), np.uint8)
        for r, g, b in colours
    ]
    return masks[0] if len(masks) == 1 else np.bitwise_or.reduce(masks)


def columns_of(ink: NDArray[np.uint8]) -> bytes:
    """From a mask (8, columns) of 0 and 255 to a byte a column."""
    columns: NDArray[np.uint8] = np.bitwise_or.reduce(ink & _BITS, axis=0)
    return columns.tobytes()


def _is_whole(strip: _Strip, last: int, overlay: Overlay) -> bool:
    """Whether the box is seen to go on behind the last ink, and to end there.

    The box changes every ground but one that is as grey as itself. If its last column and the one beside it are alike
    all the way, something is drawn over both, and may hide more of the line.
    """
    behind, grey = (1, 110) if overlay.pitch == STANDIN_PITCH else (2, 80)
    if 0 in strip.boxed[last + 1 : last + 1 + behind] or any(strip.ink[last + 1 : last + 1 + behind]):
        return False
    sides = strip.picture[:, last + behind : last + behind + 2].astype(np.int16)
    if sides.shape[1] < 2:
        return True
    if np.abs(sides[:, 0] - sides[:, 1]).max() > _FLAT:
        return True
    return bool(np.abs(sides - grey).max() <= _LIKE_THE_BOX)
