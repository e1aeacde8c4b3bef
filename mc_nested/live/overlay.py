"""Where the debug screen is in a frame: its GUI scale, its colour and its pitch.

A line is known by how it begins, never by its row (FACTS: The F3 debug screen), and may stand in either column.
"""

from dataclasses import dataclass

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.dots import Dots
from mc_nested.live.font import Font
from mc_nested.live.text_lines import INK_SPREAD, STANDIN_PITCH, Overlay, is_text

SCALES = (4, 3, 2, 1)
"""The GUI scales that are looked for: the larger, the fewer dots there are to look through."""

VANILLA_PITCH = 9

POSITION = "XYZ:"
REDUCED = "Chunk-relative:"
OTHERS = ("Facing", "Chunk:", "Block:", "Minecraft ", "Looking at", "Targeted ")
"""How other lines begin, by which a debug screen is known whose position can't be seen."""

_LEFT_COLUMN = 120
"""Columns in which a line of the left column begins: looking there first saves looking through the whole frame."""

_LEAST = 200
"""Any text is brighter, being 221 at least: the ground behind it is 183 at most (FACTS: The stand-in)."""


Place = tuple[int, int]
"""The row and the column of dots at which a line begins."""


@dataclass(frozen=True)
class Sight:
    """The debug screen in one frame: its dots, how it is drawn, and how the line begins that it was known by."""

    dots: Dots
    overlay: Overlay
    prefix: str


def find_overlay(frame: Frame, font: Font) -> Overlay | None:
    """How the debug screen is drawn in this frame (height, width, 3); None if there is none that this font reads."""
    sight = see(frame, font)
    return sight.overlay if sight else None


def see(frame: Frame, font: Font, overlay: Overlay | None = None) -> Sight | None:
    """Find the debug screen: by its position line if there is one, else by any other line that it begins to show."""
    scales, least = ((overlay.scale,), _least(overlay)) if overlay else (SCALES, _LEAST)
    left = [Dots(frame[:, : _LEFT_COLUMN * scale], scale, least) for scale in scales]
    whole = [Dots(frame, scale, least) for scale in scales]
    for prefixes in ((POSITION,), (REDUCED, *OTHERS)):
        for dots in (*left, *whole):
            for prefix in prefixes:
                if places := places_of(dots, font, prefix):
                    overlay = overlay or _measured(dots, font, prefix, places[0])
                    return Sight(_line_dots(frame, overlay, places[0][0]), overlay, prefix)
    return None


def places_of(dots: Dots, font: Font, prefix: str) -> list[Place]:
    """Each place at which ``prefix`` stands."""
    return dots.find(font.columns(prefix)[:-1])


def _line_dots(frame: Frame, overlay: Overlay, row: int) -> Dots:
    """The dots to look for lines in, one being known to stand in ``row``."""
    if overlay.pitch == STANDIN_PITCH:
        return Dots(frame, overlay.scale, _least(overlay))
    # In the game an empty line is as high as any, so all lines stand in one grid: a ninth of the rows to look through.
    return Dots(frame, overlay.scale, _least(overlay), row % overlay.pitch, overlay.pitch)


def _least(overlay: Overlay) -> int:
    return min(overlay.colour) - INK_SPREAD


def _measured(dots: Dots, font: Font, prefix: str, place: Place) -> Overlay:
    """The overlay's colour from the ink of a known line, its pitch from whether a line stands 9 or 10 dots off it."""
    row, column = place
    glyphs = np.frombuffer(font.columns(prefix), np.uint8)
    ink = np.unpackbits(glyphs[np.newaxis], axis=0, bitorder="little").astype(bool)
    blue, green, red = np.median(dots.strip(row, column, column + len(glyphs))[ink], axis=0).astype(int)
    colour = (int(red), int(green), int(blue))
    pitches = (VANILLA_PITCH, STANDIN_PITCH)
    overlays = [Overlay(dots.scale, pitch, colour) for pitch in pitches]
    return max(overlays, key=lambda overlay: _known_beside(dots, font, overlay, row, column))


def _known_beside(dots: Dots, font: Font, overlay: Overlay, row: int, column: int) -> int:
    """How many of the lines just above and below are text at this pitch."""
    return sum(is_text(dots, font, overlay, near, column) for near in (row - overlay.pitch, row + overlay.pitch))
