"""A frame seen as the dots of one GUI scale: every dot of the game's text is ``scale`` x ``scale`` pixels.

One pixel of each dot is read, near its middle. Dots are whole and crisp, so a frame that is shifted by some pixels, as
by a window's border, gives the same dots. Eight dots below each other make one byte: bit ``r`` is the dot ``r`` rows
further down, set where it has the text's colour. So a glyph is a string of bytes, one a column, and a word is found by
comparing bytes.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame

GLYPH_ROWS = 8
_GREEN = 1

GridPosition = tuple[int, int]
"""A row and a column of dots."""


def dots_in(frame: Frame, scale: int) -> Frame:
    """Return the dots of a picture (height, width, 3): the pixel of each that is read."""
    return frame[scale // 2 :: scale, scale // 2 :: scale]


def dots_of(columns: bytes) -> Bools:
    """Return columns of dots, a byte each, as dots (8, columns)."""
    return np.unpackbits(np.frombuffer(columns, np.uint8)[np.newaxis], axis=0, bitorder="little").astype(bool)


@dataclass(frozen=True)
class GlyphGrid:
    """A frame (height, width, 3) at one GUI scale, as ink where green is ``least`` or more.

    Green alone distinguishes text from the ground of its box (FACTS: The F3 debug screen), and one channel is three
    times faster. The colour itself is checked when a line is read. Lines are looked for at each ``pitch``-th row from
    ``first`` on.
    """

    frame: Frame
    scale: int
    least: int
    first: int = 0
    pitch: int = 1

    @property
    def rows(self) -> int:
        """The rows at which a glyph can begin, all its eight dots being in the frame."""
        return max(0, self._count(int(self.frame.shape[0])) - GLYPH_ROWS + 1)

    @property
    def columns(self) -> int:
        """The columns of dots."""
        return self._count(int(self.frame.shape[1]))

    def _count(self, pixels: int) -> int:
        """Return the dots along so many pixels: those whose pixel that is read is among them."""
        return -(-max(0, pixels - self.scale // 2) // self.scale)

    def strip(self, row: int, first: int, last: int) -> Frame:
        """Return the colours of eight rows of dots from ``row`` on, from column ``first`` to before ``last``."""
        step, middle = self.scale, self.scale // 2
        top, left = row * step + middle, first * step + middle
        picked = self.frame[top : top + GLYPH_ROWS * step : step, left : last * step : step]
        strip = np.empty(picked.shape, np.uint8)
        for channel in range(3):  # four times faster than all three in one copy
            strip[..., channel] = picked[..., channel]
        return strip

    def find(self, pattern: bytes) -> list[GridPosition]:
        """Return each (row, column) where the columns of ``pattern``, two or more, stand."""
        columns = self.columns
        if not 2 <= len(pattern) <= len(self._codes):
            return []
        rarest = _rarest(pattern)
        alike = self._codes[:-1] == pattern[rarest]
        alike &= self._codes[1:] == pattern[rarest + 1]
        at = np.flatnonzero(alike) - rarest
        at = at[(at >= 0) & (at % columns <= columns - len(pattern))]
        for index, byte in enumerate(pattern):
            if at.size == 0:
                return []
            at = at[self._codes[at + index] == byte]
        return [
            (self.first + self.pitch * row, column) for row, column in (divmod(int(index), columns) for index in at)
        ]

    @cached_property
    def _codes(self) -> NDArray[np.uint8]:
        """The byte that starts at each dot and goes down, row after row of those that are looked at."""
        count = len(range(self.first, self.rows, self.pitch))
        if count == 0 or self.columns == 0:
            return np.zeros(0, np.uint8)
        green = self._green()
        if self.pitch == 1:
            return _codes_of_each_row((green >= self.least).view(np.uint8))
        codes = np.zeros((count, self.columns), np.uint8)
        for bit in range(GLYPH_ROWS):
            ink = green[self.first + bit :: self.pitch][:count] >= self.least
            codes |= ink.view(np.uint8) * np.uint8(1 << bit)  # ten times faster than a shift
        return codes.reshape(-1)

    def _green(self) -> NDArray[np.uint8]:
        step, middle = self.scale, self.scale // 2
        if step == 1:  # where every pixel is looked at, cv2 takes one channel twice as fast as a slice
            return np.asarray(cv2.extractChannel(self.frame, _GREEN), np.uint8)
        return self.frame[middle::step, middle::step, _GREEN][: self.rows + GLYPH_ROWS - 1, : self.columns]


def _codes_of_each_row(ink: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Turn dots of 0 and 1 (rows, columns), at least eight rows, into a byte each, but for the last seven rows."""
    rows, columns = ink.shape
    # Shifting eight bytes as one word is several times faster, and no bit crosses into the next byte: 1, 3 and 15 are
    # the largest values that are moved up by 1, 2 and 4.
    padded = np.zeros((rows, -(-columns // 8) * 8), np.uint8)
    padded[:, :columns] = ink
    words = padded.view(np.uint64)
    for step in (1, 2, 4):
        words = words[:-step] | (words[step:] << np.uint64(step))
    return words.view(np.uint8)[:, :columns].reshape(-1)


@lru_cache
def _rarest(pattern: bytes) -> int:
    """Return the two columns to look for first, half of their dots set: blank and full ones are common anywhere."""
    odd = [abs(byte.bit_count() - GLYPH_ROWS // 2) for byte in pattern]
    return min(range(len(pattern) - 1), key=lambda index: odd[index] + odd[index + 1])
