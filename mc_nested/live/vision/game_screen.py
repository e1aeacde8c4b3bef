"""What the game's window shows: the debug screen, the line being typed, the menus. Never a guess."""

from typing import Protocol

from mc_nested.live.devices import Display, Frame
from mc_nested.live.model.reading import Reading
from mc_nested.live.vision.font import SPACE, Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid
from mc_nested.live.vision.layout import Overlay
from mc_nested.live.vision.menu_labels import MenuButton, MenuLabels
from mc_nested.live.vision.overlay import SCALES, find_overlay
from mc_nested.live.vision.screen_reader import Look, ScreenReader
from mc_nested.live.vision.text_colours import INK_SPREAD, WHITE
from mc_nested.live.vision.typed_line import FIRST_COLUMNS, begins_a_line, reads_as, typed_line_dots, typed_line_region

WORLDS_TITLE = "Select World"
"""Above the list of worlds, the one screen where a click has to go where no label is."""


class Labels(Protocol):
    """A menu's texts and buttons."""

    def shows(self, text: str) -> bool: ...

    def button(self, label: str) -> MenuButton: ...


class GameScreen(Protocol):
    """The game's window, looked at for one thing at a time; each method takes a picture."""

    def read(self) -> Reading:
        """What the debug screen says."""

    def read_position(self) -> tuple[float, float, float] | None:
        """Where the player is, and nothing else: faster than ``read``; None where the whole screen has to be read."""

    def is_chat_open(self) -> bool:
        """Whether the chat's input line is seen."""

    def is_typed(self, text: str) -> bool:
        """Whether the chat's input line is seen to hold exactly that, and nothing behind but the cursor."""

    def menu(self) -> Labels:
        """The menu that may be there."""

    def position_of(self, text: str) -> tuple[int, int] | None:
        """The middle of the uppermost white text that reads so, in framebuffer pixels; None where there is none."""

    def scale(self) -> int:
        """Framebuffer pixels to a GUI pixel, as last seen."""

    def seen_scale(self) -> int | None:
        """The same, only if it was seen in a window of the present size; None if not."""


class WindowScreen:
    """The game's window as pixels.

    Args:
        display: the game's window.
        font: the font that reads it.
        overlay: how the debug screen is drawn; without it that is found.
    """

    def __init__(self, display: Display, font: Font, overlay: Overlay | None = None) -> None:
        self.font = font
        self._display, self._font, self._overlay = display, font, overlay
        self._reader = ScreenReader(display, font, overlay)
        self._measured: tuple[tuple[int, int], int] | None = None

    @property
    def last_look(self) -> Look | None:
        """What the last reading was taken from."""
        return self._reader.last_look

    def read(self) -> Reading:
        return self._reader.read()

    def read_position(self) -> tuple[float, float, float] | None:
        return self._reader.read_position()

    def is_chat_open(self) -> bool:
        return begins_a_line(self._typed_line(FIRST_COLUMNS), self._font)

    def is_typed(self, text: str) -> bool:
        return reads_as(self._typed_line(), text, self._font)

    def menu(self) -> Labels:
        return MenuLabels(self._display.grab(), self._font)

    def position_of(self, text: str) -> tuple[int, int] | None:
        frame, columns = self._display.grab(), self._font.columns(text)
        for scale in SCALES:
            if found := GlyphGrid(frame, scale, min(WHITE) - INK_SPREAD).find(columns + b"\0" * SPACE):
                row, column = min(found)
                return int((column + len(columns) / 2) * scale), (row + GLYPH_ROWS // 2) * scale
        return None

    def scale(self) -> int:
        return self.seen_scale() or (self._measured[1] if self._measured else self._scale_of_menu())

    def seen_scale(self) -> int | None:
        size = self._display.size()
        if self._measured is None or self._measured[0] != size:
            overlay = self._overlay or find_overlay(self._display.grab(), self._font)
            if overlay is None:
                return None
            self._measured = size, overlay.scale
        return self._measured[1]

    def _scale_of_menu(self) -> int:
        frame = self._display.grab()
        return next((scale for scale in SCALES if MenuLabels(frame, self._font, scale).shows(WORLDS_TITLE)), 1)

    def _typed_line(self, columns: int | None = None) -> Frame:
        scale = self.scale()
        return typed_line_dots(self._display.grab(typed_line_region(self._display.size(), scale, columns)), scale)
