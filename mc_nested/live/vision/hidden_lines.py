"""Tell whether a line of the debug screen may be hidden: by a notice over the right column, or by full columns.

A notice (toast) is a box of 160 x 32 dots, up to five below each other, that slides in from the right side
(FACTS: The F3 debug screen). It is looked for by its left edge: a margin of one colour, over most of the box's height,
beside something else; by clear rows above and below its letters; and none of the debug screen's text lies in it.
From 26.4 on a further box has no room where both columns reach down to the window's last rows.
"""

import numpy as np

from mc_nested.arrays import Bools
from mc_nested.live.vision.fact_lines import fact_from
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid
from mc_nested.live.vision.layout import INK_SPREAD, PLAIN, Overlay
from mc_nested.live.vision.text_lines import UNKNOWN, ink_of

WIDTH, HEIGHT, MOST = 160, 32, 5
"""Dots of a notice, and how many there are at most."""

_NEAREST = 64
"""Dots from the window's side: a box that has slid in less leaves the beginning of a block's lines to be seen."""

_BORDER, _MARGIN, _CORNER = 3, 8, 4
"""Dots from the box's side in which its border lies; up to which nothing else does; and of rounded corners."""

_CLEAR, _LONG = 6, 60
"""Rows from the box's top to the first that may hold letters or a picture, and how far to the right that is checked."""

_BELOW = 26, 28
"""Rows from the box's top that lie below its letters and its picture, and above the bar of a lesson's progress."""

_FLAT = 6
"""Levels by which a margin of one colour may vary."""

_MOSTLY = 0.95

_FEW = 20
"""Dots of the debug screen's colour that an item's picture may have: fewer than any line of text."""


def may_hide_lines(dots: GlyphGrid) -> bool:
    """Return whether something like a notice is seen in the upper right of a whole window's dots."""
    step, middle = dots.scale, dots.scale // 2
    if dots.columns <= _NEAREST:
        return False
    left_out = max(0, dots.columns - WIDTH - 2)
    picture = dots.frame[middle::step, left_out * step + middle :: step][: MOST * HEIGHT].astype(np.int16)
    columns = picture.shape[1]
    for top in range(0, picture.shape[0] - HEIGHT + 1, HEIGHT):
        rows = picture[top + _CORNER : top + HEIGHT - _CORNER]
        flat = (rows.max(0) - rows.min(0)).max(1) <= _FLAT
        for left in _margins(flat)[: columns - _NEAREST].nonzero()[0].tolist():
            margin = slice(left + _BORDER, left + _MARGIN)
            if left == 0 or np.ptp(rows[:, margin], axis=(0, 1)).max() > _FLAT:
                continue
            above = picture[top + _BORDER : top + _CLEAR, left + _BORDER : min(left + _LONG, columns - _BORDER)]
            below = picture[top + _BELOW[0] : top + _BELOW[1], left + _BORDER : min(left + _LONG, columns - _BORDER)]
            if max(np.ptp(above, axis=(0, 1)).max(), np.ptp(below, axis=(0, 1)).max()) > _FLAT:
                continue
            beside = rows[:, left - 1]
            ends = (np.abs(beside - rows[:, inside]).max(1) > _FLAT for inside in (left, left + _BORDER))
            if max(end.mean() for end in ends) < _MOSTLY:
                continue
            text = np.abs(picture[top : top + HEIGHT, left:] - PLAIN).max(2) <= INK_SPREAD
            if np.count_nonzero(text) < _FEW:
                return True
    return False


def _margins(flat: Bools) -> Bools:
    """Return for each column whether a margin of flat columns begins behind a border there."""
    found: Bools = np.all(np.lib.stride_tricks.sliding_window_view(flat[_BORDER:], _MARGIN - _BORDER), axis=1)
    return found


_LAST_ROWS = 18
"""Rows from the window's end in which the last line of a box stands below which there is no room for another."""

_LETTERS = 3
"""Letters that show that there is a line."""

_APART = 6
"""Columns without ink before a line."""


def columns_are_full(dots: GlyphGrid, font: Font, overlay: Overlay, last_rows: int = _LAST_ROWS) -> bool:
    """Return whether a line stands in the last rows of a window's dots both in the left and in the right half."""
    half = dots.columns // 2
    rows = range(dots.first, dots.rows, dots.pitch)
    last = [row for row in rows if row + GLYPH_ROWS > dots.rows + GLYPH_ROWS - 1 - last_rows]
    return all(
        any(_has_line(dots, font, overlay, row, *part) for row in last) for part in ((0, half), (half, dots.columns))
    )


def _has_line(dots: GlyphGrid, font: Font, overlay: Overlay, row: int, first: int, end: int) -> bool:
    ink = np.flatnonzero(ink_of(dots.strip(row, first, end), overlay.colour).any(0))
    if not ink.size:
        return False
    begins = ink[np.diff(ink, prepend=ink[0] - _APART - 1) > _APART] + first
    texts = (fact_from(dots, font, overlay, (row, int(column))).text for column in begins)
    return any(len(text) >= _LETTERS and UNKNOWN not in text[:_LETTERS] for text in texts)
