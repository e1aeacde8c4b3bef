"""Find the debug screen in a frame: its GUI scale, its colour and its layout.

A line is found by how it begins, its label, never by its row (FACTS: The F3 debug screen). It may stand in either
column.
"""

import re
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mc_nested.live.devices import Frame
from mc_nested.live.vision.fact_lines import fact_from
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GlyphGrid, GridPosition, dots_of
from mc_nested.live.vision.layout import BOXES, INK_SPREAD, STANDIN, VANILLA, WHITE, Colour, Overlay
from mc_nested.live.vision.text_lines import UNKNOWN, Line, ink_of, is_text, positions_of

SCALES = (8, 7, 6, 5, 4, 3, 2, 1)
"""The GUI scales that are looked for: the larger, the fewer dots there are to look through."""

POSITION = "XYZ:"
REDUCED = "Chunk-relative:"
SECTIONS = ("Section-relative:", "Section-Relative:")
"""The line that is left without a position from 1.21.9 on, and from 26.4 on."""

TITLE = "Minecraft "
HELP = "Debug charts:"
"""A line that is there from 1.21.9 on whenever F3 is on."""

OTHERS = ("Facing", "Chunk:", "Block:", TITLE, "Looking at", "Targeted ", HELP, "Mem:", "Java:")
"""How other lines begin: they show that there is a debug screen where its position line can't be seen."""

_KNOWN = (*SECTIONS, *OTHERS, "fps T:", "Integrated server @", "Memory", "Looking At Block", "Type:")
"""What stands on a debug screen with more than one line, two of them at least."""

_VERSION = re.compile(r"Minecraft (\d+(?:\.\d+)+)")
FIRST_WITH_BOXES = (26, 4)
"""The first version whose debug screen is made of boxes."""

_VALUE = 16
"""Columns behind a name in which its value has begun, from 26.4 on."""

_MAY_BE_ALONE = (TITLE, "Targeted ", "Mem:", "Java:", *SECTIONS)
"""What is an entry of its own, which can be on without F3: alone it is no debug screen."""

_LEFT_COLUMN = 120
"""Columns in which a line of the left column begins: looking there first saves looking through the whole frame."""

_LEAST = 200
"""Any text is brighter, being 221 at least: the ground behind it is 183 at most (FACTS: The stand-in)."""


@dataclass(frozen=True)
class FoundScreen:
    """The debug screen in one frame: its dots, how it is drawn, and the label of a line that was found on it."""

    dots: GlyphGrid
    overlay: Overlay
    label: str


def find_overlay(frame: Frame, font: Font) -> Overlay | None:
    """Return how the debug screen is drawn in this frame (height, width, 3).

    Return None if there is none that this font reads.
    """
    found = find_debug_screen(frame, font)
    return found.overlay if found else None


def find_debug_screen(frame: Frame, font: Font, overlay: Overlay | None = None) -> FoundScreen | None:
    """Find the debug screen: by its position line if there is one, else by any other line whose beginning is known."""
    scales, least = ((overlay.scale,), _least(overlay)) if overlay else (SCALES, _LEAST)
    left = [GlyphGrid(frame[:, : _LEFT_COLUMN * scale], scale, least) for scale in scales]
    whole = [GlyphGrid(frame, scale, least) for scale in scales]
    for labels in ((POSITION,), (REDUCED, *SECTIONS, *OTHERS)):
        for dots in (*left, *whole):
            for label in labels:
                for position in positions_of(dots, font, label):
                    if label == TITLE and _is_of_a_menu(dots, font, position):
                        continue
                    if label in _MAY_BE_ALONE and _is_alone(GlyphGrid(frame, dots.scale, least), font, label):
                        continue
                    overlay = overlay or _measured(dots, font, label, position)
                    return FoundScreen(_line_dots(frame, overlay, position[0]), overlay, label)
    return None


def _is_alone(dots: GlyphGrid, font: Font, label: str) -> bool:
    """Return whether no other known line stands on the screen."""
    return not any(positions_of(dots, font, other) for other in _KNOWN if other != label)


def _is_of_a_menu(dots: GlyphGrid, font: Font, position: GridPosition) -> bool:
    """Return whether the game's name stands there as on a menu: in white, or over a shadow.

    The title screen's corner, its button of Realms and the names of servers begin like the debug screen's first line.
    """
    colour, ink = _ink_of(dots, font, TITLE, position)
    if all(abs(channel - white) <= INK_SPREAD for channel, white in zip(colour, WHITE, strict=True)):
        return True
    shadow = np.zeros_like(ink)
    shadow[1:, 1:] = ink[:-1, :-1]
    row, column = position
    seen = dots.strip(row, column, column + ink.shape[1])[shadow & ~ink].astype(int)
    cast = [(channel & 0xFC) >> 2 for channel in reversed(colour)]
    return bool((np.abs(seen - cast) <= INK_SPREAD).all())


def _line_dots(frame: Frame, overlay: Overlay, row: int) -> GlyphGrid:
    """Return the dots to look for lines in, one being known to stand in ``row``."""
    if overlay.layout.has_one_grid:  # a ninth of the rows to look through
        return GlyphGrid(frame, overlay.scale, _least(overlay), row % overlay.pitch, overlay.pitch)
    return GlyphGrid(frame, overlay.scale, _least(overlay))


def _least(overlay: Overlay) -> int:
    return min(overlay.colour) - INK_SPREAD


def _measured(dots: GlyphGrid, font: Font, label: str, position: GridPosition) -> Overlay:
    """Return the overlay's colour from the ink of a known line, its layout from where the lines beside it stand."""
    colour, ink = _ink_of(dots, font, label, position)
    boxes = Overlay(dots.scale, BOXES, colour)
    row, behind = position[0], position[1] + ink.shape[1]
    # Only where a value may follow is it read; behind a label at the window's side there is nothing.
    follows = dots.strip(row, behind, behind + _VALUE)
    may_follow = label == TITLE or (follows.size > 0 and ink_of(follows, WHITE).any())
    if may_follow and _is_of_boxes(fact_from(dots, font, boxes, position), label):
        return boxes
    overlays = [Overlay(dots.scale, layout, colour) for layout in (VANILLA, STANDIN)]
    return max(overlays, key=lambda overlay: _known_beside(dots, font, overlay, position))


def _is_of_boxes(line: Line, label: str) -> bool:
    """Return whether a line that begins with ``label`` is one of 26.4 on, read as such."""
    version = version_in(line.text)
    if version is not None:
        return version >= FIRST_WITH_BOXES
    return line.has_value and line.text.startswith(label) and UNKNOWN not in line.text[: len(label) + 2]


def version_in(text: str) -> tuple[int, ...] | None:
    """Return the version that the debug screen's line about it names."""
    version = _VERSION.match(text)
    return tuple(int(part) for part in version[1].split(".")) if version else None


def _ink_of(dots: GlyphGrid, font: Font, label: str, position: GridPosition) -> tuple[Colour, NDArray[np.bool_]]:
    """Return the colour of a label that stands there, and which of its dots (8, columns) are ink."""
    row, column = position
    ink = dots_of(font.columns(label).rstrip(b"\0"))
    blue, green, red = np.median(dots.strip(row, column, column + ink.shape[1])[ink], axis=0).astype(int)
    return (int(red), int(green), int(blue)), ink


def _known_beside(dots: GlyphGrid, font: Font, overlay: Overlay, position: GridPosition) -> int:
    """Return how many of the lines just above and below are text at this layout's pitch."""
    row, column = position
    return sum(is_text(dots, font, overlay, (near, column)) for near in (row - overlay.pitch, row + overlay.pitch))
