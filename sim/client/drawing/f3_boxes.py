"""26.4's debug screen, drawn: titled boxes with names and values in two aligned columns.

What is in them is in game/entry_boxes.py (FACTS: The F3 debug screen).
"""

from functools import lru_cache

from sim.client.drawing.layers import Blend, Group, Layer
from sim.client.drawing.letters import Letters
from sim.client.game.box_columns import PITCH, PlacedBox, box_columns
from sim.client.game.colours import TEXT, WHITE, Colour
from sim.client.game.f3_screen import F3Screen

_KEPT = 256
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
        self._letters = letters
        self._columns, self._rows = gui
        self._box = lru_cache(_KEPT)(self._drawn)

    def of(self, screen: F3Screen) -> list[Layer]:
        """The layers of one debug screen, from the back to the front."""
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

    def _fill(self, gui: tuple[int, int, int, int], colour: Colour, alpha: int = 255) -> Blend:
        scale = self._letters.scale
        return Blend((gui[0] * scale, gui[1] * scale, gui[2] * scale, gui[3] * scale), colour, alpha)
