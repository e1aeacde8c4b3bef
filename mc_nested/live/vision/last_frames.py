"""The last frames before a failure, to look at what went wrong: of the game's window alone, the chat blanked."""

from collections import deque
from collections.abc import Callable
from pathlib import Path

import cv2

from mc_nested.live.devices import Display, Frame
from mc_nested.live.vision.chat_region import without_chat

KEPT = 3


class LastFrames:
    """Keeps the last few frames in memory, and writes them on request.

    Args:
        display: the game's window.
        folder: where they are written; without one, nothing is kept.
        gui_scale: gives the chat's scale, framebuffer pixels to a GUI pixel, None where it isn't known.
    """

    def __init__(self, display: Display, folder: Path | None, gui_scale: Callable[[], int | None]) -> None:
        self._display, self._folder, self._gui_scale = display, folder, gui_scale
        self._frames: deque[Frame] = deque(maxlen=KEPT)

    def take(self) -> None:
        """Keep what the window shows now, if it is in front."""
        if self._folder is not None and self._display.is_in_front():
            self._frames.append(without_chat(self._display.grab(), self._gui_scale()))

    def save(self) -> list[Path]:
        """Write the kept frames, the oldest first; returns the files that could be written."""
        if self._folder is None:
            return []
        self._folder.mkdir(parents=True, exist_ok=True)
        paths = [self._folder / f"last-{index + 1}.png" for index in range(len(self._frames))]
        return [path for path, frame in zip(paths, self._frames, strict=True) if cv2.imwrite(str(path), frame)]
