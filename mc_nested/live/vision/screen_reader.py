"""ScreenReader reads one window's debug screen repeatedly, and looks first where the lines of the last reading stood.

Then only the rows of the window that hold these lines are captured, which is faster. If anything differs (a line moved,
no block is looked at, something lies over the text), the whole window is captured and searched in the same call. Where
no block was looked at, the whole window is captured, and searched only if a block's lines may have come. So the reading
is the same either way.

That no block has come shows in an instant: to 26.3 its lines are rows more in one of the columns; from 26.4 on its box
has a bar of a colour of its own, at the window's edge (FACTS: The F3 debug screen).
"""

from dataclasses import dataclass

import numpy as np

from mc_nested.arrays import Bools
from mc_nested.live.devices import Display, Frame, Region
from mc_nested.live.model.reading import Reading
from mc_nested.live.vision.debug_screen import nothing_seen, read_lines, read_position
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid, GridPosition
from mc_nested.live.vision.hidden_lines import columns_are_full
from mc_nested.live.vision.layout import GREEN, INK_SPREAD, RED, WHITE, Colour, Overlay
from mc_nested.live.vision.overlay import POSITION, find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines

_BAR: Colour = (204, 0, 255)

_FIRST = 2
"""The row of the first line, and the column in which the lines of the left column begin; in some fonts, one farther."""

_LOOKED_AT = ("Targeted ", "Looking at", "Looking At ")
"""Of a fluid and an entity: their lines may go in the moment in which a block's come."""

_ROOM = 108
"""Rows that a box needs, with all that a block may have, below the others."""


def sign_of_no_block(lines: ScreenLines, font: Font) -> bytes | None:
    """Return what stays the same as long as no block is looked at, where ``lines`` show none.

    Return None where nothing does.
    """
    dots, overlay = lines.dots, lines.overlay
    if overlay.layout.has_target_column or any(lines.holds(label) for label in _LOOKED_AT):
        return None
    if not overlay.layout.has_facts:
        return _rows(dots.frame, overlay)
    row, _ = lines.positions_seen[POSITION][0]
    beside = dots.frame[row * overlay.scale]
    # In a picture that is shifted the bars lie elsewhere.
    has_bar = any(_are_of(beside[column], WHITE) for column in _edges(dots.frame, overlay.scale))
    if not has_bar or columns_are_full(dots, font, overlay, _ROOM):
        return None
    return _bars(dots.frame, overlay.scale)


def shows_no_block(frame: Frame, overlay: Overlay, sign: bytes) -> bool:
    """Return whether a picture of the whole window has the sign that ``sign_of_no_block`` found before."""
    return (_bars(frame, overlay.scale) if overlay.layout.has_facts else _rows(frame, overlay)) == sign


def _rows(frame: Frame, overlay: Overlay) -> bytes:
    """Return which rows have a line in the left and in the right column."""
    step, middle, layout = overlay.scale, overlay.scale // 2, overlay.layout
    columns = -(-frame.shape[1] // step)
    end = columns - (layout.right_edge or 0)
    sides = [frame[middle::step, column * step + middle] for column in (_FIRST, _FIRST + 1, end)]
    ink = [np.any([_are_of(side, colour) for colour in (overlay.colour, GREEN, RED)], axis=0) for side in sides]
    left, right = ink[0] | ink[1], ink[2]
    return np.packbits([_by_line(side, layout.pitch) for side in (left, right)]).tobytes()


def _by_line(ink: Bools, pitch: int) -> Bools:
    """Return for each line of text whether there is ink in one of its rows of dots."""
    count = (len(ink) - _FIRST - GLYPH_ROWS) // pitch
    return np.asarray(np.any(ink[_FIRST : _FIRST + count * pitch].reshape(count, pitch)[:, :GLYPH_ROWS], axis=1))


def _bars(frame: Frame, scale: int) -> bytes:
    """Return nothing where no bar of the block's box lies at an edge, else a mark."""
    return b"bar" if any(_are_of(frame[:, edge], _BAR).any() for edge in _edges(frame, scale)) else b""


def _edges(frame: Frame, scale: int) -> tuple[int, ...]:
    """Return the columns of pixels at the window's sides; the last GUI pixel may be cut, or left out."""
    width = frame.shape[1]
    return (0, width - 1, max(0, width // scale * scale - 1))


def _are_of(pixels: Frame, colour: Colour) -> Bools:
    alike: Bools = np.all(np.abs(pixels.astype(np.int16) - colour[::-1]) <= INK_SPREAD, axis=-1)
    return alike


@dataclass(frozen=True)
class _Stood:
    """The places of a reading's lines: the part of the window, and each line's position in it by how it begins.

    Lines can stand at each ``pitch``-th row of dots of that part, from ``first`` on. ``sign`` shows that no block is
    looked at, where none was; the part is the whole window then.
    """

    overlay: Overlay
    region: Region
    pitch: int
    positions: dict[str, list[GridPosition]]
    sign: bytes | None = None
    first: int = 0


@dataclass(frozen=True)
class Look:
    """A picture that was read, the part of the window that it shows, and the lines on it, if any were found."""

    frame: Frame
    region: Region | None
    lines: ScreenLines | None


class ScreenReader:
    """Reads the debug screen of a window.

    Args:
        display: the game's window.
        font: the font that reads it.
        overlay: how the debug screen is drawn; without it that is found.
    """

    def __init__(self, display: Display, font: Font, overlay: Overlay | None = None) -> None:
        self._display = display
        self._font = font
        self._overlay = overlay
        self._stood: _Stood | None = None
        self._last: tuple[Look, Reading] | None = None
        self.last_look: Look | None = None

    def read(self) -> Reading:
        """Take a picture and read it: a Reading as ``read_debug_screen`` gives it."""
        stood = self._stood
        if stood is not None and stood.sign is not None:
            frame = self._display.grab()
            return self._read_none_again(frame, stood, stood.sign) or self._read_whole(frame)
        return (stood and self._read_again(stood)) or self._read_whole(self._display.grab())

    def read_position(self) -> tuple[float, float, float] | None:
        """Read where the player is from a picture of the position line alone; None if that line has moved."""
        stood = self._stood
        if stood is None:
            return None
        (row, column), scale = stood.positions[POSITION][0], stood.overlay.scale
        whole = stood.region
        region = Region(whole.left, whole.top + row * scale, whole.width, (GLYPH_ROWS + 1) * scale)
        frame = self._display.grab(region)
        if frame.shape[:2] != (region.height, region.width):
            return None
        dots = GlyphGrid(frame, scale, min(stood.overlay.colour), 0, stood.pitch)
        lines = ScreenLines(dots, self._font, stood.overlay, {POSITION: [(0, column)]})
        self.last_look = Look(frame, region, lines)
        return read_position(lines)

    def _read_again(self, stood: _Stood) -> Reading | None:
        frame = self._display.grab(stood.region)
        if frame.shape[:2] != (stood.region.height, stood.region.width):
            return None
        if (reading := self._read_before(frame)) is None:
            dots = GlyphGrid(frame, stood.overlay.scale, min(stood.overlay.colour), 0, stood.pitch)
            lines = ScreenLines(dots, self._font, stood.overlay, stood.positions)
            reading = self._note(Look(frame, stood.region, lines), read_lines(lines))
        # Only the whole screen can show that no block is looked at: its lines may have moved elsewhere.
        return reading if reading.target else None

    def _read_none_again(self, frame: Frame, stood: _Stood, sign: bytes) -> Reading | None:
        """Read the lines again, still without a block looked at; return None where that isn't sure."""
        if reading := self._read_before(frame):
            return reading
        if frame.shape[:2] != (stood.region.height, stood.region.width) or not shows_no_block(
            frame, stood.overlay, sign
        ):
            return None
        dots = GlyphGrid(frame, stood.overlay.scale, min(stood.overlay.colour), stood.first, stood.pitch)
        lines = ScreenLines(dots, self._font, stood.overlay, stood.positions)
        reading = read_lines(lines)
        return None if reading.problem or reading.target else self._note(Look(frame, None, lines), reading)

    def _read_whole(self, frame: Frame) -> Reading:
        if reading := self._read_before(frame):
            return reading
        self._stood = None
        found = find_debug_screen(frame, self._font, self._overlay)
        if found is None:
            return self._note(Look(frame, None, None), nothing_seen(self._overlay))
        lines = ScreenLines(found.dots, self._font, found.overlay)
        reading = read_lines(lines, found.label)
        if reading.target:
            self._stood = _stood(lines)
        elif reading.problem is None and (sign := sign_of_no_block(lines, self._font)) is not None:
            whole = Region(0, 0, frame.shape[1], frame.shape[0])
            dots, positions = lines.dots, dict(lines.positions_seen)
            self._stood = _Stood(lines.overlay, whole, dots.pitch, positions, sign, dots.first)
        return self._note(Look(frame, None, lines), reading)

    def _read_before(self, frame: Frame) -> Reading | None:
        """Return the last reading, where the display returned the very picture again that it was taken from."""
        if self._last is None or frame is not self._last[0].frame or frame.flags.writeable:
            return None
        self.last_look, reading = self._last
        return reading

    def _note(self, look: Look, reading: Reading) -> Reading:
        self.last_look, self._last = look, (look, reading)
        return reading


def _stood(lines: ScreenLines) -> _Stood:
    """Return where the lines stood that a reading was taken from, in the rows of dots that hold them all."""
    dots, positions = lines.dots, lines.positions_seen
    rows = lines.rows_read.union(row for seen in positions.values() for row, _ in seen)
    first, behind = min(rows), max(rows) + GLYPH_ROWS + 1
    height = min(behind * dots.scale, dots.frame.shape[0]) - first * dots.scale
    region = Region(0, first * dots.scale, dots.frame.shape[1], height)
    moved = {label: [(row - first, column) for row, column in seen] for label, seen in positions.items()}
    return _Stood(lines.overlay, region, dots.pitch, moved)
