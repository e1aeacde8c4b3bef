"""Whether a picture shows more than the game's window, as one of the whole desktop does.

The first line stands in the window's upper left corner, and the lines of the right column end at its right side
(FACTS: The F3 debug screen; The stand-in).
"""

from mc_nested.live.vision.debug_screen import unsupported_version
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.overlay import FoundScreen
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.text_lines import is_text

_CORNERS = ((2, 2), (1, 1))
"""Row and column of the first line's first dot: the game's, and the stand-in's."""

_ON_THE_RIGHT = "Java: "
"""How the right column begins in every version of the game."""


def shows_more_than_window(found: FoundScreen, font: Font) -> bool:
    """Whether the debug screen that was found there stands elsewhere than in its window's corner, or is narrower.

    Of a version whose layout can't be read nothing is known: False.
    """
    lines = ScreenLines(found.dots, font, found.overlay)
    if unsupported_version(lines):  # its lines stand elsewhere
        return False
    if not any(is_text(found.dots, font, found.overlay, corner) for corner in _CORNERS):
        return True
    has_right_side = lines.layout.right_edge is not None and lines.holds(_ON_THE_RIGHT)
    return has_right_side and not lines.right_column()
