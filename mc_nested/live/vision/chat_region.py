"""Where the chat lies on a picture of the game's window, and the picture without it: what others said is private.

Lines of nine GUI pixels, 320 wide, end 40 above the lower edge, in 1.12 48; what is being typed stands in a bar at the
very bottom (FACTS: Answers; Screens and their buttons). Everything that any of these versions may use is blanked.
"""

from collections.abc import Sequence

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.layout import LINE_PITCH

BLANK = (96, 96, 96)
"""Grey, as blue green red: no world is quite like it, and no text of the game has it."""

CLOSED_LINES = 10
"""Lines that the chat shows at most while nobody types."""

OPEN_LINES = 20
"""Lines that it shows at most while somebody does: 180 GUI pixels."""

_BOTTOM = 40 - 2
"""Above the lower edge: where the lowest line ends, the shadows of its letters included."""

_HIGHEST_BOTTOM = 48

_WIDTH = 320 + 12
"""Blocks of text begin 4 dots from the left, and their background ends 4 behind them; 4 more for a thick edge."""

_TYPED = 14


def chat_regions(size: tuple[int, int], scale: int, lines: int = CLOSED_LINES) -> tuple[Region, ...]:
    """The chat's messages and the line being typed in a window (width, height) of that GUI scale, cut to the window."""
    width, height = size
    top = max(0, height - (_HIGHEST_BOTTOM + lines * LINE_PITCH) * scale)
    bottom = max(0, height - _BOTTOM * scale)
    typed = max(0, height - _TYPED * scale)
    return (
        Region(0, top, min(width, _WIDTH * scale), bottom - top),
        Region(0, typed, width, height - typed),
    )


def without_chat(frame: Frame, scale: int, opaque: Sequence[Region] = (), lines: int = CLOSED_LINES) -> Frame:
    """A copy of a whole window's picture, (height, width, 3), its chat of at most so many ``lines`` blanked.

    ``opaque`` are regions that nothing shines through, as a menu's buttons: they are kept.
    """
    blanked: Frame = frame.copy()
    height, width = frame.shape[:2]
    for region in chat_regions((width, height), scale, lines):
        blanked[_within(region)] = BLANK
    for region in opaque:
        blanked[_within(region)] = frame[_within(region)]
    return blanked


def _within(region: Region) -> tuple[slice, slice]:
    """A region's rows and columns; what lies left of a frame or above it is cut off."""
    top, left = max(0, region.top), max(0, region.left)
    return slice(top, max(top, region.top + region.height)), slice(left, max(left, region.left + region.width))
