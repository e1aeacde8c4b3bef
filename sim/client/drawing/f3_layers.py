"""The debug screen, drawn: positions and colours of every layout of the facts' table, and of the stand-in's.

From 26.4 on it is titled boxes with names and values in two aligned columns. The texts are in game/f3_text.py, those of
the boxes in game/entry_boxes.py (FACTS: The F3 debug screen).
"""

from functools import lru_cache
from typing import NamedTuple

from sim.client.drawing.layers import Group, Layer
from sim.client.drawing.letters import Letters
from sim.client.game.entry_boxes import PITCH, PlacedBox, box_columns
from sim.client.game.f3_screen import F3Screen, Part, TextLine
from sim.client.game.f3_text import both_columns
from sim.client.game.widgets import TEXT, WHITE, Colour

_KEPT_BOXES = 256
_MARGIN, _TITLE, _GAP = 3, 3, 5
"""From the window's side to a box's text; from there to its title; between its names and its values."""

_APART = 2
"""Between facts and lines, which stand lower by as much."""

_ALPHA = 144
_TITLE_GROUND: Colour = (48, 48, 48)
_GROUND: Colour = (80, 80, 80)


class F3Boxes:
    """The boxes as layers in a window of a size in GUI pixels; one that didn't change is the same layer again."""

    def __init__(self, letters: Letters, gui: tuple[int, int]) -> None:
        self._letters, self._fill = letters, letters.fill
        self._columns, self._rows = gui
        self._box = lru_cache(_KEPT_BOXES)(self._drawn)

    def of(self, screen: F3Screen) -> list[Layer]:
        """Return the layers of one debug screen, from the back to the front."""
        left, right = box_columns(screen, self._rows)
        return [*(self._box(placed, False) for placed in left), *(self._box(placed, True) for placed in right)]

    def _drawn(self, placed: PlacedBox, is_right: bool) -> Layer:
        letters, (kind, facts, lines), top = self._letters, placed.box, placed.top
        names = max((letters.width(fact.name) for fact in facts), default=0)
        values = [sum(letters.width(text) for text, _ in fact.value) for fact in facts]
        width = max(
            *(letters.width(line) for line in lines),
            letters.width(kind.title) + _TITLE,
            *(names + _GAP + value for value in values),
            0,
        )
        height = placed.box.rows * PITCH
        left = self._columns - _MARGIN - width if is_right else _MARGIN
        right, bottom = left + width + 1, top + height + 1
        texts: list[Layer] = []
        grounds = [self._fill((left - 1, top - 1, right, top + PITCH - 1), _TITLE_GROUND, _ALPHA)] if kind.title else []
        row = top
        if kind.title:
            texts.append(letters.text(kind.title, left + _TITLE, row, WHITE))
            row += PITCH
        grounds.append(self._fill((left - 1, row - 1, right, bottom), _GROUND, _ALPHA))
        for fact in facts:
            texts.append(letters.text(f"{fact.name}:", left + names - letters.width(fact.name), row, TEXT))
            at = left + names + _GAP
            for text, colour in fact.value:
                texts.append(letters.text(text, at, row, colour))
                at += letters.width(text)
            row += PITCH
        row += _APART if facts and lines else 0
        texts += [letters.text(line, left, row + PITCH * index, TEXT) for index, line in enumerate(lines)]
        bars: list[Layer] = []
        if kind.bar is not None:
            at = self._columns - 1 if is_right else 0
            bars.append(self._fill((at, top - 1, at + 1, bottom), kind.bar))
        return Group((*grounds, *texts, *bars))


class _Style(NamedTuple):
    """A client's style of the screen, in GUI pixels; the alpha is out of 255, the colours are red, green, blue."""

    pitch: int
    empty: int
    """The height of an empty line."""
    edge: int
    """From the window's edge to the text."""
    box: Colour
    alpha: int
    margin: int
    """How far the box reaches beyond the text on each side except the lower one."""
    text: Colour


_VANILLA = _Style(pitch=9, empty=9, edge=2, box=(80, 80, 80), alpha=144, margin=1, text=TEXT)
_STANDIN = _Style(pitch=10, empty=9, edge=1, box=(110, 110, 110), alpha=128, margin=0, text=WHITE)

_VALUES: dict[str, Colour] = {"true": (85, 255, 85), "false": (255, 85, 85)}

_KEPT = 512
"""Parts whose layers are cached: a screen has about ten, and the next one shares most of them."""


class F3Layers:
    """Debug screens as layers in a window of a size in GUI pixels; a part that didn't change is the same layer again.

    The last GUI pixel may be cut (FACTS: The F3 debug screen).
    """

    def __init__(self, letters: Letters, gui: tuple[int, int]) -> None:
        self._letters, self._columns = letters, gui[0]
        self._boxes = F3Boxes(letters, gui)
        self._part = lru_cache(_KEPT)(self._drawn_part)

    def of(self, screen: F3Screen) -> list[Layer]:
        """Return the layers of one debug screen, from the back to the front."""
        if screen.layout == "26.4":
            return self._boxes.of(screen)
        is_standin = screen.layout == "standin"
        layers: list[Layer] = []
        for parts, is_right in zip(both_columns(screen), (False, True), strict=True):
            top = (_STANDIN if is_standin else _VANILLA).edge
            for part in parts:
                drawn, top = self._part(part, top, is_right, is_standin)
                layers += drawn
        return layers

    def _drawn_part(self, part: Part, top: int, is_right: bool, is_standin: bool) -> tuple[list[Layer], int]:
        """Return one layer, or none if all lines are empty, and the top of what stands below, in GUI pixels."""
        style = _STANDIN if is_standin else _VANILLA
        boxes: list[Layer] = []
        texts: list[Layer] = []
        for line in part:
            if line.text:
                box, letters = self._drawn_line(line, top, is_right, style)
                boxes.append(box)
                texts += letters
            top += style.pitch if line.text else style.empty
        # An underline lies on the next line's box.
        return [Group((*boxes, *texts))] if boxes else [], top

    def _drawn_line(self, line: TextLine, top: int, is_right: bool, style: _Style) -> tuple[Layer, list[Layer]]:
        text, value, underlined = line
        width = self._letters.width(text)
        left = self._columns - style.edge - width if is_right else style.edge
        margin = style.margin
        box = (left - margin, top - margin, left + width + margin, top + style.pitch - margin)
        texts: list[Layer] = []
        if label := text.removesuffix(value):
            texts.append(self._letters.text(label, left, top, style.text))
        if value:
            value_left = left + width - self._letters.width(value)
            texts.append(self._letters.text(value, value_left, top, _VALUES.get(value, style.text)))
        if underlined:
            texts.append(self._letters.fill((left - 1, top + 8, left + width, top + 9), style.text))
        return self._letters.fill(box, style.box, style.alpha), texts
