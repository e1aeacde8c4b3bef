"""The chat on the game's window: where it lies, pictures without it, and how many lines it shows.

What others said is private. Lines of nine GUI pixels, 320 wide, end 40 above the lower edge, in 1.12 48, twenty of them
while somebody types; below them are what is being typed, at the very bottom, and what the game says of it
(FACTS: Answers; Screens and their buttons). Everything that any of these versions may use is blanked, whether the chat
is open or not. The last frames before a failure are kept like that, to look at what went wrong.

Over the world, what was sent within ten seconds is counted, not seen: a line that covers a part of the debug screen
makes all of it unreadable, and then nothing may be pressed (FACTS: Answers).
"""

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import cv2
import numpy as np

from mc_nested.live.devices import Display, Frame, Region
from mc_nested.live.model.versions import draws_text_over_menus, version_numbers
from mc_nested.live.vision.layout import LINE_PITCH, largest_gui_scale

BLANK = (96, 96, 96)
"""Grey, as blue green red: no world is quite like it, and no text of the game has it."""

LINES = 20
"""Lines that the chat shows at most: 180 GUI pixels."""

_BOTTOM = 40 - 2
"""Above the lower edge: where the lowest line ends, the shadows of its letters included. All below it is blanked."""

_HIGHEST_BOTTOM = 48

_WIDTH = 320 + 12
"""Blocks of text begin 4 dots from the left, and their background ends 4 behind them; 4 more for a thick edge."""


def chat_regions(size: tuple[int, int], scale: int | None) -> tuple[Region, ...]:
    """Return where the chat's messages and the line being typed lie in a window (width, height), cut to the window.

    Without a GUI scale the regions hold those of every scale that the window can have.
    """
    width, height = size
    largest = _largest(size) if scale is None else scale
    top = max(0, height - (_HIGHEST_BOTTOM + LINES * LINE_PITCH) * largest)
    strip = max(0, height - _BOTTOM * largest)
    bottom = height if scale is None else strip
    return (
        Region(0, top, min(width, _WIDTH * largest), bottom - top),
        Region(0, strip, width, height - strip),
    )


def messages_region(size: tuple[int, int], scale: int) -> Region:
    """Return where messages show while the chat is closed, ten at most, in a window (width, height), cut to it."""
    width, height = size
    top = max(0, height - (_HIGHEST_BOTTOM + LINES // 2 * LINE_PITCH) * scale)
    return Region(0, top, min(width, _WIDTH * scale), max(0, height - _BOTTOM * scale) - top)


def without_chat(frame: Frame, scale: int | None, opaque: Sequence[Region] = ()) -> Frame:
    """Return a copy of a whole window's picture, (height, width, 3), its chat blanked.

    ``scale`` is None where not known.

    ``opaque`` are regions that nothing shines through, as a menu's buttons: they are kept.
    """
    blanked: Frame = frame.copy()
    height, width = frame.shape[:2]
    blank_chat(blanked, (width, height), scale)
    for region in opaque:
        blanked[region.slices] = frame[region.slices]
    return blanked


def blank_chat(frame: Frame, size: tuple[int, int], scale: int | None, left: int = 0, top: int = 0) -> None:
    """Blank the chat on a picture of a part of a window of that size, whose corner is at ``left`` and ``top`` there."""
    for region in chat_regions(size, scale):
        frame[Region(region.left - left, region.top - top, region.width, region.height).slices] = BLANK


def blanked_share(size: tuple[int, int], scale: int | None) -> float:
    """Return how much of a window (width, height) is blanked, 0 to 1."""
    width, height = size
    is_blank = np.zeros((height, width), dtype=np.bool_)
    for region in chat_regions(size, scale):
        is_blank[region.slices] = True
    return float(is_blank.mean())


def _largest(size: tuple[int, int]) -> int:
    """Return the largest GUI scale of a window.

    An odd one is one more with a Unicode font (FACTS: The F3 debug screen).
    """
    largest = largest_gui_scale(size)
    return largest + largest % 2


KEPT = 3


class LastFrames:
    """Keeps the last few frames in memory, and writes them on request.

    Args:
        display: the game's window.
        folder: where they are written; without one, nothing is.
        gui_scale: gives the chat's scale, framebuffer pixels to a GUI pixel, None where it isn't known.
    """

    def __init__(self, display: Display, folder: Path | None, gui_scale: Callable[[], int | None]) -> None:
        self._display, self._folder, self._gui_scale = display, folder, gui_scale
        self._frames: deque[Frame] = deque(maxlen=KEPT)

    def take(self) -> None:
        """Keep what the window shows now, if it is in front.

        With or without a folder: a replay, which has none, must ask its devices what the run asked.
        """
        if self._display.is_in_front():
            self._frames.append(without_chat(self._display.grab(), self._gui_scale()))

    def save(self) -> list[Path]:
        """Write the kept frames, the oldest first; return the files that could be written."""
        if self._folder is None:
            return []
        self._folder.mkdir(parents=True, exist_ok=True)
        paths = [self._folder / f"last-{index + 1}.png" for index in range(len(self._frames))]
        return [path for path, frame in zip(paths, self._frames, strict=True) if cv2.imwrite(str(path), frame)]


SHOWN_S = 10.0
"""How long a line shows."""

_ANSWER_S = 1.0
"""By how much an answer may come later than what was sent."""

_MOST = 10
"""Lines that show at most."""

_ANSWERS = {"/fill": 1, "/item": 1, "/replaceitem": 1, "/tp": 2}
"""Lines of an answer, 320 GUI pixels wide: the place of a teleport may need a second."""

_LONGEST_ANSWER = 3

_LOWEST_HEIGHT, _LINE = 240, 9
"""GUI pixels: the height of the smallest window, which the room is counted in, and of a line."""


class ChatLines:
    """The lines sent through the chat of one game, and when; times are the clock's, in seconds."""

    def __init__(self) -> None:
        self._sent: deque[tuple[float, int]] = deque(maxlen=_MOST)

    def note(self, command: str, now: float) -> None:
        """Take in that a command was sent."""
        self._sent.append((now, answer_lines(command)))

    def after(self, command: str, now: float) -> int:
        """Return how many lines may show once a command is answered."""
        shown = sum(lines for sent, lines in self._sent if now - sent < SHOWN_S + _ANSWER_S)
        return shown + answer_lines(command) if shown else 0

    def forget(self) -> None:
        """Take in that the chat was cleared."""
        self._sent.clear()

    @property
    def state(self) -> tuple[tuple[float, int], ...]:
        """The lines sent so far: when each was sent, and how many lines its answer may take."""
        return tuple(self._sent)

    def go_on_from(self, state: Iterable[tuple[float, int]]) -> None:
        """Go on with another game's ``state``, of the same clock."""
        self._sent = deque(state, maxlen=_MOST)


def answer_lines(command: str) -> int:
    """Return how many lines the answer to a command may take."""
    return _ANSWERS.get(command.split(" ", 1)[0], _LONGEST_ANSWER)


def chat_room(version: str, gui_height: int = _LOWEST_HEIGHT) -> int | None:
    """Return how many lines cover nothing that is read, by the window's height in GUI pixels; None: any, or no remedy.

    To 1.12 and, lower, to 1.15 the place of the block looked at is in the left column. To 1.8 no key clears the chat;
    from 1.21.9 on the debug screen lies over it (FACTS: The F3 debug screen; Keys).
    """
    numbers = version_numbers(version)
    if numbers < (1, 9) or draws_text_over_menus(version):
        return None
    room = 6 if numbers < (1, 13) else 4 if numbers < (1, 16) else 8
    return room + max(0, gui_height - _LOWEST_HEIGHT) // _LINE
