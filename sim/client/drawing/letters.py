"""Text as layers, in one font at one GUI scale; a repeated text is drawn once.

The virtual client's own letters are drawn for this project, in the layout of the game's ``ascii.png``. Their shapes are
in ``glyphs.txt``: lines of up to eight characters, each with its eight rows of dots below it.
"""

from functools import lru_cache, partial
from importlib import resources

import numpy as np
from numpy.typing import NDArray

from mc_nested.live.vision.font import SPACE, Font, font_of
from sim.client.drawing.layers import Blend, Ink, Rect
from sim.client.game.widgets import Colour

_KEPT = 256
_ROWS = 8
_DOTS = [bytes(255 * (column >> row & 1) for column in range(256)) for row in range(_ROWS)]
"""For each row of dots: by a column's byte, 255 if that column has a dot in the row, else 0."""

_SHEET = 512
"""The width of a sheet of one colour is a multiple of so many pixels."""


class Letters:
    """The texts of one font at ``scale`` pixels a dot."""

    def __init__(self, font: Font, scale: int) -> None:
        self.scale = scale
        blank = {" ": b"\0" * SPACE}
        self._glyphs = blank | {char: columns + b"\0" for char, columns in font.glyphs.items()}
        self._unknown = self._glyphs.get("?", blank[" "])
        self._columns = lru_cache(8 * _KEPT)(self._found)
        self._dots = lru_cache(_KEPT)(self._drawn)

    def width(self, text: str) -> int:
        """Return a text's width in the game, in GUI pixels; characters that the font lacks are question marks."""
        return len(self._columns(text))

    def text(
        self,
        text: str,
        left: int,
        top: int,
        colour: Colour,
        *,
        shadow: bool = False,
        size: int = 1,
        is_slanted: bool = False,
    ) -> Ink:
        """Return a text with its upper left corner at a position in GUI pixels; ``size`` is 2 for a large title.

        A slanted one reaches a GUI pixel beyond that corner, and beyond its right edge.
        """
        x, y, step = left * self.scale, top * self.scale, self.scale * size
        right, bottom = x + (self.width(text) + shadow) * step, y + (_ROWS + shadow) * step
        if is_slanted:
            x, right = x - step, right + step
        return Ink((x, y, right, bottom), partial(self._dots, text, colour, shadow, size, is_slanted))

    def fill(self, gui: Rect, colour: Colour, alpha: int = 255) -> Blend:
        """Return a rectangle in GUI pixels, filled; ``alpha`` is out of 255."""
        left, top, right, bottom = gui
        return Blend((left * self.scale, top * self.scale, right * self.scale, bottom * self.scale), colour, alpha)

    def _found(self, text: str) -> bytes:
        glyphs, unknown = self._glyphs, self._unknown
        return b"".join([glyphs.get(char, unknown) for char in text])

    def _drawn(
        self, text: str, colour: Colour, shadow: bool, size: int, is_slanted: bool
    ) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
        columns, step = self._columns(text), self.scale * size
        rows = b"".join([columns.translate(row) for row in _DOTS])
        lit = np.frombuffer(rows, np.uint8).reshape(_ROWS, len(columns))
        if is_slanted:
            lit, step = _slanted(lit, step), 1
        if not shadow:
            mask = _enlarged(lit, step)
            height, width = mask.shape
            return mask, _sheet(colour, height, -(-width // _SHEET) * _SHEET)[:, :width]
        far = self.scale * size // step
        whole = np.zeros((lit.shape[0] + far, lit.shape[1] + far), np.uint8)
        whole[far:, far:] = lit
        # The game's shadow (FACTS: Screens and their buttons): the colour's upper six bits, shifted right by two.
        colours = np.full((*whole.shape, 3), [(part & 0xFC) >> 2 for part in colour[::-1]], np.uint8)
        colours[:-far, :-far][lit > 0] = colour[::-1]
        whole[:-far, :-far] |= lit
        return _enlarged(whole, step), _enlarged(colours, step)


def _enlarged(dots: NDArray[np.uint8], step: int) -> NDArray[np.uint8]:
    return dots.repeat(step, 1).repeat(step, 0)


def _slanted(dots: NDArray[np.uint8], step: int) -> NDArray[np.uint8]:
    """Return text as slanted dots, ``step`` pixels each: the top is a dot to the right, the bottom a dot to the left.

    It leans by a quarter of a dot for each dot of height, measured at each pixel's middle (FACTS: The chat's line).
    """
    rows, columns = dots.shape
    down, right = np.mgrid[: rows * step, : (columns + 2) * step]
    at = np.floor((right + 0.5) / step - 2 + 0.25 * (down + 0.5) / step).astype(int)
    seen = dots[down // step, np.clip(at, 0, columns - 1)]
    return np.where((at >= 0) & (at < columns), seen, 0).astype(np.uint8)


@lru_cache(32)
def _sheet(colour: Colour, height: int, width: int) -> NDArray[np.uint8]:
    """Return a sheet of nothing but that colour, which texts without a shadow share."""
    return np.full((height, width, 3), colour[::-1], np.uint8)


_FIELD = 7


@lru_cache(1)
def drawn_font() -> Font:
    """Return the font drawn for this project."""
    return font_of(drawn_atlas())


def drawn_atlas() -> NDArray[np.uint8]:
    """Return the font picture (128, 128, 4): 16 x 16 cells of 8 x 8 dots (FACTS: The bitmap font).

    Its dots are white; alpha is 0 or 255.
    """
    atlas = np.full((128, 128, 4), (255, 255, 255, 0), np.uint8)
    for char, cell in _drawings().items():
        top, left = (index * _ROWS for index in divmod(ord(char), 16))
        atlas[top : top + cell.shape[0], left : left + cell.shape[1], 3] = np.where(cell, 255, 0)
    return atlas


def _drawings() -> dict[str, NDArray[np.bool_]]:
    text = resources.files("sim.client.drawing").joinpath("glyphs.txt").read_text(encoding="ascii")
    drawings = {}
    for block in text.strip().split("\n\n"):
        names, *rows = block.splitlines()
        for column in range(0, len(names), _FIELD):
            cell = [[dot == "#" for dot in row[column : column + _FIELD - 1]] for row in rows]
            drawings[names[column]] = np.array(cell)
    return drawings
