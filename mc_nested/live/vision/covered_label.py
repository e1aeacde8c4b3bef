"""Find partly covered texts: a button's label below the debug screen, and the words of a pause without a menu.

From 1.21.9 on the debug screen lies over menus. Its ground is half-transparent, so a label's colour below it is known;
behind its letters, brighter than anything that is dimmed, a dot may be anything (FACTS: The F3 debug screen).

In a pause by F3+Esc the world stays bright. Its words are known by their shadow, too, since they are as white as snow;
in another language, as a white text with a shadow that stands in that place (FACTS: Screens and their buttons).
"""

from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from typing import NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid, dots_in, dots_of
from mc_nested.live.vision.layout import BOX_ALPHA, BOX_GREY, DISABLED, GLUE, INK_SPREAD, TITLE_GREY, WHITE

_GROUNDS = ((), (BOX_GREY,), (TITLE_GREY,), (BOX_GREY, BOX_GREY))
"""The greys that may lie over a dot: none, one, or one of each column of the debug screen."""

_INK = (1 << len(_GROUNDS)) - 1
"""The bits of a label's ink; those of its shadow follow."""

_SEEN, _UNLIKE = 0.4, 0.15
"""The least part of a label's dots that must show, each with its shadow, and the most that may show something else."""

_ROOM = 100
"""GUI pixels on each side of the window's middle that hold a label there: the largest button is 204 wide."""


class CoveredLabel(NamedTuple):
    """A label found: its ``middle`` in a grid's dots, and whether it is white, as one that can be pressed."""

    middle: tuple[int, int]
    is_enabled: bool


class ShownDots:
    """Masks of the dots of a picture (height, width, 3) that may be a grey label's, by their shade and shadow."""

    def __init__(self, picture: Frame, shade: int) -> None:
        channels: NDArray[np.uint8] = np.asarray(cv2.LUT(picture, _codes(shade)), np.uint8)
        codes: NDArray[np.uint8] = channels[..., 0] & channels[..., 1] & channels[..., 2]
        self._picture, self._ink, self._shadow = picture, codes & _INK, codes >> len(_GROUNDS)
        self._grounds = np.zeros_like(codes)
        # The last row and column have no shadow.
        self._grounds[:-1, :-1] = self._ink[:-1, :-1] & self._shadow[1:, 1:]

    @property
    def bare(self) -> Bools:
        """The dots that are seen with their shadow, and below no ground."""
        return np.asarray(self._grounds & 1 > 0)

    @cached_property
    def surely(self) -> Bools:
        """The dots that are seen with their shadow below the same ground."""
        return np.asarray(self._grounds > 0)

    @cached_property
    def perhaps(self) -> Bools:
        """Those dots, and the ones that letters of the debug screen may cover, or whose shadow they may cover."""
        covered: Bools = self._picture.max(axis=2) >= min(GLUE) - INK_SPREAD
        perhaps: Bools = covered.copy()
        perhaps[:-1, :-1] |= (self._ink > 0)[:-1, :-1] & ((self._shadow > 0) | covered)[1:, 1:]
        return perhaps


@dataclass(frozen=True)
class CoveredLabels:
    """The labels on the dots of a frame of the whole window, at one scale, in its middle."""

    dots: GlyphGrid

    def find(self, columns: bytes) -> CoveredLabel | None:
        """Return the label with these columns of dots, if enough of it shows; None if not."""
        casting = casting_dots(columns)
        for shown, is_white in self._shown:
            if np.count_nonzero(shown.surely) < _SEEN * np.count_nonzero(casting):
                continue
            middle = self.dots.columns // 2
            if (row := label_row(shown, casting, middle - self._left - (len(columns) + 1) // 2)) is not None:
                return CoveredLabel((middle, row + GLYPH_ROWS // 2), is_white)
        return None

    @property
    def _left(self) -> int:
        return max(0, self.dots.columns // 2 - _ROOM)

    @cached_property
    def _shown(self) -> tuple[tuple[ShownDots, bool], ...]:
        """The dots that may be white labels', and grey ones'."""
        right = self.dots.columns // 2 + _ROOM
        picture = np.ascontiguousarray(dots_in(self.dots.frame, self.dots.scale)[:, self._left : right])
        if picture.size == 0:
            return ()
        return tuple((ShownDots(picture, colour[0]), colour == WHITE) for colour in (WHITE, DISABLED))


def casting_dots(columns: bytes) -> NDArray[np.uint8]:
    """Return which of a label's dots (8, columns) have their shadow seen beside them."""
    glyphs = dots_of(columns).astype(np.uint8)
    casting: NDArray[np.uint8] = glyphs.copy()
    casting[:-1, :-1] &= 1 - glyphs[1:, 1:]
    return casting


def label_row(shown: ShownDots, casting: NDArray[np.uint8], column: int) -> int | None:
    """Return the row of a label that shows, begun within a dot of that column.

    ``casting`` has its dots with a shadow.
    """
    columns = slice(column - 1, column + casting.shape[1] + 1)
    rows, across = shown.surely.shape
    if rows < GLYPH_ROWS or columns.start < 0 or columns.stop > across:
        return None
    shares = _shares(shown.surely[:, columns], casting)
    # On a ground as bright as letters of the debug screen every dot may be covered: another text shows by the others.
    beside = (
        _shares(shown.surely[:, columns], np.ones_like(casting)) * casting.size / np.count_nonzero(casting) - shares
    )
    shares[beside > _UNLIKE] = 0
    shares[_shares(shown.perhaps[:, columns], casting) < 1 - _UNLIKE] = 0
    row, at = np.unravel_index(int(shares.argmax()), shares.shape)
    return int(row) if shares[row, at] >= _SEEN else None


@cache
def _codes(shade: int) -> NDArray[np.uint8]:
    """Return for each grey 0 to 255 the grounds on which a label of that shade, or its shadow, looks so: a bit each."""
    greys, codes = np.arange(256), np.zeros(256, np.uint8)
    for bit, ground in enumerate(_GROUNDS):
        ink, shadow = float(shade), float(shade >> 2)
        for grey in ground:
            ink, shadow = (seen * (1 - BOX_ALPHA) + grey * BOX_ALPHA for seen in (ink, shadow))
        codes |= (np.abs(greys - ink) <= INK_SPREAD).astype(np.uint8) << bit
        codes |= (np.abs(greys - shadow) <= INK_SPREAD).astype(np.uint8) << (bit + len(_GROUNDS))
    return codes


def _shares(mask: Bools, glyphs: NDArray[np.uint8]) -> NDArray[np.float32]:
    """Return for each place of a label in a mask the share of its dots where the mask is set."""
    kernel = glyphs.astype(np.float32)
    return np.asarray(cv2.matchTemplate(mask.astype(np.float32), kernel, cv2.TM_CCORR) / kernel.sum(), np.float32)


WORDS = ("Game Paused", "Game paused")
"""From 1.18 on, and before."""

_TOP = 10
"""GUI pixels from the window's upper edge to the words, which stand in its middle."""

_ABOVE, _BELOW = 1, 2
"""Rows above the words, where nothing of them is, and below, where their shadow ends."""

_ROOM_FOR_WORDS = 160
"""GUI pixels that hold the words in any font and language."""

_FEW = 20
"""Dots with a shadow that are fewer than those of any words."""

_LETTERS = slice(_ABOVE, _ABOVE + GLYPH_ROWS - 1)
"""The rows of every capital letter. A boss's name and the chat's lines stand in others."""

_OFF = 2
"""Dots by which the middle of the words' ink may differ from the window's."""


def pause_region(size: tuple[int, int], scale: int) -> Region:
    """Return where the words would stand in a window (width, height), in framebuffer pixels at that GUI scale."""
    left = max(0, -(-size[0] // scale) // 2 - _ROOM_FOR_WORDS // 2)
    rows = _ABOVE + GLYPH_ROWS + _BELOW
    return Region(left * scale, (_TOP - _ABOVE) * scale, _ROOM_FOR_WORDS * scale, rows * scale)


def shows_pause(frame: Frame, scale: int, font: Font) -> bool:
    """Return whether a picture of that region shows the words, most of them, or others there that nothing covers."""
    dots = np.ascontiguousarray(dots_in(frame, scale))
    if dots.shape[0] < _ABOVE + GLYPH_ROWS + _BELOW or dots.shape[1] < _ROOM_FOR_WORDS:
        return False
    shown = ShownDots(dots, WHITE[0])
    if _are_words(shown.bare):
        return True
    return int(np.count_nonzero(shown.surely)) >= _FEW and any(
        label_row(shown, casting, (_ROOM_FOR_WORDS - casting.shape[1]) // 2) == _ABOVE for casting in _words(font)
    )


@lru_cache(8)
def _words(font: Font) -> tuple[NDArray[np.uint8], ...]:
    return tuple(casting_dots(font.columns(words).rstrip(b"\0")) for words in WORDS)


def _are_words(white: Bools) -> bool:
    """Return whether these dots, white with a shadow, are a text in the words' rows and in the middle."""
    if np.count_nonzero(white) < _FEW:
        return False
    rows: Bools = np.asarray(white.any(axis=1))
    across = np.flatnonzero(white.any(axis=0))
    is_in_rows = rows[_LETTERS].all() and not rows[:_ABOVE].any() and not rows[_ABOVE + GLYPH_ROWS :].any()
    return bool(is_in_rows and abs(int(across[0]) + int(across[-1]) + 1 - _ROOM_FOR_WORDS) <= 2 * _OFF)
