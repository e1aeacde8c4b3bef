"""The lines of one frame's debug screen, each found and read once, when it is first asked for."""

import re
from collections.abc import Mapping, Sequence
from typing import Protocol

from mc_nested.live.vision.fact_lines import fact_from
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import GlyphGrid, GridPosition
from mc_nested.live.vision.hidden_lines import columns_are_full, may_hide_lines
from mc_nested.live.vision.layout import Overlay, ScreenLayout
from mc_nested.live.vision.text_lines import UNKNOWN, Line, is_text, line_from, line_up_to, positions_of

WHOLE = r"(-?(?:0|[1-9]\d{0,7}))"
"""A whole number as the game prints it: no zeros before it, and no coordinate has more than eight digits."""

CLEAR = "clear the chat (F3+D), close what lies over it, or widen the window"


class Unreadable(Exception):  # noqa: N818 - no error: it carries the reason why a frame gives no reading up to the Reading
    """The reason why a frame gives no reading."""


class DebugLines(Protocol):
    """The lines of one debug screen: a reading depends on them alone."""

    @property
    def layout(self) -> ScreenLayout:
        """The layout of the lines."""

    def holds(self, text: str) -> bool:
        """Return whether a text stands anywhere."""

    def starting(self, label: str) -> Sequence[Line]:
        """Return each line from where ``label`` stands on, read to the right."""

    def at(self, row: int, start: int) -> Line:
        """Return the line that begins there, read to the right."""

    def ending(self, row: int, end: int) -> Line | None:
        """Return the line whose last ink is in column ``end``, read to the left; None where no ink is there."""

    def begins(self, row: int, start: int) -> bool:
        """Return whether a line begins there, as far as its first letters say."""

    def right_column(self) -> Sequence[Line]:
        """Return the lines of the right column, the upper ones first.

        Return none where the layout doesn't say where it ends.
        """

    def may_be_covered(self) -> bool:
        """Return whether lines of the block looked at may not be seen: under a notice, or for want of room."""

    def cut(self, line: Line, text: str) -> Line | None:
        """Return a line up to the end of ``text``, with which it begins; None where it can't be read so."""


class ScreenLines:
    """The lines of a frame, by its pixels. It keeps where they stood, so that they can be read again there.

    Args:
        dots: the frame, as dots.
        font: the font that reads it.
        overlay: how the screen is drawn.
        remembered: where the labels that are asked for should stand; without it they are looked for.
    """

    def __init__(
        self,
        dots: GlyphGrid,
        font: Font,
        overlay: Overlay,
        remembered: Mapping[str, list[GridPosition]] | None = None,
    ) -> None:
        self.dots = dots
        self.overlay = overlay
        self.layout = overlay.layout
        self.positions_seen: dict[str, list[GridPosition]] = {}
        self.rows_read: set[int] = set()
        self._font = font
        self._remembered = remembered
        self._lines: dict[GridPosition, Line] = {}
        self._ended: list[Line] = []
        self._right_end = _right_end(dots, self.layout)

    @property
    def lines_read(self) -> list[Line]:
        """Every line that was read so far."""
        return [*self._lines.values(), *self._ended]

    def holds(self, text: str) -> bool:
        return bool(self._positions(text))

    def starting(self, label: str) -> Sequence[Line]:
        return [self.at(*position) for position in self._positions(label)]

    def at(self, row: int, start: int) -> Line:
        if (row, start) not in self._lines:
            self._lines[row, start] = self._read(row, start, self._right_end)
            self.rows_read.add(row)
        return self._lines[row, start]

    def ending(self, row: int, end: int) -> Line | None:
        self.rows_read.add(row)
        line = line_up_to(self.dots, self._font, self.overlay, (row, end))
        if line is not None:
            self._ended.append(line)
        return line

    def begins(self, row: int, start: int) -> bool:
        return is_text(self.dots, self._font, self.overlay, (row, start))

    def right_column(self) -> Sequence[Line]:
        if self._right_end is None:
            return []
        rows = range(self.dots.first, self.dots.rows, self.dots.pitch)
        return [line for row in rows if (line := self.ending(row, self._right_end))]

    def may_be_covered(self) -> bool:
        if self.layout.has_facts:
            return columns_are_full(self.dots, self._font, self.overlay)
        return may_hide_lines(self.dots)

    def cut(self, line: Line, text: str) -> Line | None:
        if text == line.text:
            return line
        # What follows is the world beside the line's box. In the right column a line ends where the column does.
        if UNKNOWN in text or not (line.is_left or self.layout.has_facts):
            return None
        end = line.start + len(self._font.columns(text)) - 2
        shorter = self._read(line.row, line.start, end)
        return shorter if shorter.text == text else None

    def _read(self, row: int, start: int, end: int | None) -> Line:
        read = fact_from if self.layout.has_facts else line_from
        return read(self.dots, self._font, self.overlay, (row, start), end)

    def _positions(self, label: str) -> list[GridPosition]:
        if label not in self.positions_seen:
            if self._remembered is None:
                self.positions_seen[label] = positions_of(self.dots, self._font, label)
            else:
                self.positions_seen[label] = self._seen_again(label, self._remembered.get(label, []))
        return self.positions_seen[label]

    def _seen_again(self, label: str, positions: list[GridPosition]) -> list[GridPosition]:
        if not all(self.at(*position).text.startswith(label) for position in positions):
            raise Unreadable(f"the line that began with {label.strip()!r} is not where it was: {CLEAR}")
        return positions


def _right_end(dots: GlyphGrid, layout: ScreenLayout) -> int | None:
    """Return the column of the right column's last ink, as far as the layout says."""
    columns = -(-int(dots.frame.shape[1]) // dots.scale)
    return None if layout.right_edge is None else columns - layout.right_edge


def only_line(lines: DebugLines, label: str) -> Line | None:
    """Return the one line that begins with ``label``, or None.

    Raise Unreadable for two of them: one may be somebody's chat.
    """
    found = lines.starting(label)
    if len(found) > 1:
        raise Unreadable(f"{len(found)} lines begin with {label.strip()!r}: {CLEAR}")
    return found[0] if found else None


def matched(form: re.Pattern[str], line: Line | None) -> tuple[str, ...]:
    """Return the groups of a line that has this form as a whole; raise Unreadable if it hasn't."""
    match = form.fullmatch(line.text) if line else None
    if match is None:
        raise not_a_form(line)
    return match.groups()


def cut_to(lines: DebugLines, line: Line, text: str) -> Line:
    """Return a line up to the end of ``text``, with which it begins; raise Unreadable if it can't be read so."""
    shorter = lines.cut(line, text)
    if shorter is None:
        raise not_a_form(line)
    return shorter


def not_a_form(line: Line | None) -> Unreadable:
    """Return the error to raise where a line has another form than it should."""
    return Unreadable(f"a line reads {shown(line.text if line else '')}: {CLEAR}")


def check_nothing_over(lines: DebugLines, line: Line) -> None:
    """Raise Unreadable if a line of the right column may lie over this one: those lines are drawn later.

    Where its box covers the next letter, its own first letter stands just behind the end of this line's box.
    """
    if line.is_left and lines.begins(line.row, line.end + lines.layout.box.behind + 1):
        raise Unreadable(f"a line of the right column lies over {shown(line.text)}: {CLEAR}")


def check_whole(line: Line) -> None:
    """Raise Unreadable if the end of the line may be covered."""
    if not line.whole:
        raise Unreadable(f"the end of {shown(line.text)} may be covered: {CLEAR}")


def shown(text: str) -> str:
    """Return a line's text for a message, with ``?`` for what matched no glyph."""
    return repr(text.replace(UNKNOWN, "?"))
