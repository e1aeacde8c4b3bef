"""The virtual client's debug screen: every layout of the facts' table but 26.4, and the stand-in's, over a world.

What a version writes is in ``f3_text.py``; here is where it is put and in which colours (FACTS: The F3 debug screen).
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.font import Font
from sim.client.f3_text import F3Screen, TextLine, left_lines, right_lines

Colour = tuple[int, int, int]


@dataclass(frozen=True)
class _Style:
    """A client's way of drawing, in GUI pixels; the alpha is of 255, and the colours are red, green, blue."""

    pitch: int
    empty: int
    """The height of an empty line."""
    edge: int
    """From the window's side to the text."""
    box: Colour
    alpha: int
    margin: int
    """How far the box reaches beyond the text on each side but the lower one."""
    text: Colour


_VANILLA = _Style(pitch=9, empty=9, edge=2, box=(80, 80, 80), alpha=144, margin=1, text=(224, 224, 224))
_STANDIN = _Style(pitch=10, empty=9, edge=1, box=(110, 110, 110), alpha=128, margin=0, text=(255, 255, 255))

_VALUES: dict[str, Colour] = {"true": (85, 255, 85), "false": (255, 85, 85)}


def paint(world: Frame, screen: F3Screen, font: Font) -> Frame:
    """The world (height, width, 3), blue green red, with the debug screen over it. The world itself is left as it is.

    Text that doesn't fit is cut at the window's side, and the right column is drawn over the left one, as in the game.
    """
    style = _STANDIN if screen.layout == "standin" else _VANILLA
    canvas = _Canvas(world.copy(), screen.gui_scale)
    for lines, is_right in ((left_lines(screen), False), (right_lines(screen), True)):
        placed = list(_placed(lines, style, font, canvas.columns if is_right else None))
        for _, left, top, width in placed:
            margin = style.margin
            canvas.blend((left - margin, top - margin), (left + width + margin, top + style.pitch - margin), style)
        for line, left, top, width in placed:
            _write(canvas, style, font, line, (left, top), width)
    return canvas.frame


def _placed(
    lines: Iterable[TextLine], style: _Style, font: Font, columns: int | None
) -> Iterator[tuple[TextLine, int, int, int]]:
    """Each line that isn't empty, its left, top and width in GUI pixels; right-aligned in ``columns`` if given."""
    top = style.edge
    for line in lines:
        width = len(font.columns(line.text))
        if width:
            yield line, style.edge if columns is None else columns - style.edge - width, top, width
        top += style.pitch if width else style.empty


def _write(canvas: "_Canvas", style: _Style, font: Font, line: TextLine, at: tuple[int, int], width: int) -> None:
    left, top = at
    value = font.columns(line.value)
    canvas.draw(font.columns(line.text.removesuffix(line.value)), at, style.text)
    canvas.draw(value, (left + width - len(value), top), _VALUES.get(line.value, style.text))
    if line.underlined:
        canvas.part((left - 1, top + 8), (left + width, top + 9))[:] = style.text[::-1]


@dataclass(frozen=True)
class _Canvas:
    """A frame that is drawn on in GUI pixels; what lies beside it is cut off."""

    frame: Frame
    scale: int

    @property
    def columns(self) -> int:
        """The window's width in GUI pixels, the last of which may be cut (FACTS: The F3 debug screen)."""
        return -(-int(self.frame.shape[1]) // self.scale)

    def part(self, upper_left: tuple[int, int], lower_right: tuple[int, int]) -> Frame:
        """The pixels of a rectangle, to be drawn on."""
        left, top, right, bottom = (max(0, side) * self.scale for side in (*upper_left, *lower_right))
        return self.frame[top:bottom, left:right]

    def blend(self, upper_left: tuple[int, int], lower_right: tuple[int, int], style: _Style) -> None:
        part = self.part(upper_left, lower_right)
        box = np.array(style.box[::-1], np.uint16) * style.alpha
        part[:] = (part.astype(np.uint16) * (255 - style.alpha) + box + 127) // 255

    def draw(self, columns: bytes, at: tuple[int, int], colour: Colour) -> None:
        if not columns:
            return
        left, top = at
        bits = np.unpackbits(np.frombuffer(columns, np.uint8)[np.newaxis], axis=0, bitorder="little").astype(bool)
        ink = bits[:, max(0, -left) :].repeat(self.scale, 0).repeat(self.scale, 1)
        part = self.part(at, (left + len(columns), top + 8))
        part[ink[: part.shape[0], : part.shape[1]]] = colour[::-1]
