"""Read the bottom of the window: the hotbar, and the line that is being typed into the chat.

The hotbar is a mark of the screen: only in the world, and behind the chat, it has its own colours. From 1.21.9 on the
debug screen's text lies over menus, so that reading it doesn't show that none is open; before, the hotbar shows it
sooner, where it is the game's own. Each menu changes what is behind it: it dims, blurs or tints it. The frame of the
hotbar lets nothing through, so its colours are known, and the debug screen's lines end above it or cover its left part
alone (FACTS: Screens and their buttons).
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Literal

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, dots_of
from mc_nested.live.vision.layout import AQUA, GOLD, GREEN, GREY, INK_SPREAD, LIGHT_PURPLE, PLAIN, RED, YELLOW, Colour
from mc_nested.live.vision.text_lines import ink_of

FIRST_COLUMNS = 8
"""Columns of dots that hold the first character of a line, most being five wide, and its shadow."""

_LEFT, _ABOVE_EDGE = 4, 12
"""Dots from the window's left side, and from its lower edge up to the line's top (FACTS: Screens and their buttons)."""

_COLOURS = (PLAIN, GREY, AQUA, YELLOW, GREEN, LIGHT_PURPLE, GOLD, RED)
"""What is typed is plain, and from 1.13 on the parts of a command are coloured. As many as a byte has bits."""


_GREY_BIT = 1 << _COLOURS.index(GREY)


def _near(colours: Sequence[Colour]) -> NDArray[np.uint8]:
    """Return for a pixel's blue, green and red, by their values (3, 256), bit n where it is near that of colour n."""
    values = np.arange(256)[:, np.newaxis, np.newaxis]
    is_near = np.abs(values - np.array(colours)[:, ::-1].T) <= INK_SPREAD
    return np.asarray(np.packbits(is_near, axis=2, bitorder="little")[..., 0].T, np.uint8)


_LETTER = _near(_COLOURS)
_SHADOW = _near([(red >> 2, green >> 2, blue >> 2) for red, green, blue in _COLOURS])

_GROUND = 150
"""Brighter than anything behind the line, which is half black; some channel of any text is brighter still."""

_SLANTS = ((1, 1, 0, 0, 0, 0, -1, -1), (1, 0, 0, 0, 0, -1, -1, -1))
"""How many dots to the right each row of a slanted letter stands, from the top: in the middles of dots of odd sizes and
of six or eight pixels, and just beyond them in dots of two or four (FACTS: The chat's line)."""

_LEAST_INK = 3

_LEFT_FREE = 14
"""Columns that a line which is too long may leave free: those of the two widest letters."""


def typed_line_region(size: tuple[int, int], scale: int, columns: int | None = None) -> Region:
    """Return where the line stands in a window (width, height), with a row of dots below it for its shadow: nine rows.

    From its first letter on: so many ``columns`` of dots, or all of them.
    """
    width, height = size
    top, left = (-(-height // scale) - _ABOVE_EDGE) * scale, _LEFT * scale
    right = width - left if columns is None else left + columns * scale
    return Region(left, top, right - left, min((GLYPH_ROWS + 1) * scale, height - top))


def begins_a_line(dots: Frame, font: Font) -> bool:
    """Return whether these dots, ``FIRST_COLUMNS`` in a row, show a shadowed letter of what is typed, or of a draft.

    A draft is what was typed before and not sent, grey and slanted: the letter beside may lean into the gap.
    """
    near = _colours_near(dots, _LETTER)
    ink, below = near[:-1, :-1], near[1:, 1:]
    lit = ink > 0
    if np.count_nonzero(lit) < _LEAST_INK:
        return False
    casts = ink & _colours_near(dots[1:, 1:], _SHADOW)
    if not (casts | below)[lit].all():
        return False
    columns, grey = (
        np.packbits(dots[:GLYPH_ROWS], axis=0, bitorder="little").tobytes() for dots in (lit, ink & _GREY_BIT > 0)
    )
    if any(columns.startswith(glyph + b"\0") for glyph in font.glyphs.values()):
        return True
    return any(grey) and any(grey.startswith(letter) for letter in _slanted(font))


@lru_cache(2)
def _slanted(font: Font) -> frozenset[bytes]:
    """Return the font's letters slanted, without what leans out of their own columns."""
    letters = set()
    for glyph in font.glyphs.values():
        dots = dots_of(glyph)
        for slant in _SLANTS:
            room = np.pad(dots, ((0, 0), (1, 1)))
            leant = np.stack([np.roll(row, right) for row, right in zip(room, slant, strict=True)])[:, 1:-1]
            letters.add(np.packbits(leant, axis=0, bitorder="little").tobytes())
    return frozenset(letters)


def _colours_near(dots: Frame, near: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Return for each dot (rows, columns) bit n where it is near colour n."""
    blue, green, red = near
    return np.asarray(blue[dots[..., 0]] & green[dots[..., 1]] & red[dots[..., 2]])


def reads_as(dots: Frame, text: str, font: Font) -> bool:
    """Return whether these dots, the whole line's, show exactly that text, and nothing behind it but the cursor."""
    ink = cv2.inRange(dots[:GLYPH_ROWS], (0, 0, 0), (_GROUND,) * 3) == 0
    seen = np.packbits(ink, axis=0, bitorder="little").tobytes()
    for line in (f"{text}_", text):
        for shown in _ends(line, len(seen), font):
            if seen.startswith(shown) and not any(seen[len(shown) :]):
                return True
    return False


def _ends(line: str, room: int, font: Font) -> Iterator[bytes]:
    """Return the columns of a line.

    Of a line that is too long for so many, return those of each end that about fill them.

    The game shows the end of such a line, and leaves room for a letter or two. It counts the free column behind the
    last letter, so a line that would end at the very edge may be shown whole or as its end.
    """
    for first in range(max(1, len(line))):
        columns = font.columns(line[first:]).rstrip(b"\0")
        if len(columns) <= room:
            if first and len(columns) < room - _LEFT_FREE:
                return
            yield columns
            if not first and len(columns) < room:
                return


HotbarLook = Literal["clear", "behind the chat", "death"]
"""As in the world; with the line being typed over its lower part; tinted red, as behind the death screen."""

WIDTH, HEIGHT = 182, 22
"""GUI pixels of the hotbar, at the window's lower edge."""

_TOP, _BELOW_TOP, _UNDER_CHAT = 0, 1, 19
"""Rows from its top: its black edge, the grey one below, and one that the line being typed lies over."""

_BLACK, _LIGHT, _GREY = 0, 0x93, 0x7E
"""The greys of these rows."""

_LEAST = 60
"""Columns that must look so: three slots. The chosen slot's frame and the debug screen may cover the others."""

_LEAST_UNDER_CHAT = 40
"""The same in the lowest row, which has specks, and counts of items."""

_RED = ((0x50, 0, 0, 0x60), (0x80, 0x30, 0x30, 0xA0))
"""The death screen's red, green, blue and alpha, at the window's upper and lower edge."""


def bottom_region(size: tuple[int, int], scale: int) -> Region:
    """Return the rows from the hotbar to the line being typed, from that line's first letter on, in framebuffer pixels.

    They are 21 rows of dots.
    ``size`` is the window's width and height, ``scale`` the GUI scale.
    """
    across, down = -(-size[0] // scale), -(-size[1] // scale)
    top = (down - HEIGHT) * scale
    right = (across // 2 + WIDTH // 2) * scale
    return Region(_LEFT * scale, top, right - _LEFT * scale, min((_UNDER_CHAT + 2) * scale, size[1] - top))


def typed_dots(dots: Frame) -> Frame:
    """Return those of the dots that are the first typed letter's: (9, 8, 3)."""
    return dots[HEIGHT - 12 : HEIGHT - 3, :FIRST_COLUMNS]


def hotbar_look(dots: Frame, height: int) -> HotbarLook | None:
    """Return how the hotbar looks on dots of ``bottom_region``; None where it isn't seen, or a menu lies over it.

    ``height`` is the window's, in GUI pixels.
    """
    if dots.shape[0] <= _UNDER_CHAT or dots.shape[1] < WIDTH:
        return None
    bar = dots[:, -WIDTH:]
    if _alike(bar[_TOP : _BELOW_TOP + 1], (_BLACK,) * 3, (_LIGHT,) * 3) >= _LEAST:
        under = bar[_UNDER_CHAT : _UNDER_CHAT + 1]
        return "clear" if _alike(under, (_GREY,) * 3) >= _LEAST_UNDER_CHAT else "behind the chat"
    rows = ((_TOP, _BLACK), (_BELOW_TOP, _LIGHT))
    tinted = (_tinted(grey, (height - HEIGHT + row + 0.5) / height) for row, grey in rows)
    return "death" if _alike(bar[_TOP : _BELOW_TOP + 1], *tinted) >= _LEAST else None


def _alike(rows: Frame, *colours: Colour) -> int:
    """Return in how many columns each row has its colour."""
    masks = [ink_of(row[np.newaxis], colour) for row, colour in zip(rows, colours, strict=True)]
    return cv2.countNonZero(np.bitwise_and.reduce(masks) if len(masks) > 1 else masks[0])


def _tinted(grey: int, down: float) -> Colour:
    """Return a grey behind the death screen, at a height of 0 to 1 from the window's upper edge."""
    red, green, blue, alpha = (upper + (lower - upper) * down for upper, lower in zip(*_RED, strict=True))
    share = alpha / 255
    first, second, third = (round(grey * (1 - share) + part * share) for part in (red, green, blue))
    return first, second, third
