"""Which column each box of 26.4's debug screen stands in, and how far down (FACTS: The F3 debug screen).

A box stays in the column of the frame before. One that comes goes into the column that it prefers, or into the
shorter one, below those that are there. A column as high as the window takes no more.
"""

from collections.abc import Iterable
from typing import NamedTuple

from sim.client.game.entry_boxes import FIRST, Box, boxes, first_lines
from sim.client.game.f3_screen import F3Screen, Stood

TOP, PITCH = 2, 9
"""Where a column begins, and from one line to the next; as much again is below each box."""


class PlacedBox(NamedTuple):
    """A box, and the row of GUI pixels of its first line."""

    box: Box
    top: int


class _Column:
    """The boxes that a column holds so far."""

    def __init__(self, rows: int) -> None:
        self.placed: list[PlacedBox] = []
        self.height = TOP
        self._rows = rows

    @property
    def is_full(self) -> bool:
        return self.height >= self._rows

    def add(self, box: Box) -> None:
        self.placed.append(PlacedBox(box, self.height))
        self.height += (box.rows + 1) * PITCH


def box_columns(screen: F3Screen, rows: int) -> tuple[list[PlacedBox], list[PlacedBox]]:
    """The boxes of the left and of the right column, from the top, in a window ``rows`` GUI pixels high."""
    left, right = columns = _Column(rows), _Column(rows)
    first = first_lines(screen)
    for column, lines in zip(columns, (first[::2], first[1::2]), strict=True):
        if lines:
            column.add(Box(FIRST, lines=lines))
    waiting = {box.kind.title: box for box in boxes(screen)}
    for column, titles in zip(columns, screen.stood, strict=True):
        _fill(column, waiting, titles)
    for title, box in list(waiting.items()):
        if box.kind.side:
            _fill(left if box.kind.side == "left" else right, waiting, (title,))
    for title in list(waiting):
        _fill(left if left.height < right.height and not left.is_full else right, waiting, (title,))
    return left.placed, right.placed


def _fill(column: _Column, waiting: dict[str, Box], titles: Iterable[str]) -> None:
    """Put the boxes of these titles that are waiting into a column, as long as it isn't full."""
    for title in titles:
        if title in waiting and not column.is_full:
            column.add(waiting.pop(title))


def stood_after(screen: F3Screen, rows: int) -> Stood:
    """Where the boxes of a screen stood, for the next frame."""
    left, right = (
        [one.box.kind.title for one in column if one.box.kind is not FIRST] for column in box_columns(screen, rows)
    )
    return tuple(left), tuple(right)
