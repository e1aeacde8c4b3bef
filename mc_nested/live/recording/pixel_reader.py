"""Reads a recording's pixels anew, with today's reader."""

from collections import OrderedDict
from typing import Any

import cv2
import numpy as np

from mc_nested.errors import RecordingError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.recording.call_encoder import KeptPicture
from mc_nested.live.recording.plain_values import region_of
from mc_nested.live.recording.text_pixels import OUTSIDE, TextPixels, paint
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.game_screen import WindowScreen
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS
from mc_nested.live.vision.layout import Overlay

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
        self._pictures: OrderedDict[int, KeptPicture] = OrderedDict()
        self._first_size = size
        self._resize(size)

    def _resize(self, size: tuple[int, int]) -> None:
        """The window has another size now."""
        width, height = size
        self.canvas: Frame = np.full((height, width, 3), OUTSIDE, np.uint8)
        self._painted: list[slice] = []
        self._overlay = self._given
        self._screen = WindowScreen(_Canvas(self), self._font, self._overlay)

    def keep(self, picture: KeptPicture) -> None:
        """Keep a picture for the calls that name it."""
        self._pictures[picture.index] = picture
        while len(self._pictures) > _PICTURES:
            self._pictures.popitem(last=False)

    def shown(self, pixels: Any) -> WindowScreen | None:
        """The screen with a call's pixels on it; None where they were not kept, or don't suffice.

        RecordingError where they are damaged.
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
            picture = self._pictures.get(pixels["picture"])
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
        frame = cv2.imdecode(np.frombuffer(picture.png, np.uint8), cv2.IMREAD_COLOR)
        if frame is None:
            raise ValueError("a picture that is none")
        height, width = self.canvas.shape[:2]
        region = region_of(picture.region) or Region(0, 0, width, height)
        self.canvas[:] = OUTSIDE
        self._painted = [slice(0, height)]
        part = self.canvas[region.top : region.top + region.height, region.left : region.left + region.width]
        if part.shape != frame.shape:
            raise ValueError("a picture of another size")
        part[:] = frame
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
        if region is None:
            return canvas
        return canvas[region.top : region.top + region.height, region.left : region.left + region.width]
