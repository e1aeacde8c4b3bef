"""Where the debug screen is in a frame: its GUI scale, its colour and its pitch.

A line is known by how it begins, never by its row (FACTS: The F3 debug screen), and may stand in either column.
"""

from dataclasses import dataclass

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.dots import Dots, dots_of
from mc_nested.live.font import Font
from mc_nested.live.text_lines import INK_SPREAD, STANDIN_PITCH, UNKNOWN, Overlay, line_from

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


@dataclass(frozen=True)
class Sight:
    """The debug screen in one frame: its dots, how it is drawn, and what it was known by, with where that stands."""

    dots: Dots
    overlay: Overlay
    prefix: str
    places: tuple[tuple[int, int], ...]


def find_overlay(frame: Frame, font: Font) -> Overlay | None:
    """How the debug screen is drawn in this frame (height, width, 3); None if there is none that this font reads."""
    for prefixes in ((POSITION,), (REDUCED, *OTHERS)):
        for columns in (_LEFT_COLUMN, None):
            for scale in SCALES:
                dots = dots_of(frame[:, : columns * scale] if columns else frame, scale, _LEAST)
                for prefix in prefixes:
                    if places := places_of(dots, font, prefix):
                        return _measured(dots, font, prefix, places[0])
    return None


def see(frame: Frame, font: Font, overlay: Overlay | None = None) -> Sight | None:
    """Find the debug screen: by its position line if there is one, else by any other line that it begins to show."""
    overlay = overlay or find_overlay(frame, font)
    if overlay is None:
        return None
    dots = dots_of(frame, overlay.scale, min(overlay.colour) - INK_SPREAD)
    for prefix in (POSITION, REDUCED, *OTHERS):
        if places := places_of(dots, font, prefix):
            return Sight(dots, overlay, prefix, tuple(places))
    return None


def places_of(dots: Dots, font: Font, prefix: str) -> list[tuple[int, int]]:
    """Each (row, column) at which ``prefix`` stands."""
    return dots.find(font.columns(prefix)[:-1])


def _measured(dots: Dots, font: Font, prefix: str, place: tuple[int, int]) -> Overlay:
    """The overlay's colour from the ink of a known line, its pitch from whether a line stands 9 or 10 dots off it."""
    row, column = place
    glyphs = np.frombuffer(font.columns(prefix), np.uint8)
    ink = np.unpackbits(glyphs[np.newaxis], axis=0, bitorder="little").astype(bool)
    blue, green, red = np.median(dots.strip(row, column, column + len(glyphs))[ink], axis=0).astype(int)
    colour = (int(red), int(green), int(blue))
    standin = Overlay(dots.scale, STANDIN_PITCH, colour)
    vanilla = Overlay(dots.scale, VANILLA_PITCH, colour)
    return max(vanilla, standin, key=lambda overlay: _known_beside(dots, font, overlay, row, column))


def _known_beside(dots: Dots, font: Font, overlay: Overlay, row: int, column: int) -> int:
    """How many of the lines just above and below are text at this pitch."""
    rows = (row - overlay.pitch, row + overlay.pitch)
    lines = [line_from(dots, font, overlay, near, column).text for near in rows if 0 <= near < dots.codes.shape[0]]
    return sum(len(text) > 2 and UNKNOWN not in text[:3] for text in lines)
