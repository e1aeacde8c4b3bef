"""The lines of one frame's debug screen, asked for by how they begin."""

import re
from dataclasses import dataclass

from mc_nested.live.font import Font
from mc_nested.live.overlay import VANILLA_PITCH, Sight, places_of
from mc_nested.live.text_lines import UNKNOWN, Line, line_from, line_up_to

WHOLE = r"(-?(?:0|[1-9]\d{0,7}))"
"""A whole number as the game prints it: no zeros before it, and no coordinate has more than eight digits."""

CLEAR = "clear the chat (F3+D), close what lies over it, or widen the window"


class Unreadable(Exception):  # noqa: N818 - no error: it carries the reason why a frame gives no reading up to the Reading
    """Why this frame gives no reading."""


@dataclass(frozen=True)
class Screen:
    """A frame's debug screen with the font that reads it."""

    sight: Sight
    font: Font

    def places(self, prefix: str) -> list[tuple[int, int]]:
        """Each (row, column) at which ``prefix`` stands."""
        if prefix == self.sight.prefix:
            return list(self.sight.places)
        return places_of(self.sight.dots, self.font, prefix)

    def line(self, prefix: str) -> Line | None:
        """The one line that begins with ``prefix``, or None. Two of them are unreadable: one may be somebody's chat."""
        places = self.places(prefix)
        if len(places) > 1:
            raise Unreadable(f"{len(places)} lines begin with {prefix.strip()!r}: {CLEAR}")
        return self.line_at(*places[0]) if places else None

    def line_at(self, row: int, column: int) -> Line:
        """The line that begins there. In vanilla's right column text ends three dots before the window does."""
        dots, overlay = self.sight.dots, self.sight.overlay
        edge = self._right_edge if overlay.pitch == VANILLA_PITCH else None
        return line_from(dots, self.font, overlay, row, column, edge)

    def right_column(self) -> list[Line]:
        """The lines of vanilla's right column, the upper ones first."""
        pitch = self.sight.overlay.pitch
        rows = range(self.sight.places[0][0] % pitch, self.sight.dots.codes.shape[0], pitch)
        return [line for row in rows if (line := self.line_ending(row, self._right_edge))]

    def line_ending(self, row: int, end: int) -> Line | None:
        """The line whose last ink is in column ``end``, or None."""
        return line_up_to(self.sight.dots, self.font, self.sight.overlay, row, end)

    @property
    def _right_edge(self) -> int:
        return int(-(-self.sight.dots.frame.shape[1] // self.sight.dots.scale) - 4)

    def is_left(self, line: Line) -> bool:
        """Whether a line stands in the left column: those of the right one begin farther right on any screen."""
        return bool(line.start < self.sight.dots.codes.shape[1] // 4)


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
