"""A frame seen as the dots of one GUI scale: every dot of the debug screen is ``scale`` x ``scale`` pixels.

One pixel of each dot is read, near its middle. Dots are whole and crisp, so a frame that is shifted by some pixels, as
by a window's border, gives the same dots. Eight dots below each other make one byte: bit ``r`` is the dot ``r`` rows
further down, set where it has the text's colour. So a glyph is a string of bytes, one a column, and a word is found by
comparing bytes.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame

Codes = NDArray[np.uint8]
"""(rows, columns): the byte that starts at each dot and goes down."""

GLYPH_ROWS = 8
_BAND = 96


@dataclass(frozen=True)
class Dots:
    """A frame's dots at one GUI scale: the frame, and the byte at each dot but those of the last seven rows."""

    frame: Frame
    scale: int
    codes: Codes

    def strip(self, row: int, first: int, last: int) -> Frame:
        """The colours of the eight rows of dots from ``row`` on, in the columns from ``first`` to before ``last``."""
        step, middle = self.scale, self.scale // 2
        top, left = row * step + middle, first * step + middle
        return np.ascontiguousarray(self.frame[top : top + GLYPH_ROWS * step : step, left : last * step : step])

    def find(self, pattern: bytes) -> list[tuple[int, int]]:
        """Each (row, column) where the columns of ``pattern`` stand."""
        rows, columns = self.codes.shape
        if columns < len(pattern) or not rows:
            return []
        anchor = _rarest(pattern)
        flat = self.codes.reshape(-1)
        at = np.flatnonzero(flat == pattern[anchor]) - anchor
        at = at[(at >= 0) & (at % columns <= columns - len(pattern))]
        for index, byte in enumerate(pattern):
            if at.size == 0:
                return []
            at = at[flat[at + index] == byte]
        return [divmod(int(place), columns) for place in at]


def dots_of(frame: Frame, scale: int, least: int) -> Dots:
    """The dots of a frame (height, width, 3) as ink where all three channels are ``least`` or more."""
    picked = _one_pixel_a_dot(frame, scale)
    codes = np.zeros((max(0, picked.shape[0] - GLYPH_ROWS + 1), picked.shape[1]), np.uint8)
    # In bands, because what a band needs stays in the processor's cache: 2.5 times faster at full HD.
    for top in range(0, len(codes) if codes.size else 0, _BAND):
        band = picked[top : top + _BAND + GLYPH_ROWS - 1]
        codes[top : top + _BAND] = _codes(np.asarray(cv2.inRange(band, (least,) * 3, (255,) * 3), np.uint8))
    return Dots(frame, scale, codes)


def _one_pixel_a_dot(frame: Frame, scale: int) -> Frame:
    moved = frame[scale // 2 :, scale // 2 :]
    rows, columns = moved.shape[0] // scale, moved.shape[1] // scale
    if scale == 1 or not rows or not columns:
        return moved[:rows, :columns]
    # cv2 picks the pixels several times faster than a slice with steps does, but only from whole dots.
    whole = moved[: rows * scale, : columns * scale]
    return np.asarray(cv2.resize(whole, (columns, rows), interpolation=cv2.INTER_NEAREST), np.uint8)


def _codes(ink: NDArray[np.uint8]) -> Codes:
    """From a mask of 0 and 255 (rows, columns), at least eight rows, to bytes (rows - 7, columns)."""
    rows, columns = ink.shape
    # Shifting eight bytes as one word is several times faster, and no bit crosses into the next byte: 1, 3 and 15 are
    # the largest values that are moved up by 1, 2 and 4.
    padded = np.zeros((rows, -(-columns // 8) * 8), np.uint8)
    np.bitwise_and(ink, 1, out=padded[:, :columns])
    words = padded.view(np.uint64)
    for step in (1, 2, 4):
        words = words[:-step] | (words[step:] << np.uint64(step))
    return words.view(np.uint8)[:, :columns]


def _rarest(pattern: bytes) -> int:
    """The column to look for first: about half of its dots set, since blank and full ones are common in any picture."""
    return min(range(len(pattern)), key=lambda index: abs(pattern[index].bit_count() - GLYPH_ROWS // 2))
