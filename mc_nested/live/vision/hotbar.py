"""The hotbar as a mark of the screen: only in the world, and behind the chat, it has its own colours.

From 1.21.9 on the debug screen's text lies over menus, so that reading it doesn't show that none is open; before, the
hotbar shows it sooner, where it is the game's own. Each menu
changes what is behind it: it dims, blurs or tints it. The frame of the hotbar lets nothing through, so its colours are
known, and the debug screen's lines end above it or cover its left part alone (FACTS: Screens and their buttons).
"""

from typing import Literal

import cv2
import numpy as np

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.text_colours import INK_SPREAD, Colour
from mc_nested.live.vision.typed_line import FIRST_COLUMNS

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

_LEFT = 4
"""GUI pixels from the window's side to the first letter of the line being typed."""

_RED = ((0x50, 0, 0, 0x60), (0x80, 0x30, 0x30, 0xA0))
"""The death screen's red, green, blue and alpha, at the window's upper and lower edge."""


def bottom_region(size: tuple[int, int], scale: int) -> Region:
    """The rows of the hotbar down to the line being typed, from that line's first letter on, in framebuffer pixels.

    ``size`` is the window's width and height, ``scale`` the GUI scale.
    """
    across, down = -(-size[0] // scale), -(-size[1] // scale)
    top = (down - HEIGHT) * scale
    right = (across // 2 + WIDTH // 2) * scale
    return Region(_LEFT * scale, top, right - _LEFT * scale, min((_UNDER_CHAT + 2) * scale, size[1] - top))


def bottom_dots(frame: Frame, scale: int) -> Frame:
    """The dots of a picture of that region: (21, columns, 3)."""
    return frame[scale // 2 :: scale, scale // 2 :: scale]


def typed_dots(dots: Frame) -> Frame:
    """Of these dots those of the first letter that is typed: (9, 8, 3)."""
    return dots[HEIGHT - 12 : HEIGHT - 3, :FIRST_COLUMNS]


def hotbar_look(dots: Frame, height: int) -> HotbarLook | None:
    """How the hotbar looks on dots of ``bottom_region``; None where it isn't seen, or a menu lies over it.

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
    """In how many columns each row has its colour."""
    masks = [
        cv2.inRange(row[np.newaxis], tuple(part - INK_SPREAD for part in colour[::-1]), _up(colour))
        for row, colour in zip(rows, colours, strict=True)
    ]
    return cv2.countNonZero(np.bitwise_and.reduce(masks) if len(masks) > 1 else masks[0])


def _up(colour: Colour) -> Colour:
    red, green, blue = colour
    return blue + INK_SPREAD, green + INK_SPREAD, red + INK_SPREAD


def _tinted(grey: int, down: float) -> Colour:
    """A grey behind the death screen, at a height of 0 to 1 from the window's upper edge."""
    red, green, blue, alpha = (upper + (lower - upper) * down for upper, lower in zip(*_RED, strict=True))
    share = alpha / 255
    first, second, third = (round(grey * (1 - share) + part * share) for part in (red, green, blue))
    return first, second, third
