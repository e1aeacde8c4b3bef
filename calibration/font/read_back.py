"""The debug screen read line by line, each line's picture drawn beside its text for a person to compare.

| picture of the line | what is read of it |      what matches no glyph is a red ?
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.glyph_grid import dots_of
from mc_nested.live.vision.layout import INK_SPREAD
from mc_nested.live.vision.overlay import POSITION, FoundScreen, find_debug_screen
from mc_nested.live.vision.screen_lines import ScreenLines
from mc_nested.live.vision.text_lines import UNKNOWN, Line, is_text, line_from, positions_of

_INK_HEIGHT = 27
"""Pixels that a line's nine dots take on the drawing at least."""

_GAP, _MARGIN = 6, 16
_GROUND, _TEXT, _BAD, _RULE = (32, 32, 32), (235, 235, 235), (80, 80, 255), (70, 70, 70)
"""Blue, green, red."""

_FACE, _SIZE = cv2.FONT_HERSHEY_SIMPLEX, 0.7


@dataclass(frozen=True)
class ReadLine:
    """A line of the debug screen: its text, ``UNKNOWN`` where no glyph fits, and its picture (height, width, 3)."""

    text: str
    picture: Frame

    @property
    def is_known(self) -> bool:
        """Whether every glyph of it was known."""
        return UNKNOWN not in self.text


def read_back(frame: Frame, font: Font) -> list[ReadLine]:
    """Return the lines of a frame's debug screen, the left column's first; none where there is no debug screen."""
    found = find_debug_screen(frame, font)
    if found is None or found.label != POSITION:
        return []
    read = [ReadLine(line.text, _picture_of(found, line)) for line in _left_column(found, font)]
    right = [line for line in ScreenLines(found.dots, font, found.overlay).right_column() if _is_mostly_known(line)]
    # Before a line of the right column lies the world, whose bright dots are no part of it.
    return read + [ReadLine(line.text.lstrip(f"{UNKNOWN} "), _picture_of(found, line)) for line in right]


def phase_of(frame: Frame, font: Font) -> tuple[int, int] | None:
    """Return how many pixels, right and down, the text's dots lie off the window's own; None without a text.

    The game draws its dots from the window's corner on: anything but (0, 0) is a picture that is shifted.
    """
    found = find_debug_screen(frame, font)
    if found is None:
        return None
    scale, (row, column) = found.overlay.scale, positions_of(found.dots, font, found.label)[0]
    wanted = dots_of(font.columns(found.label)).repeat(scale, 0).repeat(scale, 1)
    ink = frame[..., 1] >= min(found.overlay.colour) - INK_SPREAD
    steps = sorted(range(1 - scale, scale), key=abs)

    def fit(step: tuple[int, int]) -> int:
        top, left = row * scale + step[1], column * scale + step[0]
        seen = ink[max(0, top) : top + wanted.shape[0], max(0, left) : left + wanted.shape[1]]
        return int((seen == wanted).sum()) if seen.shape == wanted.shape else -1

    return max(((right, down) for down in steps for right in steps), key=fit)


def side_by_side(lines: Sequence[ReadLine]) -> Frame:
    """Return the lines below each other, each picture on the left and its text on the right: (height, width, 3)."""
    pictures = [_enlarged(line.picture) for line in lines]
    widest = max((picture.shape[1] for picture in pictures), default=0)
    longest = max((_width_of(line.text.replace(UNKNOWN, "?")) for line in lines), default=0)
    middle = widest + 2 * _MARGIN
    height = sum(picture.shape[0] + _GAP for picture in pictures) + _GAP
    drawn: Frame = np.full((height, middle + longest + 2 * _MARGIN, 3), _GROUND, np.uint8)
    top = _GAP
    for line, picture in zip(lines, pictures, strict=True):
        drawn[top : top + picture.shape[0], _MARGIN : _MARGIN + picture.shape[1]] = picture
        _write(drawn, line.text, middle + _MARGIN, top + picture.shape[0] * 3 // 4)
        top += picture.shape[0] + _GAP
        cv2.line(drawn, (0, top - _GAP // 2), (drawn.shape[1], top - _GAP // 2), _RULE, 1)
    cv2.line(drawn, (middle, 0), (middle, height), _RULE, 1)
    return drawn


def _left_column(found: FoundScreen, font: Font) -> list[Line]:
    dots, overlay = found.dots, found.overlay
    _, column = positions_of(dots, font, POSITION)[0]
    lines: list[Line] = []
    for row in range(dots.first, dots.rows, dots.pitch):
        if (not lines or row >= lines[-1].row + overlay.pitch - 1) and is_text(dots, font, overlay, (row, column)):
            lines.append(line_from(dots, font, overlay, (row, column)))
    return lines


def _is_mostly_known(line: Line) -> bool:
    """Return whether a right-column line is text: the world beside an empty line may look like a glyph or two."""
    known = line.text.replace(UNKNOWN, "").strip()
    return len(known) > 2 and 2 * len(known) > len(line.text)


def _picture_of(found: FoundScreen, line: Line) -> Frame:
    scale = found.overlay.scale
    top, left = max(0, line.row - 1) * scale, max(0, line.start - 1) * scale
    return found.dots.frame[top : (line.row + 9) * scale, left : (line.end + 3) * scale]


def _enlarged(picture: Frame) -> Frame:
    times = max(1, -(-_INK_HEIGHT // max(1, picture.shape[0])))
    return picture.repeat(times, 0).repeat(times, 1)


def _write(drawn: Frame, text: str, left: int, baseline: int) -> None:
    for part in re.split(f"({UNKNOWN})", text):
        shown, colour = ("?", _BAD) if part == UNKNOWN else (part, _TEXT)
        cv2.putText(drawn, shown, (left, baseline), _FACE, _SIZE, colour, 1, cv2.LINE_AA)
        left += _width_of(shown)


def _width_of(text: str) -> int:
    return int(cv2.getTextSize(text, _FACE, _SIZE, 1)[0][0])
