"""Whether a picture shows more than the game's window, as one of the whole desktop does.

The first line stands in the window's upper left corner, and the lines of the right column end at its right side
(FACTS: The F3 debug screen; The stand-in).
"""

from mc_nested.live.vision.facts import fact_from
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GridPosition
from mc_nested.live.vision.overlay import FoundScreen
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.text_lines import UNKNOWN, is_text

_CORNERS = {"vanilla": ((2, 2),), "boxes": ((2, 3), (2, 6)), "stand-in": ((1, 1),)}
"""Row and column of the first line's first dot by the layout; of boxes, a line's and a title's."""

_ON_THE_RIGHT = "Java: "
"""How the right column begins in every version of the game."""


def shows_more_than_window(found: FoundScreen, font: Font) -> bool:
    """Whether the debug screen that was found there stands elsewhere than in its window's corner, or is narrower."""
    lines = ScreenLines(found.dots, font, found.overlay)
    if not any(_begins(found, font, corner) for corner in _CORNERS[lines.layout.name]):
        return True
    has_right_side = lines.layout.name == "vanilla" and lines.holds(_ON_THE_RIGHT)
    return has_right_side and not lines.right_column()


def _begins(found: FoundScreen, font: Font, corner: GridPosition) -> bool:
    if not found.overlay.layout.has_facts:
        return is_text(found.dots, font, found.overlay, corner)
    text = fact_from(found.dots, font, found.overlay, corner).text
    return len(text) > 2 and UNKNOWN not in text[:3]
