"""The lines of one frame's debug screen, asked for by how they begin."""

import re
from collections.abc import Mapping

from mc_nested.live.font import Font
from mc_nested.live.overlay import VANILLA_PITCH, Place, Sight, places_of
from mc_nested.live.text_lines import UNKNOWN, Line, line_from, line_up_to

WHOLE = r"(-?(?:0|[1-9]\d{0,7}))"
"""A whole number as the game prints it: no zeros before it, and no coordinate has more than eight digits."""

CLEAR = "clear the chat (F3+D), close what lies over it, or widen the window"


class Unreadable(Exception):  # noqa: N818 - no error: it carries the reason why a frame gives no reading up to the Reading
    """Why this frame gives no reading."""


class Screen:
    """A frame's debug screen with the font that reads it. It keeps what was asked for, so that it can be reread.

    Args:
        sight: the debug screen.
        font: the font that reads it.
        remembered: where the lines that are asked for should stand, by how they begin; without it they are looked for.
    """

    def __init__(self, sight: Sight, font: Font, remembered: Mapping[str, list[Place]] | None = None) -> None:
        self.sight = sight
        self.places_seen: dict[str, list[Place]] = {}
        self.rows_read: set[int] = set()
        self._font = font
        self._remembered = remembered
        self._lines: dict[Place, Line] = {}

    def places(self, prefix: str) -> list[Place]:
        """Each (row, column) at which ``prefix`` stands. Unreadable if it no longer stands where it is remembered."""
        if prefix not in self.places_seen:
            self.places_seen[prefix] = self._found(prefix) if self._remembered is None else self._seen_again(prefix)
        return self.places_seen[prefix]

    def line(self, prefix: str) -> Line | None:
        """The one line that begins with ``prefix``, or None. Two of them are unreadable: one may be somebody's chat."""
        places = self.places(prefix)
        if len(places) > 1:
            raise Unreadable(f"{len(places)} lines begin with {prefix.strip()!r}: {CLEAR}")
        return self.line_at(*places[0]) if places else None

    def line_at(self, row: int, column: int) -> Line:
        """The line that begins there. In vanilla's right column text ends three dots before the window does."""
        if (row, column) not in self._lines:
            dots, overlay = self.sight.dots, self.sight.overlay
            edge = self._right_edge if overlay.pitch == VANILLA_PITCH else None
            self._lines[row, column] = line_from(dots, self._font, overlay, row, column, edge)
            self.rows_read.add(row)
        return self._lines[row, column]

    def without_what_follows(self, line: Line, text: str) -> Line:
        """A line read up to the end of ``text``, with which it begins: the rest is the world beside the line's box.

        Only in the left column: what stands in the right one ends where the column does.
        """
        if text == line.text:
            return line
        if self.is_left(line) and UNKNOWN not in text:
            end = line.start + len(self._font.columns(text)) - 2
            shorter = line_from(self.sight.dots, self._font, self.sight.overlay, line.row, line.start, end)
            if shorter.text == text:
                return shorter
        raise Unreadable(f"a line reads {shown(line.text)}: {CLEAR}")

    def right_column(self) -> list[Line]:
        """The lines of vanilla's right column, the upper ones first."""
        dots = self.sight.dots
        rows = range(dots.first, dots.rows, dots.pitch)
        return [line for row in rows if (line := self.line_ending(row, self._right_edge))]

    def line_ending(self, row: int, end: int) -> Line | None:
        """The line whose last ink is in column ``end``, or None."""
        self.rows_read.add(row)
        return line_up_to(self.sight.dots, self._font, self.sight.overlay, row, end)

    def is_left(self, line: Line) -> bool:
        """Whether a line stands in the left column: those of the right one begin farther right on any screen."""
        return line.start < self.sight.dots.columns // 4

    @property
    def _right_edge(self) -> int:
        return -(-int(self.sight.dots.frame.shape[1]) // self.sight.dots.scale) - 4

    def _found(self, prefix: str) -> list[Place]:
        return places_of(self.sight.dots, self._font, prefix)

    def _seen_again(self, prefix: str) -> list[Place]:
        places = (self._remembered or {}).get(prefix, [])
        if not all(self.line_at(*place).text.startswith(prefix) for place in places):
            raise Unreadable(f"the line that began with {prefix.strip()!r} is not where it was: {CLEAR}")
        return places


def matched(form: re.Pattern[str], line: Line | None) -> tuple[str, ...]:
    """The groups of a line that has this form as a whole; unreadable if it hasn't."""
    match = form.fullmatch(line.text) if line else None
    if match is None:
        raise Unreadable(f"a line reads {shown(line.text if line else '')}: {CLEAR}")
    return match.groups()


def check_whole(line: Line) -> None:
    """A line whose end may be covered is unreadable."""
    if not line.whole:
        raise Unreadable(f"the end of {shown(line.text)} may be covered: {CLEAR}")


def shown(text: str) -> str:
    """A line's text for a message, with ``?`` for what matched no glyph."""
    return repr(text.replace(UNKNOWN, "?"))
