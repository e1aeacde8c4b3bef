"""Reading one window's debug screen again and again: the lines of the last reading are looked at where they stood.

Only the rows of the window that hold them are pictured then, which makes the picture cheaper too. Whatever isn't
exactly as it was there (a line that moved, a block no longer looked at, something over the text) has the whole window
pictured and searched in the same call, so a reading is the same either way.
"""

from dataclasses import dataclass

from mc_nested.live.debug_screen import nothing_seen, read_position, read_screen
from mc_nested.live.devices import Display, Region
from mc_nested.live.dots import GLYPH_ROWS, Dots
from mc_nested.live.font import Font
from mc_nested.live.overlay import POSITION, Place, Sight, see
from mc_nested.live.reading import Reading
from mc_nested.live.screen_lines import Screen
from mc_nested.live.text_lines import Overlay


@dataclass(frozen=True)
class _Lines:
    """Where the lines of a reading stood: the part of the window, and each line's place in it by how it begins.

    ``first`` and ``pitch`` are the rows of dots in it at which lines can stand.
    """

    overlay: Overlay
    region: Region
    first: int
    pitch: int
    places: dict[str, list[Place]]


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
        self._lines: _Lines | None = None

    def read(self) -> Reading:
        """Take a picture and read it: a Reading as ``read_debug_screen`` gives it."""
        return (self._lines and self._reread(self._lines)) or self._read_anew()

    def read_place(self) -> tuple[float, float, float] | None:
        """Where the player is, by a picture of that line alone, where it stood; None where it can't be read there."""
        lines = self._lines
        if lines is None:
            return None
        (row, column), scale = lines.places[POSITION][0], lines.overlay.scale
        whole = lines.region
        region = Region(whole.left, whole.top + row * scale, whole.width, (GLYPH_ROWS + 1) * scale)
        frame = self._display.grab(region)
        if frame.shape[:2] != (region.height, region.width):
            return None
        dots = Dots(frame, scale, min(lines.overlay.colour), 0, lines.pitch)
        return read_position(Screen(Sight(dots, lines.overlay, POSITION), self._font, {POSITION: [(0, column)]}))

    def _reread(self, lines: _Lines) -> Reading | None:
        frame = self._display.grab(lines.region)
        if frame.shape[:2] != (lines.region.height, lines.region.width):
            return None
        dots = Dots(frame, lines.overlay.scale, min(lines.overlay.colour), lines.first, lines.pitch)
        reading = read_screen(Screen(Sight(dots, lines.overlay, POSITION), self._font, lines.places))
        # That no block is looked at is only known of a whole screen: its lines may have come up elsewhere.
        return reading if reading.target else None

    def _read_anew(self) -> Reading:
        frame = self._display.grab()
        self._lines = None
        sight = see(frame, self._font, self._overlay)
        if sight is None:
            return nothing_seen(self._overlay)
        screen = Screen(sight, self._font)
        reading = read_screen(screen)
        if reading.target:
            self._lines = _lines_of(screen)
        return reading


def _lines_of(screen: Screen) -> _Lines:
    """The lines that a reading was taken from, in the rows of dots that hold them all."""
    dots, places = screen.sight.dots, screen.places_seen
    rows = screen.rows_read.union(row for seen in places.values() for row, _ in seen)
    first, behind = min(rows), max(rows) + GLYPH_ROWS + 1
    height = min(behind * dots.scale, dots.frame.shape[0]) - first * dots.scale
    region = Region(0, first * dots.scale, dots.frame.shape[1], height)
    moved = {prefix: [(row - first, column) for row, column in seen] for prefix, seen in places.items()}
    return _Lines(screen.sight.overlay, region, (dots.first - first) % dots.pitch, dots.pitch, moved)
