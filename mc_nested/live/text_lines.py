"""A line of the debug screen as text, by exact lookup of its glyphs: what matches none is ``UNKNOWN``, never guessed.

Behind each line lies a grey box (FACTS: The F3 debug screen), from one dot left of the text to two right of its last
ink. So within a line a dot is either ink, of the text's colour, or ground: the world dimmed by the box, neither near
black nor near white. Where a column is neither, the line ends, or something lies over it.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame
from mc_nested.live.dots import Dots
from mc_nested.live.font import SPACE, Font

UNKNOWN = "\N{REPLACEMENT CHARACTER}"

INK_SPREAD = 4
"""How far a channel of the ink may lie from the text's: 221 to 224 were seen for 224 (FACTS: The F3 debug screen)."""

STANDIN_PITCH = 10
"""Dots from line to line in the stand-in, whose boxes end one column earlier (its debug_overlay.js); vanilla has 9."""

_DARKEST, _BRIGHTEST = 40, 190
"""Darkest and brightest ground under any box: vanilla's gives 45 to 157, the stand-in's 55 to 183; the rest is for
screens that bend colours."""

_WIDEST_BLANK = 13
"""Blank columns after which a line has ended: three spaces and the gap of one. A hidden digit is 6 columns wide."""

_LONGEST = 480
"""Columns that a line can have: the narrowest screen has 320 (FACTS: The F3 debug screen), no line used many more."""

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
    colour: tuple[int, int, int]


@dataclass(frozen=True)
class Line:
    """A line's text, its row, its first and last column, and whether its box is seen to go on behind that and end.

    Where ``whole`` is False something may lie over the line's end.
    """

    text: str
    row: int
    start: int
    end: int
    whole: bool


@dataclass(frozen=True)
class _Strip:
    """One line from column ``first`` on: the colours, the ink as a byte a column, and which columns lie in a box."""

    first: int
    colours: Frame
    ink: bytes
    boxed: NDArray[np.bool_]


def line_from(dots: Dots, font: Font, overlay: Overlay, row: int, start: int, edge: int | None = None) -> Line:
    """The line whose first glyph stands at column ``start``, read to the right.

    Where text is aligned at a last column ``edge``, and the line is seen to end there, what lies behind is not read.
    """
    strip = _strip(dots, overlay, row, start, start + _LONGEST)
    columns = strip.ink[: _run(strip.boxed)]
    text, last = decode(columns, font)
    if edge is not None and start + last != edge:
        aligned, end = decode(columns[: edge - start + 1], font)
        text, last = (aligned, end) if start + end == edge and UNKNOWN not in aligned else (text, last)
    return Line(text, row, start, start + last, _is_whole(strip, last, overlay))


def line_up_to(dots: Dots, font: Font, overlay: Overlay, row: int, end: int) -> Line | None:
    """The line whose last ink is in column ``end``, back to a wide gap or its box's side; None if no ink is there."""
    if not 0 <= row < dots.codes.shape[0]:
        return None
    strip = _strip(dots, overlay, row, max(0, end + 1 - _LONGEST), end + 4)
    last = end - strip.first
    if not strip.ink[last] or any(strip.ink[last + 1 : last + 2]):
        return None
    left = last + 1 - _run(strip.boxed[last::-1])
    gap = strip.ink.rfind(b"\0" * (_WIDEST_BLANK + 1), left, last)
    left, text, stop = gap + _WIDEST_BLANK + 1 if gap >= 0 else left, "", -1
    while stop < last:
        left += _blank(strip.ink[left:])
        text, width = decode(strip.ink[left : last + 1], font)
        left, start, stop = left + width + 1, left, left + width
    return Line(text, row, strip.first + start, end, _is_whole(strip, last, overlay))


def decode(columns: bytes, font: Font) -> tuple[str, int]:
    """The text that begins in the first column, up to a wide gap, and its last column of ink (-1 without any).

    A glyph counts only in the place where the pen, moved by the glyphs and spaces before it, would draw it.
    """
    text, pen, end = "", 0, -1
    while (inked := pen + _blank(columns[pen:])) < len(columns):
        if inked - pen > _WIDEST_BLANK:
            break
        char, lead, width = _glyph(columns, inked, font)
        spaces, rest = divmod(inked - pen - lead, SPACE) if text else (0, 0)
        if rest and char == UNKNOWN:
            break
        text += UNKNOWN + char if rest else " " * spaces + char
        end, pen = inked + width - 1, inked + width + 1
    return text, end


def _blank(columns: bytes) -> int:
    """How many columns are blank before the first ink."""
    return len(columns) - len(columns.lstrip(b"\0"))


def _glyph(columns: bytes, at: int, font: Font) -> tuple[str, int, int]:
    """The character whose ink begins at ``at``, its blank columns on the left, and how many columns of ink it has."""
    for width in font.lengths:
        known = font.lookup.get(columns[at : at + width])
        if known and not any(columns[at + width : at + width + 1]):
            return known[0], known[1], min(width, len(columns) - at)
    gap = columns.find(b"\0", at)
    return UNKNOWN, 0, (gap if gap >= 0 else len(columns)) - at


def _strip(dots: Dots, overlay: Overlay, row: int, first: int, last: int) -> _Strip:
    colours = dots.strip(row, first, last)
    red, green, blue = overlay.colour
    near = INK_SPREAD
    ink = cv2.inRange(colours, (blue - near, green - near, red - near), (blue + near, green + near, red + near))
    ground = cv2.inRange(colours, (_DARKEST,) * 3, (_BRIGHTEST,) * 3)
    bits = np.packbits(np.asarray(ink), axis=0, bitorder="little")[0]
    return _Strip(first, colours, bits.tobytes(), np.asarray(cv2.bitwise_or(ink, ground).all(0)))


def _run(boxed: NDArray[np.bool_]) -> int:
    """How many columns from the first on lie in the box without a break."""
    outside = np.flatnonzero(~boxed)
    return int(outside[0]) if outside.size else len(boxed)


def _is_whole(strip: _Strip, last: int, overlay: Overlay) -> bool:
    """Whether the box is seen to go on behind the last ink, and to end there.

    The box changes every ground but one that is as grey as itself. If its last column and the one beside it are alike
    all the way, something is drawn over both, and may hide more of the line.
    """
    behind, grey = (1, 110) if overlay.pitch == STANDIN_PITCH else (2, 80)
    if not strip.boxed[last + 1 : last + 1 + behind].all():
        return False
    sides = strip.colours[:, last + behind : last + behind + 2].astype(np.int16)
    if sides.shape[1] < 2:
        return True
    alike = (np.abs(sides[:, 0] - sides[:, 1]) <= _FLAT).all()
    return bool(not alike or (np.abs(sides - grey) <= _LIKE_THE_BOX).all())
