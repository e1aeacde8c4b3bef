"""From calls on a tape to what a recording writes: plain values, and pictures of the window where they are worth it.

A reading comes with its lines' ink, if the same is read from that alone. The whole picture is kept, the chat blanked,
where a frame could not be read, where no block is looked at, where the ink is not enough, and every few seconds; all
that within a budget of so many bytes a second on average, and some at once. Pixels of a window that was resized name
its size.
"""

import time
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from mc_nested.errors import RecordingError
from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.reading import Reading
from mc_nested.live.recording.format import Call, plain_value
from mc_nested.live.recording.text_pixels import TextPixels, paint, reads_the_same, text_pixels_of
from mc_nested.live.vision.chat_region import blank_chat
from mc_nested.live.vision.debug_screen import read_debug_screen, read_lines, read_position
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GlyphGrid
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.screen_reader import Look

BYTES_A_SECOND = 60_000
"""Of pictures, 3.6 MB a minute."""

AT_ONCE = 3_000_000
"""Bytes, about one picture of a large window that can't be packed well."""

PICTURE_EVERY_S = 5.0
"""Seconds from one whole picture to the next while all goes well."""


@dataclass(frozen=True)
class KeptPicture:
    """A picture of the window, or of the region [left, top, width, height] of it, as PNG, the chat blanked."""

    index: int
    region: list[int] | None
    png: bytes


def draw(pictures: Iterable[KeptPicture], window: Frame) -> None:
    """Draw pictures on that of the whole window, cut off at its edges; RecordingError if one is damaged."""
    for each in pictures:
        picture = cv2.imdecode(np.frombuffer(each.png, np.uint8), cv2.IMREAD_COLOR)
        if picture is None:
            raise RecordingError("a picture of the window is damaged: cut that part of the recording away")
        part = window[Region(*each.region).slices] if each.region else window
        height, width = np.minimum(part.shape[:2], picture.shape[:2])
        part[:height, :width] = picture[:height, :width]


class CallEncoder:
    """Encodes calls one after the other.

    Args:
        size: gives the window's width and height.
    """

    font: Font | None = None
    """The font that reads it; None while it isn't known."""

    def __init__(self, size: tuple[int, int]) -> None:
        self.size = size
        self._first_size = size
        self._bytes_left, self._looked_at = float(AT_ONCE), time.monotonic()
        self._pictured_at = -PICTURE_EVERY_S
        self._index = 0

    def encode(self, call: Call) -> tuple[list[Any], list[KeptPicture]]:
        """Return a call as plain values, and the pictures that belong to it."""
        if call[0] == "size":
            self.size = call[1]
        if call[0] == "grab":
            return self._grab(*call[1:])
        if call[0] == "screen" and isinstance(call[-1], Look):
            return self._reading(call)
        return plain_value(call), []

    def _grab(self, region: Region | None, frame: Frame) -> tuple[list[Any], list[KeptPicture]]:
        pictures = self._picture(self._without_chat(frame, region, None), region)
        return ["grab", plain_value(region), pictures[0].index if pictures else None], pictures

    def _reading(self, call: Call) -> tuple[list[Any], list[KeptPicture]]:
        *said, answer, look = call
        if look.region is None:
            self.size = look.frame.shape[1], look.frame.shape[0]
        text = text_pixels_of(look)
        is_read = answer is not None and (not isinstance(answer, Reading) or answer.target is not None)
        kept: dict[str, Any] | None = None
        if text is not None and is_read and self.font and reads_the_same(text, look, answer, self.font):
            kept = {"text": text.to_json()}
        pictures: list[KeptPicture] = []
        is_due = time.monotonic() - self._pictured_at >= PICTURE_EVERY_S
        if kept is None or is_due:
            blanked = self._without_chat(look.frame, look.region, text)
            pictures = self._picture(blanked, look.region)
            if pictures and kept is None:
                kept = {"picture": pictures[0].index, "is_enough": self._is_enough(blanked, look, answer)}
        if kept is not None and self.size != self._first_size:
            kept["size"] = list(self.size)
        return [*(plain_value(each) for each in said), plain_value(answer), kept], pictures

    def _without_chat(self, frame: Frame, region: Region | None, text: TextPixels | None) -> Frame:
        """Return a copy without the chat, at whichever scale it may be.

        The lines that were read are drawn again over that.
        """
        left, top = (region.left, region.top) if region else (0, 0)
        blanked: Frame = frame.copy()
        if region is None:
            self.size = frame.shape[1], frame.shape[0]
        blank_chat(blanked, self.size, None, left, top)
        if text is not None and region is None:
            drawn = blanked.copy()
            paint(drawn, text)
            hidden = (blanked != frame).any(axis=2)
            blanked[hidden] = drawn[hidden]
        return blanked

    def _picture(self, blanked: Frame, region: Region | None) -> list[KeptPicture]:
        now = time.monotonic()
        self._bytes_left = min(AT_ONCE, self._bytes_left + (now - self._looked_at) * BYTES_A_SECOND)
        self._looked_at = now
        if blanked.size == 0 or self._bytes_left <= 0:
            return []
        _, png = cv2.imencode(".png", blanked, [cv2.IMWRITE_PNG_COMPRESSION, 1])
        self._bytes_left -= len(png)  # known only once it is packed: the last picture may overdraw it
        self._pictured_at = now
        self._index += 1
        return [KeptPicture(self._index, plain_value(region), png.tobytes())]

    def _is_enough(self, blanked: Frame, look: Look, answer: object) -> bool:
        """Return whether the picture without the chat gives the same answer."""
        lines = look.lines
        if self.font is None:
            return False
        if look.region is None:
            return bool(read_debug_screen(blanked, self.font, lines.overlay if lines else None) == answer)
        if lines is None:
            return False
        dots = GlyphGrid(blanked, lines.overlay.scale, lines.dots.least, lines.dots.first, lines.dots.pitch)
        again = ScreenLines(dots, self.font, lines.overlay, lines.positions_seen)
        return (read_lines(again) if isinstance(answer, Reading) else read_position(again)) == answer
