"""The last frames before it was given up: of the game's window alone, the chat blanked, to look at what went wrong."""

from collections import deque
from collections.abc import Callable
from pathlib import Path

import cv2

from mc_nested.live.devices import Display, Frame

KEPT = 3

_CHAT_WIDTH, _CHAT_HEIGHT = 330, 220
"""GUI pixels from the window's lower left corner that hold the chat, open or not (FACTS: Answers)."""


class LastFrames:
    """Keeps a few frames in memory, and writes them only when asked to.

    Args:
        display: the game's window.
        folder: where they are written; without one, nothing is kept.
        scale: gives the framebuffer pixels to a GUI pixel.
    """

    def __init__(self, display: Display, folder: Path | None, scale: Callable[[], int]) -> None:
        self._display, self._folder, self._scale = display, folder, scale
        self._frames: deque[Frame] = deque(maxlen=KEPT)

    def take(self) -> None:
        """Keep what is seen now, if it is the game that is seen."""
        if self._folder is not None and self._display.is_in_front():
            self._frames.append(without_chat(self._display.grab(), self._scale()))

    def save(self) -> list[Path]:
        """Write what was kept, the oldest first; the files, none where a disk refuses."""
        if self._folder is None:
            return []
        self._folder.mkdir(parents=True, exist_ok=True)
        paths = [self._folder / f"last-{index + 1}.png" for index in range(len(self._frames))]
        return [path for path, frame in zip(paths, self._frames, strict=True) if cv2.imwrite(str(path), frame)]


def without_chat(frame: Frame, scale: int) -> Frame:
    """A frame (height, width, 3) with black where the chat is, in a copy."""
    blanked: Frame = frame.copy()
    blanked[max(0, frame.shape[0] - _CHAT_HEIGHT * scale) :, : _CHAT_WIDTH * scale] = 0
    return blanked
