"""The stand-in's debug screen: its layout, and how it shows the block looked at (FACTS: The stand-in).

It stands in the right column: the block's name without a namespace, its properties, then ``Looking at: x y z``.
"""

import re

from mc_nested.live.vision.layout import WHITE, Box, ScreenLayout
from mc_nested.live.vision.screen_lines import CLEAR, DebugLines, Unreadable, check_whole, only_line, shown
from mc_nested.live.vision.text_lines import UNKNOWN, Line

STANDIN = ScreenLayout(
    name="stand-in",
    pitch=10,
    text_colour=WHITE,
    box=Box(grey=110, behind=1),
    has_one_grid=False,
    right_edge=None,
    has_target_column=True,
)

_NAME = re.compile(r"[a-z0-9_]+")
_PROPERTY = re.compile(rf"[{UNKNOWN}a-z_0-9]+: .*")

_MOST_PROPERTIES = 12
"""Lines between a block's name and its position: no block has more properties."""


def id_above(lines: DebugLines, looking: Line) -> str:
    """Return the id of the block whose position is in the line ``looking``.

    Every line of that column ends where its first one does, so a position that ends elsewhere is not seen whole.
    """
    if looking.end != _first_on_the_right(lines).end:
        raise Unreadable(f"the end of {shown(looking.text)} may be covered: {CLEAR}")
    for above in range(1, _MOST_PROPERTIES + 1):
        line = lines.ending(looking.row - above * lines.layout.pitch, looking.end)
        if line is not None and not line.has_value and _NAME.fullmatch(line.text):
            check_whole(line)
            return line.text
        if line is not None and not _PROPERTY.fullmatch(line.text):
            raise Unreadable(f"the block's name reads {shown(line.text)}: {CLEAR}")
    raise Unreadable(f"the name of the block looked at can't be seen: {CLEAR}")


def check_right_column_is_empty(lines: DebugLines) -> None:
    """Raise Unreadable unless the right column's first line is alone, as when no block is looked at."""
    first, pitch = _first_on_the_right(lines), lines.layout.pitch
    for row in range(first.row + 2 * pitch - 1, first.row + (_MOST_PROPERTIES + 4) * pitch, pitch):
        line = lines.ending(row, first.end)
        if line and len(line.text.replace(UNKNOWN, "")) > 1:
            raise Unreadable(f"what {shown(line.text)} in the right column belongs to can't be seen: {CLEAR}")


def _first_on_the_right(lines: DebugLines) -> Line:
    first = only_line(lines, "Renderer: ")
    if first is None:
        raise Unreadable(f"the upper right of the debug screen can't be seen: {CLEAR}")
    return first
