"""The words of a pause without a menu, by F3+Esc: the world stays bright (FACTS: Screens and their buttons).

They are known by their shadow, too, since they are as white as snow. In another language they are known as a white text
with a shadow that stands in that place.
"""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.covered_label import ShownDots, casting_dots, label_row
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS
from mc_nested.live.vision.text_colours import WHITE

WORDS = ("Game Paused", "Game paused")
"""From 1.18 on, and before."""

_TOP = 10
"""GUI pixels from the window's upper edge to the words, which stand in its middle."""

_ABOVE, _BELOW = 1, 2
"""Rows above the words, where nothing of them is, and below, where their shadow ends."""

_ROOM = 160
"""GUI pixels that hold the words in any font and language."""

_FEW = 20
"""Dots with a shadow that are fewer than those of any words."""

_LETTERS = slice(_ABOVE, _ABOVE + GLYPH_ROWS - 1)
"""The rows of every capital letter. A boss's name and the chat's lines stand in others."""

_OFF = 2
"""Dots by which the middle of the words' ink may differ from the window's."""


def pause_region(size: tuple[int, int], scale: int) -> Region:
    """Where the words would stand in a window (width, height), in framebuffer pixels at that GUI scale."""
    left = max(0, -(-size[0] // scale) // 2 - _ROOM // 2)
    rows = _ABOVE + GLYPH_ROWS + _BELOW
    return Region(left * scale, (_TOP - _ABOVE) * scale, _ROOM * scale, rows * scale)


def shows_pause(frame: Frame, scale: int, font: Font) -> bool:
    """Whether a picture of that region shows the words, most of them, or others there that nothing covers."""
    dots = np.ascontiguousarray(frame[scale // 2 :: scale, scale // 2 :: scale])
    if dots.shape[0] < _ABOVE + GLYPH_ROWS + _BELOW or dots.shape[1] < _ROOM:
        return False
    shown = ShownDots(dots, WHITE[0])
    if _are_words(shown.bare):
        return True
    return int(np.count_nonzero(shown.surely)) >= _FEW and any(
        label_row(shown, casting, (_ROOM - casting.shape[1]) // 2) == _ABOVE for casting in _words(font)
    )


@lru_cache(8)
def _words(font: Font) -> tuple[NDArray[np.uint8], ...]:
    return tuple(casting_dots(font.columns(words).rstrip(b"\0")) for words in WORDS)


def _are_words(white: Bools) -> bool:
    """Whether these dots, white with a shadow, are a text in the words' rows and in the middle."""
    if np.count_nonzero(white) < _FEW:
        return False
    rows: Bools = np.asarray(white.any(axis=1))
    across = np.flatnonzero(white.any(axis=0))
    is_in_rows = rows[_LETTERS].all() and not rows[:_ABOVE].any() and not rows[_ABOVE + GLYPH_ROWS :].any()
    return bool(is_in_rows and abs(int(across[0]) + int(across[-1]) + 1 - _ROOM) <= 2 * _OFF)
