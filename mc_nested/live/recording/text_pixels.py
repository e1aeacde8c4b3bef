"""The pixels that a reading rests on, in a few hundred bytes: the ink of its lines, on the grey of their boxes.

The world behind the text changes with every step, and would be a hundred times as much. So it is left out wherever the
same reading is taken without it, which is tried before a recording leaves it out.
"""

import base64
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Reading
from mc_nested.live.vision.debug_screen import read_lines, read_position
from mc_nested.live.vision.fact_lines import VALUES
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid, dots_of
from mc_nested.live.vision.layout import LAYOUTS, Overlay
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.screen_reader import Look
from mc_nested.live.vision.text_lines import columns_of, ink_of

OUTSIDE = 240
"""What is beside a line's box: no box over any world is as bright, and no text of any layout has this colour."""

_BESIDE = 3
"""Columns of that on both sides of a box."""


@dataclass(frozen=True)
class LinePixels:
    """One line's ink: a byte a column as in ``glyph_grid``; row and first column are dots from the window's corner.

    ``values`` is the ink in the colours of values, as long, where the layout has any.
    """

    row: int
    first: int
    columns: bytes
    values: bytes = b""

    @property
    def inks(self) -> tuple[bytes, ...]:
        """The ink of each kind that there is."""
        return (self.columns, self.values) if self.values else (self.columns,)


@dataclass(frozen=True)
class TextPixels:
    """The lines of one picture, and how they are drawn."""

    overlay: Overlay
    lines: tuple[LinePixels, ...]

    def to_json(self) -> dict[str, Any]:
        """Return it as plain values."""
        return {
            "scale": self.overlay.scale,
            "layout": self.overlay.layout.name,
            "colour": list(self.overlay.colour),
            "lines": [
                [line.row, line.first, *(base64.b64encode(ink).decode("ascii") for ink in line.inks)]
                for line in self.lines
            ],
        }

    @classmethod
    def from_json(cls, value: Mapping[str, Any]) -> "TextPixels":
        """Make it again from such values; raise KeyError, TypeError or ValueError where they are something else."""
        red, green, blue = (int(each) for each in value["colour"])
        overlay = Overlay(int(value["scale"]), LAYOUTS[value["layout"]], (red, green, blue))
        lines = [LinePixels(int(row), int(first), *map(base64.b64decode, inks)) for row, first, *inks in value["lines"]]
        return cls(overlay, tuple(lines))


def text_pixels_of(look: Look) -> TextPixels | None:
    """Return the ink of every line that was read in a look; None where there was none."""
    lines = look.lines
    if lines is None or not lines.lines_read:
        return None
    above = look.region.top // lines.overlay.scale if look.region else 0
    colour = lines.overlay.colour
    pixels = []
    for (row, first), end in sorted({(line.row, line.start): line.end for line in lines.lines_read}.items()):
        if end >= first:
            strip = lines.dots.strip(row, first, end + 1)
            values = columns_of(ink_of(strip, *VALUES)) if lines.layout.has_facts else b""
            pixels.append(LinePixels(row + above, first, columns_of(ink_of(strip, colour)), values))
    return TextPixels(lines.overlay, tuple(pixels))


def paint(canvas: Frame, pixels: TextPixels) -> None:
    """Draw the lines onto a picture of the whole window, (height, width, 3), each on its box, cut off at the edges."""
    scale, box = pixels.overlay.scale, pixels.overlay.layout.box
    for line in pixels.lines:
        ink = dots_of(line.columns)
        before, behind = 1 + _BESIDE, box.behind + _BESIDE
        dots = np.full((GLYPH_ROWS, before + ink.shape[1] + behind, 3), OUTSIDE, np.uint8)
        dots[:, _BESIDE : dots.shape[1] - _BESIDE] = box.grey
        inside = dots[:, before : dots.shape[1] - behind]
        inside[ink] = pixels.overlay.colour[::-1]
        if line.values:
            inside[dots_of(line.values)] = VALUES[0][::-1]
        left = line.first - before
        shown = dots[:, max(0, -left) :].repeat(scale, 0).repeat(scale, 1)
        part = canvas[line.row * scale :, max(0, left) * scale :][: shown.shape[0], : shown.shape[1]]
        part[:] = shown[: part.shape[0], : part.shape[1]]


def reads_the_same(pixels: TextPixels, look: Look, answer: object, font: Font) -> bool:
    """Return whether these pixels alone, read where the lines stood, give what was read from the whole picture.

    ``answer`` is a Reading, or a position.
    """
    lines = look.lines
    if lines is None:
        return False
    above = look.region.top // lines.overlay.scale if look.region else 0
    flat = Overlay(1, lines.overlay.layout, lines.overlay.colour)
    shifted = TextPixels(flat, tuple(replace(line, row=line.row - above) for line in pixels.lines))
    rows = max((line.row for line in shifted.lines), default=0) + GLYPH_ROWS + 1
    picture: Frame = np.full((rows, lines.dots.columns, 3), OUTSIDE, np.uint8)
    paint(picture, shifted)
    dots = GlyphGrid(picture, 1, min(flat.colour), lines.dots.first, lines.dots.pitch)
    again = ScreenLines(dots, font, flat, lines.positions_seen)
    return (read_lines(again) if isinstance(answer, Reading) else read_position(again)) == answer
