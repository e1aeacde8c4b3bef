"""Text as layers, in one font at one GUI scale; a repeated text is drawn once."""

from functools import lru_cache, partial

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.vision.font import SPACE, Font
from sim.client.drawing.layers import Ink
from sim.client.game.colours import Colour

_KEPT = 256
_ROWS = 8
_HIDES = np.array([(255,) * 3, (0,) * 3, (0,) * 3], np.uint8)


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
        """A text's width in the game, in GUI pixels; characters that the font lacks are question marks."""
        return len(self._columns(text))

    def text(self, text: str, left: int, top: int, colour: Colour, *, shadow: bool = False, size: int = 1) -> Ink:
        """A text with its upper left corner at a position in GUI pixels; ``size`` is 2 for a large title."""
        x, y, step = left * self.scale, top * self.scale, self.scale * size
        right, bottom = x + (self.width(text) + shadow) * step, y + (_ROWS + shadow) * step
        return Ink((x, y, right, bottom), partial(self._dots, text, colour, shadow, size))

    def _found(self, text: str) -> bytes:
        glyphs, unknown = self._glyphs, self._unknown
        return b"".join([glyphs.get(char, unknown) for char in text])

    def _drawn(self, text: str, colour: Colour, shadow: bool, size: int) -> tuple[NDArray[np.uint8], NDArray[np.uint8]]:
        columns = np.frombuffer(self._columns(text), np.uint8)[np.newaxis]
        dots = np.unpackbits(columns, axis=0, bitorder="little").astype(bool)
        whole = np.zeros((_ROWS + shadow, columns.shape[1] + shadow), np.uint8)
        if shadow:
            whole[1:, 1:][dots] = 2
        whole[:_ROWS, : columns.shape[1]][dots] = 1
        # The game's shadow (FACTS: Screens and their buttons): the colour's upper six bits, shifted right by two.
        shades = np.array([(0, 0, 0), colour[::-1], [(part & 0xFC) >> 2 for part in colour[::-1]]], np.uint8)
        return self._enlarged(_HIDES[whole], size), self._enlarged(shades[whole], size)

    def _enlarged(self, dots: NDArray[np.uint8], size: int) -> NDArray[np.uint8]:
        step = self.scale * size
        if not dots.size:
            return dots
        return np.asarray(cv2.resize(dots, None, fx=step, fy=step, interpolation=cv2.INTER_NEAREST), np.uint8)
