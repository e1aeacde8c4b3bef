"""The words of a pause without a menu, by F3+Esc: the world stays bright (FACTS: Screens and their buttons)."""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS
from mc_nested.live.vision.text_colours import INK_SPREAD, WHITE

WORDS = ("Game Paused", "Game paused")
"""From 1.18 on, and before."""

_TOP = 10
"""GUI pixels from the window's upper edge to the words, which stand in its middle."""

_ROOM = 80
"""GUI pixels that hold the words in any font."""

_MOSTLY = 0.6
"""The part of the words' columns that must be seen: the debug screen's lines may cover the others."""

_FEW = 20
"""White dots that are fewer than those of the words."""


def pause_region(size: tuple[int, int], scale: int) -> Region:
    """Where the words would stand in a window (width, height), in framebuffer pixels at that GUI scale."""
    left = max(0, -(-size[0] // scale) // 2 - _ROOM // 2)
    return Region(left * scale, _TOP * scale, _ROOM * scale, GLYPH_ROWS * scale)


def shows_pause(frame: Frame, scale: int, font: Font) -> bool:
    """Whether a picture of that region shows the words, or most of them."""
    dots = np.ascontiguousarray(frame[scale // 2 :: scale, scale // 2 :: scale])
    least = min(WHITE) - INK_SPREAD
    white = cv2.inRange(dots, (least,) * 3, WHITE)
    if dots.shape[0] < GLYPH_ROWS or cv2.countNonZero(white) < _FEW:
        return False
    seen = np.packbits(white > 0, axis=0, bitorder="little")[0]
    return any(_is_there(seen, words) for words in _columns(font))


@lru_cache(8)
def _columns(font: Font) -> tuple[NDArray[np.uint8], ...]:
    return tuple(np.frombuffer(font.columns(words).rstrip(b"\0"), np.uint8) for words in WORDS)


def _is_there(seen: NDArray[np.uint8], words: NDArray[np.uint8]) -> bool:
    """Whether most of the words' columns with ink stand somewhere around the middle."""
    ink = words > 0
    middle = (len(seen) - len(words)) // 2
    return any(
        np.count_nonzero((seen[at : at + len(words)] == words) & ink) >= _MOSTLY * np.count_nonzero(ink)
        for at in range(max(0, middle - 2), min(middle + 3, len(seen) - len(words) + 1))
    )
