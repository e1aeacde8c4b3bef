"""Where the chat lies on a picture of the game's window, and the picture without it: what others said is private.

Lines of nine GUI pixels, 320 wide, end 40 above the lower edge, in 1.12 48, twenty of them while somebody types; below
them are what is being typed, at the very bottom, and what the game says of it (FACTS: Answers; Screens and their
buttons). Everything that any of these versions may use is blanked, whether the chat is open or not.
"""

from collections.abc import Sequence

import numpy as np

from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.scales import largest_gui_scale
from mc_nested.live.vision.layout import LINE_PITCH

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
    """The chat's messages, and the strip of the line being typed, in a window (width, height), cut to the window.

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
    """Where messages show while the chat is closed, ten at most, in a window (width, height), cut to it."""
    width, height = size
    top = max(0, height - (_HIGHEST_BOTTOM + LINES // 2 * LINE_PITCH) * scale)
    return Region(0, top, min(width, _WIDTH * scale), max(0, height - _BOTTOM * scale) - top)


def without_chat(frame: Frame, scale: int | None, opaque: Sequence[Region] = ()) -> Frame:
    """A copy of a whole window's picture, (height, width, 3), its chat blanked; ``scale`` is None where not known.

    ``opaque`` are regions that nothing shines through, as a menu's buttons: they are kept.
    """
    blanked: Frame = frame.copy()
    height, width = frame.shape[:2]
    blank_chat(blanked, (width, height), scale)
    for region in opaque:
        blanked[_within(region)] = frame[_within(region)]
    return blanked


def blank_chat(frame: Frame, size: tuple[int, int], scale: int | None, left: int = 0, top: int = 0) -> None:
    """Blank the chat on a picture of a part of a window of that size, whose corner is at ``left`` and ``top`` there."""
    for region in chat_regions(size, scale):
        frame[_within(Region(region.left - left, region.top - top, region.width, region.height))] = BLANK


def blanked_share(size: tuple[int, int], scale: int | None) -> float:
    """How much of a window (width, height) is blanked, 0 to 1."""
    width, height = size
    is_blank = np.zeros((height, width), dtype=np.bool_)
    for region in chat_regions(size, scale):
        is_blank[_within(region)] = True
    return float(is_blank.mean())


def _largest(size: tuple[int, int]) -> int:
    """The largest GUI scale of a window; an odd one is one more with a Unicode font (FACTS: The F3 debug screen)."""
    largest = largest_gui_scale(size)
    return largest + largest % 2


def _within(region: Region) -> tuple[slice, slice]:
    """A region's rows and columns; what lies left of a frame or above it is cut off."""
    top, left = max(0, region.top), max(0, region.left)
    return slice(top, max(top, region.top + region.height)), slice(left, max(left, region.left + region.width))
