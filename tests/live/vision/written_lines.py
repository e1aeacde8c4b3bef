"""Lines of a screen written down as texts, to try what is read of them without a picture."""

import dataclasses
from collections.abc import Sequence

from mc_nested.live.vision.layout import VANILLA, ScreenLayout
from mc_nested.live.vision.text_lines import UNKNOWN, Line

LEFT, RIGHT = 2, 400
"""The first column of the left column's lines, and the last one of the right column's."""

_WIDE = 6
"""Columns of any letter here."""


def written(text: str, number: int, *, right: bool = False, whole: bool = True, pitch: int = 9) -> Line:
    """Return the line of that number, from 0 on, in the left column or the right one."""
    wide = _WIDE * len(text) - 1
    start, end = (RIGHT - wide + 1, RIGHT) if right else (LEFT, LEFT + wide - 1)
    return Line(text, 2 + number * pitch, start, end, whole, is_left=not right)


class WrittenLines:
    """A screen that shows these lines and nothing else."""

    def __init__(self, *lines: Line, layout: ScreenLayout = VANILLA, is_covered: bool = False) -> None:
        self.is_covered = is_covered
        self.layout = layout
        self._lines = lines

    def holds(self, text: str) -> bool:
        return any(text in line.text for line in self._lines)

    def starting(self, label: str) -> Sequence[Line]:
        return [_from(line, line.text.index(label)) for line in self._lines if label in line.text]

    def at(self, row: int, start: int) -> Line:
        found = [line for line in self._lines if (line.row, line.start) == (row, start)]
        return found[0] if found else Line("", row, start, start - 1, whole=False, is_left=start < RIGHT // 4)

    def ending(self, row: int, end: int) -> Line | None:
        return next((line for line in self._lines if (line.row, line.end) == (row, end)), None)

    def begins(self, row: int, start: int) -> bool:
        return any((line.row, line.start) == (row, start) for line in self._lines)

    def right_column(self) -> Sequence[Line]:
        return [line for line in self._lines if line.end == RIGHT]

    def may_be_covered(self) -> bool:
        return self.is_covered

    def cut(self, line: Line, text: str) -> Line | None:
        if text == line.text:
            return line
        is_cut = line.is_left and UNKNOWN not in text and line.text.startswith(text)
        return dataclasses.replace(line, text=text) if is_cut else None


def _from(line: Line, first: int) -> Line:
    start = line.start + _WIDE * first
    return dataclasses.replace(line, text=line.text[first:], start=start, is_left=start < RIGHT // 4)
