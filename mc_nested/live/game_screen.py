"""What is looked at on the game's window: the debug screen, the chat's input line, the menus. Never a guess."""

from collections.abc import Iterator
from typing import Protocol

import numpy as np

from mc_nested.live.devices import Display, Frame, Region
from mc_nested.live.dots import GLYPH_ROWS, Dots
from mc_nested.live.font import SPACE, Font
from mc_nested.live.menu_labels import Button, Menu
from mc_nested.live.overlay import SCALES, find_overlay
from mc_nested.live.reading import Reading
from mc_nested.live.screen_reader import ScreenReader
from mc_nested.live.text_lines import INK_SPREAD, Overlay

_LINE_LEFT, _LINE_BELOW = 4, 12
"""Dots from the left and from below to the chat's input line (FACTS: Screens and their buttons)."""

_COLOURS = np.array(
    [
        *((224, 224, 224), (170, 170, 170), (255, 255, 85), (85, 255, 255)),
        *((85, 255, 85), (255, 85, 255), (0, 170, 255), (85, 85, 255)),
    ],
    np.int16,
)
"""Blue, green, red of what is typed: plain, and as the parts of a command are coloured from 1.13 on."""

_GROUND = 150
"""Brighter than anything behind the line, which is half black; some channel of any text is brighter still."""

_FIRST = 7
"""Columns of dots that hold the first character of a line, most being five wide."""

_LEAST_INK = 3

_LEFT_FREE = 14
"""Columns that a line which is too long may leave free: those of the two widest letters."""


WORLDS_TITLE = "Select World"
"""Over the list of worlds, the one screen that has to be clicked where no label is."""


class Labels(Protocol):
    """A menu's texts and buttons."""

    def shows(self, text: str) -> bool: ...

    def button(self, label: str) -> Button: ...


class GameScreen(Protocol):
    """The game's window, looked at for one thing at a time; each method takes a picture."""

    def read(self) -> Reading:
        """What the debug screen says."""

    def read_place(self) -> tuple[float, float, float] | None:
        """Where the player is, and nothing else: quicker, and None where only the whole could tell."""

    def is_chat_open(self) -> bool:
        """Whether the chat's input line is seen."""

    def is_typed(self, text: str) -> bool:
        """Whether the chat's input line is seen to hold exactly that, and nothing behind but the cursor."""

    def menu(self) -> Labels:
        """The menu that may be there."""

    def place_of(self, text: str) -> tuple[int, int] | None:
        """The middle of the topmost white text like that, with nothing behind, in framebuffer pixels; None without."""

    def scale(self) -> int:
        """Framebuffer pixels to a GUI pixel, as last seen."""


class WindowScreen:
    """The game's window as pixels.

    Args:
        display: the game's window.
        font: the font that reads it.
        overlay: how the debug screen is drawn; without it that is found.
    """

    def __init__(self, display: Display, font: Font, overlay: Overlay | None = None) -> None:
        self._display, self._font, self._overlay = display, font, overlay
        self._reader = ScreenReader(display, font, overlay)
        self._measured: tuple[tuple[int, int], int] | None = None

    def read(self) -> Reading:
        return self._reader.read()

    def read_place(self) -> tuple[float, float, float] | None:
        return self._reader.read_place()

    def is_chat_open(self) -> bool:
        dots = self._line(_FIRST + 1).astype(np.int16)
        near = np.abs(dots[:, :, np.newaxis] - _COLOURS).max(3) <= INK_SPREAD
        ink = near[:-1, :-1]
        lit = ink.any(2)
        if int(lit.sum()) < _LEAST_INK:
            return False
        shadow = np.abs(dots[1:, 1:, np.newaxis] - (_COLOURS >> 2)).max(3) <= INK_SPREAD
        casts = (ink & shadow).any(2)
        if not (casts | near[1:, 1:].any(2))[lit].all():
            return False
        columns = np.packbits(lit[:GLYPH_ROWS], axis=0, bitorder="little").tobytes()
        return any(columns.startswith(glyph + b"\0") for glyph in self._font.glyphs.values())

    def is_typed(self, text: str) -> bool:
        ink = self._line()[:GLYPH_ROWS].max(2) > _GROUND
        seen = np.packbits(ink, axis=0, bitorder="little").tobytes()
        for line in (f"{text}_", text):
            for shown in self._ends(line, len(seen)):
                if seen.startswith(shown) and not any(seen[len(shown) :]):
                    return True
        return False

    def _ends(self, line: str, room: int) -> Iterator[bytes]:
        """The columns of a line; of one that is too long for so many of them, those of each end that about fills them.

        The game shows the end of such a line, and leaves room for a letter or two.
        """
        for first in range(max(1, len(line))):
            columns = self._font.columns(line[first:]).rstrip(b"\0")
            if len(columns) <= room:
                if first and len(columns) < room - _LEFT_FREE:
                    return
                yield columns
                if not first:
                    return

    def menu(self) -> Labels:
        return Menu(self._display.grab(), self._font)

    def place_of(self, text: str) -> tuple[int, int] | None:
        frame, columns = self._display.grab(), self._font.columns(text)
        for scale in SCALES:
            if found := Dots(frame, scale, 255 - INK_SPREAD).find(columns + b"\0" * SPACE):
                row, column = min(found)
                return int((column + len(columns) / 2) * scale), (row + GLYPH_ROWS // 2) * scale
        return None

    def scale(self) -> int:
        size = self._display.size()
        if self._measured is None or self._measured[0] != size:
            overlay = self._overlay or find_overlay(self._display.grab(), self._font)
            if overlay is None:
                return self._measured[1] if self._measured else self._scale_of_menu()
            self._measured = size, overlay.scale
        return self._measured[1]

    def _scale_of_menu(self) -> int:
        frame = self._display.grab()
        return next((scale for scale in SCALES if Menu(frame, self._font, scale).shows(WORLDS_TITLE)), 1)

    def _line(self, columns: int | None = None) -> Frame:
        """The dots of the input line and of the row below it, (9, columns, 3), from where its first letter stands."""
        scale, (width, height) = self.scale(), self._display.size()
        top, left = (-(-height // scale) - _LINE_BELOW) * scale, _LINE_LEFT * scale
        right = width - left if columns is None else left + columns * scale
        frame = self._display.grab(Region(left, top, right - left, min((GLYPH_ROWS + 1) * scale, height - top)))
        return frame[scale // 2 :: scale, scale // 2 :: scale]
