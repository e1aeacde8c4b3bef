"""The screen of a recording: readings are taken anew from its pixels, with today's reader.

What the chat and menus showed is as recorded.
"""

from collections import deque
from collections.abc import Callable
from typing import Any

import numpy as np
from pydantic import TypeAdapter

from mc_nested.errors import RecordingError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.reading import XYZ, Reading
from mc_nested.live.recording.call_encoder import KeptPicture, draw
from mc_nested.live.recording.format import plain_value
from mc_nested.live.recording.replayed_devices import OnReplayedTape, ReplayedTape
from mc_nested.live.recording.text_pixels import OUTSIDE, TextPixels, paint
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.game_screen import Labels, WindowScreen
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS
from mc_nested.live.vision.layout import Overlay, Scales
from mc_nested.live.vision.menu_labels import MenuButton

_PICTURES = 64
"""Pictures that are kept in memory; a call names one that came shortly before."""


class PixelReader:
    """Shows what a call's pixels were to the reader of this version, which then reads them as it would a window.

    Args:
        size: the window's width and height when the recording began.
        font: the font that reads it.
        overlay: how the debug screen is drawn, as the run's profile says; None where it doesn't.
    """

    def __init__(self, size: tuple[int, int], font: Font, overlay: Overlay | None = None) -> None:
        self._font, self._given = font, overlay
        self.pictures = deque[KeptPicture](maxlen=_PICTURES)
        """Those that a call may name, the newest last."""
        self._first_size = size
        self._resize(size)

    def _resize(self, size: tuple[int, int]) -> None:
        """Take in that the window has another size now."""
        width, height = size
        self.canvas: Frame = np.full((height, width, 3), OUTSIDE, np.uint8)
        self._painted: list[slice] = []
        self._overlay = self._given
        self._screen = WindowScreen(_Canvas(self), self._font, self._overlay)

    def shown(self, pixels: Any) -> WindowScreen | None:
        """Return the screen with a call's pixels on it; None where they were not kept, or don't suffice.

        Raise RecordingError where they are damaged.
        """
        if not isinstance(pixels, dict):
            return None
        try:
            width, height = pixels.get("size", self._first_size)
            if self.canvas.shape[:2] != (height, width):
                self._resize((int(width), int(height)))
            if "text" in pixels:
                self._show_text(TextPixels.from_json(pixels["text"]))
                return self._screen
            picture = next((each for each in self.pictures if each.index == pixels["picture"]), None)
            if picture is None or not pixels["is_enough"]:
                return None
            self._show_picture(picture)
            return self._screen
        except (KeyError, TypeError, ValueError, IndexError) as error:
            raise RecordingError(f"pixels of a reading are damaged ({error!r}): cut that part away") from error

    def _show_text(self, text: TextPixels) -> None:
        if text.overlay != self._overlay:
            self._overlay = text.overlay
            self._screen = WindowScreen(_Canvas(self), self._font, text.overlay)
        for rows in self._painted:
            self.canvas[rows] = OUTSIDE
        paint(self.canvas, text)
        scale = text.overlay.scale
        self._painted = [slice(line.row * scale, (line.row + GLYPH_ROWS) * scale) for line in text.lines]

    def _show_picture(self, picture: KeptPicture) -> None:
        self.canvas[:] = OUTSIDE
        self._painted = [slice(0, len(self.canvas))]
        draw([picture], self.canvas)
        # A text later has its own overlay, and makes a screen for it.
        self._overlay = None
        self._screen = WindowScreen(_Canvas(self), self._font, self._given)


class _Canvas:
    """A display that shows the canvas."""

    def __init__(self, reader: PixelReader) -> None:
        self._reader = reader

    def size(self) -> tuple[int, int]:
        height, width = self._reader.canvas.shape[:2]
        return width, height

    def title(self) -> str:
        return ""

    def is_in_front(self) -> bool:
        return True

    def grab(self, region: Region | None = None) -> Frame:
        canvas = self._reader.canvas
        return canvas if region is None else canvas[region.slices]


_READING, _POSITION, _BUTTON = TypeAdapter(Reading), TypeAdapter[XYZ | None](XYZ | None), TypeAdapter(MenuButton)
"""What was answered, from its plain values; ValueError where they are others."""


class ReplayedScreen:
    """A screen that answers as it was recorded, whatever is read now: so the replay can go on.

    Args:
        tape: the calls.
        pixels: reads them anew.
        on_reading: is told what was read then and what is read now, as plain values, None where the pixels are not
            there.
    """

    def __init__(self, tape: ReplayedTape, pixels: PixelReader, on_reading: Callable[[Any, Any | None], None]) -> None:
        self._tape, self._pixels, self._on_reading = tape, pixels, on_reading

    def read(self) -> Reading:
        then, pixels = self._tape.same("screen", "read", [])
        self.read_again("read", then, pixels)
        return _READING.validate_python(then)

    def read_position(self) -> XYZ | None:
        then, pixels = self._tape.same("screen", "read_position", [])
        self.read_again("read_position", then, pixels)
        return _POSITION.validate_python(then)

    def read_again(self, name: str, then: Any, pixels: Any) -> None:
        """Read the pixels of a recorded call anew, and report both readings."""
        screen = self._pixels.shown(pixels)
        if screen is None:
            self._on_reading([then], None)
        elif name == "read":
            self._on_reading([then], [plain_value(screen.read())])
        else:
            # A quick look reads nothing where the reading before it didn't say where: that one differs then, not this.
            position = screen.read_position()
            self._on_reading([then], None if position is None else [plain_value(position)])

    def shows_world(self) -> bool:
        return bool(self._answer("shows_world"))

    def shows_death(self) -> bool:
        return bool(self._answer("shows_death"))

    def is_chat_open(self) -> bool:
        return bool(self._answer("is_chat_open"))

    def is_typed(self, text: str) -> bool:
        return bool(self._answer("is_typed", text))

    def menu(self) -> Labels:
        self._answer("menu")
        return _Labels(self._tape)

    def position_of(self, text: str) -> tuple[int, int] | None:
        position = self._answer("position_of", text)
        return None if position is None else (int(position[0]), int(position[1]))

    def gui_scale(self) -> int:
        return int(self._answer("gui_scale"))

    def seen_scales(self) -> Scales | None:
        if not self._tape.is_followed:
            return None
        scales = self._answer("seen_scales")
        return None if scales is None else Scales(*map(int, scales))

    def _answer(self, name: str, *asked: str) -> Any:
        return self._tape.same("screen", name, list(asked))[0]


class _Labels(OnReplayedTape):
    def shows(self, text: str) -> bool:
        return bool(self._tape.same("menu", "shows", text)[0])

    def button(self, label: str) -> MenuButton:
        return _BUTTON.validate_python(self._tape.same("menu", "button", label)[0])
