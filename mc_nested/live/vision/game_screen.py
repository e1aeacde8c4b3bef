"""Read what the game's window shows: the debug screen, the line being typed, the menus. Never a guess."""

from typing import Protocol

from mc_nested.live.devices import Display, Frame
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.versions import draws_text_over_menus
from mc_nested.live.vision.covered_label import pause_region, shows_pause
from mc_nested.live.vision.font import SPACE, Font
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, GlyphGrid, dots_in
from mc_nested.live.vision.layout import INK_SPREAD, STANDIN, WHITE, Overlay, Scales, largest_gui_scale
from mc_nested.live.vision.menu_labels import MenuButton, MenuLabels
from mc_nested.live.vision.overlay import SCALES, find_overlay
from mc_nested.live.vision.screen_reader import Look, ScreenReader
from mc_nested.live.vision.window_bottom import (
    FIRST_COLUMNS,
    HotbarLook,
    begins_a_line,
    bottom_region,
    hotbar_look,
    reads_as,
    typed_dots,
    typed_line_region,
)

WORLDS_TITLE = "Select World"
"""Above the list of worlds, the one screen where a click has to go where no label is."""


class Labels(Protocol):
    """A menu's texts and buttons."""

    def shows(self, text: str) -> bool: ...

    def button(self, label: str) -> MenuButton: ...


class GameScreen(Protocol):
    """The game's window, looked at for one thing at a time; each method takes a picture."""

    def read(self) -> Reading:
        """Return what the debug screen says."""

    def read_position(self) -> tuple[float, float, float] | None:
        """Read where the player is, and nothing else: faster than ``read``.

        Return None where the whole screen has to be read.
        """

    def shows_world(self) -> bool:
        """Return whether nothing lies over the world: no menu, chat, pause or death.

        Only then a key or a click goes there.
        """

    def shows_death(self) -> bool:
        """Return whether the hotbar is seen red, as behind the death screen: also where text lies over its buttons."""

    def is_chat_open(self) -> bool:
        """Return whether the chat's input line is seen."""

    def is_typed(self, text: str) -> bool:
        """Return whether the chat's input line is seen to hold exactly that, and nothing behind but the cursor."""

    def menu(self) -> Labels:
        """Return the menu that may be there."""

    def position_of(self, text: str) -> tuple[int, int] | None:
        """Return the middle of the uppermost white text that reads so, in framebuffer pixels.

        Return None where there is none.
        """

    def gui_scale(self) -> int:
        """Return framebuffer pixels to a GUI pixel of menus, chat and hotbar, as last seen."""

    def seen_scales(self) -> Scales | None:
        """Return both scales if they were seen in a window of the present size; None if not."""


def seen_gui_scale(screen: GameScreen) -> int | None:
    """Return the scale of the chat, to blank it; None where it isn't seen, and may be any."""
    scales = screen.seen_scales()
    return scales.gui if scales else None


class WindowScreen:
    """The game's window as pixels.

    Args:
        display: the game's window.
        font: the font that reads it.
        overlay: how the debug screen is drawn; without it that is found.
        version: the game's. From 1.21.9 on the debug screen lies over menus, so that reading it doesn't show that none
            is open.
    """

    def __init__(self, display: Display, font: Font, overlay: Overlay | None = None, version: str = "") -> None:
        self.font = font
        self._display, self._font, self._overlay = display, font, overlay
        self._reader = ScreenReader(display, font, overlay)
        is_standin = overlay is not None and overlay.layout.name == STANDIN.name
        self._text_over_menus = not is_standin and draws_text_over_menus(version)
        self._needs_hotbar = self._text_over_menus
        """Whether a hotbar that isn't seen means a menu: from 1.21.9 on; before, once it was seen as the game's own."""
        self._gui: tuple[tuple[int, int], int] | None = None
        self._debug: tuple[tuple[int, int], int] | None = None

    @property
    def last_look(self) -> Look | None:
        """The look that the last reading was taken from."""
        return self._reader.last_look

    def read(self) -> Reading:
        reading, look = self._reader.read(), self._reader.last_look
        if self._debug and look and look.lines and look.lines.overlay.scale != self._debug[1]:
            # The GUI scale was changed in the same window.
            self._debug = self._display.size(), look.lines.overlay.scale
            self._gui = self._gui if self._text_over_menus else self._debug
        return reading

    def read_position(self) -> tuple[float, float, float] | None:
        return self._reader.read_position()

    def shows_world(self) -> bool:
        # The picture that shows most comes last: what opens meanwhile is on it.
        if self._is_paused():
            return False
        look, dots = self._look_at_hotbar()
        if not self._needs_hotbar and look is None:
            # Every menu dims the debug screen, so where that is read none is open.
            is_read = self.read_position() is not None or self.read().problem is None
            return is_read and not self.is_chat_open()
        self._needs_hotbar |= look == "clear"
        return look == "clear" and not begins_a_line(typed_dots(dots), self._font)

    def shows_death(self) -> bool:
        return self._look_at_hotbar()[0] == "death"

    def is_chat_open(self) -> bool:
        return begins_a_line(self._typed_line(FIRST_COLUMNS), self._font)

    def is_typed(self, text: str) -> bool:
        return reads_as(self._typed_line(), text, self._font)

    def menu(self) -> Labels:
        return MenuLabels(self._display.grab(), self._font, is_under_text=self._text_over_menus)

    def position_of(self, text: str) -> tuple[int, int] | None:
        frame, columns = self._display.grab(), self._font.columns(text)
        for scale in SCALES:
            if found := GlyphGrid(frame, scale, min(WHITE) - INK_SPREAD).find(columns + b"\0" * SPACE):
                row, column = min(found)
                return int((column + len(columns) / 2) * scale), (row + GLYPH_ROWS // 2) * scale
        return None

    def gui_scale(self) -> int:
        seen = self._seen_gui_scale()
        if seen is None and self._gui is None:
            return self._scale_of_menu() or self._seen_debug_scale() or 1
        return seen or (self._gui[1] if self._gui else 1)

    def seen_scales(self) -> Scales | None:
        gui, debug = self._seen_gui_scale(), self._seen_debug_scale()
        return Scales(gui, debug) if gui and debug else None

    def _seen_gui_scale(self) -> int | None:
        """Return the GUI scale: to 1.21.8 that of the debug screen, later the hotbar's."""
        size = self._display.size()
        if self._gui is None or self._gui[0] != size:
            if not self._text_over_menus:
                debug = self._seen_debug_scale()
                self._gui = (size, debug) if debug else self._gui
            else:
                self._look_at_hotbar()
        return self._gui[1] if self._gui and self._gui[0] == size else None

    def _seen_debug_scale(self) -> int | None:
        size = self._display.size()
        if self._debug is None or self._debug[0] != size:
            overlay = self._overlay or find_overlay(self._display.grab(), self._font)
            if overlay is None:
                return None
            self._debug = size, overlay.scale
        return self._debug[1]

    def _look_at_hotbar(self) -> tuple[HotbarLook | None, Frame]:
        """Return how the hotbar looks, and the dots of its region, if it is seen; the scale is kept."""
        size = self._display.size()
        scale = self._gui[1] if self._gui and self._gui[0] == size else None
        if scale is None and not self._text_over_menus:
            scale = self._seen_gui_scale()
        if scale is not None:
            dots = dots_in(self._display.grab(bottom_region(size, scale)), scale)
            look = hotbar_look(dots, -(-size[1] // scale))
            if look or not self._needs_hotbar:
                return look, dots
        frame = self._display.grab()
        for scale in range(largest_gui_scale(size) + 1, 0, -1):
            region = bottom_region(size, scale)
            dots = dots_in(frame[region.slices], scale)
            if look := hotbar_look(dots, -(-size[1] // scale)):
                self._gui = size, scale
                return look, dots
        return None, frame

    def _is_paused(self) -> bool:
        """Return whether the game is paused without a menu (FACTS: Screens and their buttons)."""
        scale = self._seen_gui_scale()
        if scale is None:
            return False
        region = pause_region(self._display.size(), scale)
        return shows_pause(self._display.grab(region), scale, self._font)

    def _scale_of_menu(self) -> int | None:
        frame = self._display.grab()
        return next((scale for scale in SCALES if MenuLabels(frame, self._font, scale).shows(WORLDS_TITLE)), None)

    def _typed_line(self, columns: int | None = None) -> Frame:
        scale = self.gui_scale()
        return dots_in(self._display.grab(typed_line_region(self._display.size(), scale, columns)), scale)
