"""What shows in an instant that no block has come to be looked at since a picture that showed none.

To 26.3 a block's lines are rows more in one of the columns. From 26.4 on its box has a bar of a colour of its own, at
the window's edge (FACTS: The F3 debug screen).
"""

import numpy as np

from mc_nested.arrays import Bools
from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.full_columns import columns_are_full
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS
from mc_nested.live.vision.layout import Overlay
from mc_nested.live.vision.overlay import POSITION
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.text_colours import GREEN, INK_SPREAD, RED, WHITE, Colour

_BAR: Colour = (204, 0, 255)

_FIRST = 2
"""The row of the first line, and the column in which the lines of the left column begin; in some fonts, one farther."""

_LOOKED_AT = ("Targeted ", "Looking at", "Looking At ")
"""Of a fluid and an entity: their lines may go in the moment in which a block's come."""

_ROOM = 108
"""Rows that a box needs, with all that a block may have, below the others."""


def sign_of_no_block(lines: ScreenLines, font: Font) -> bytes | None:
    """What stays the same as long as no block is looked at, where ``lines`` show none; None where nothing does."""
    dots, overlay = lines.dots, lines.overlay
    if overlay.layout.has_target_column or any(lines.holds(label) for label in _LOOKED_AT):
        return None
    if not overlay.layout.has_facts:
        return _rows(dots.frame, overlay)
    row, _ = lines.positions_seen[POSITION][0]
    beside = dots.frame[row * overlay.scale]
    # In a picture that is shifted the bars lie elsewhere.
    has_bar = any(_is_of(beside[column], WHITE) for column in _edges(dots.frame, overlay.scale))
    if not has_bar or columns_are_full(dots, font, overlay, _ROOM):
        return None
    return _bars(dots.frame, overlay.scale)


def shows_no_block(frame: Frame, overlay: Overlay, sign: bytes) -> bool:
    """Whether a picture of the whole window has the sign that ``sign_of_no_block`` found before."""
    return (_bars(frame, overlay.scale) if overlay.layout.has_facts else _rows(frame, overlay)) == sign


def _rows(frame: Frame, overlay: Overlay) -> bytes:
    """Which rows have a line in the left and in the right column."""
    step, middle, layout = overlay.scale, overlay.scale // 2, overlay.layout
    columns = -(-frame.shape[1] // step)
    end = columns - (layout.right_edge or 0)
    sides = [frame[middle::step, column * step + middle] for column in (_FIRST, _FIRST + 1, end)]
    ink = [np.any([_are_of(side, colour) for colour in (overlay.colour, GREEN, RED)], axis=0) for side in sides]
    left, right = ink[0] | ink[1], ink[2]
    return np.packbits([_by_line(side, layout.pitch) for side in (left, right)]).tobytes()


def _by_line(ink: Bools, pitch: int) -> Bools:
    """For each line of text, whether there is ink in one of its rows of dots."""
    count = (len(ink) - _FIRST - GLYPH_ROWS) // pitch
    return np.asarray(np.any(ink[_FIRST : _FIRST + count * pitch].reshape(count, pitch)[:, :GLYPH_ROWS], axis=1))


def _bars(frame: Frame, scale: int) -> bytes:
    """Nothing where no bar of the block's box lies at an edge."""
    return b"bar" if any(_are_of(frame[:, edge], _BAR).any() for edge in _edges(frame, scale)) else b""


def _edges(frame: Frame, scale: int) -> tuple[int, ...]:
    """The columns of pixels at the window's sides; the last GUI pixel may be cut, or left out."""
    width = frame.shape[1]
    return (0, width - 1, max(0, width // scale * scale - 1))


def _are_of(pixels: Frame, colour: Colour) -> Bools:
    alike: Bools = np.all(np.abs(pixels.astype(np.int16) - colour[::-1]) <= INK_SPREAD, axis=-1)
    return alike


def _is_of(pixel: Frame, colour: Colour) -> bool:
    return bool(_are_of(pixel[np.newaxis], colour)[0])
