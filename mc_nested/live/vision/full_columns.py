"""Whether both columns of 26.4's boxes reach down to the window's last rows: then a further box has no room.

FACTS: The F3 debug screen.
"""

import numpy as np

from mc_nested.live.vision.facts import fact_from
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid
from mc_nested.live.vision.layout import Overlay
from mc_nested.live.vision.text_lines import UNKNOWN, ink_of

_LAST_ROWS = 18
"""Rows from the window's end in which the last line of a box stands below which there is no room for another."""

_LETTERS = 3
"""Letters that show that there is a line."""

_APART = 6
"""Columns without ink before a line."""


def columns_are_full(dots: GlyphGrid, font: Font, overlay: Overlay, last_rows: int = _LAST_ROWS) -> bool:
    """Whether a line stands in the last rows of a window's dots both in the left and in the right half."""
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
