"""The debug screen, drawn: positions and colours of every layout of the facts' table, and of the stand-in's.

The texts are in game/f3_text.py (FACTS: The F3 debug screen).
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from sim.client.drawing.f3_groups import group_layers
from sim.client.drawing.layers import Blend, Layer, draw_all
from sim.client.drawing.letters import Letters
from sim.client.game.colours import Colour
from sim.client.game.f3_text import F3Screen, TextLine, left_lines, right_lines


@dataclass(frozen=True)
class _Style:
    """How a client draws the screen, in GUI pixels; the alpha is out of 255, the colours are red, green, blue."""

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


_VANILLA = _Style(pitch=9, empty=9, edge=2, box=(80, 80, 80), alpha=144, margin=1, text=(224, 224, 224))
_STANDIN = _Style(pitch=10, empty=9, edge=1, box=(110, 110, 110), alpha=128, margin=0, text=(255, 255, 255))

_VALUES: dict[str, Colour] = {"true": (85, 255, 85), "false": (255, 85, 85)}

_KEPT = 512
"""Lines whose layers are cached: a screen has about forty, and the next one shares most of them."""


def paint(world: Frame, screen: F3Screen, font: Font) -> Frame:
    """The world (height, width, 3), blue green red, with the debug screen over it. The world itself is not changed.

    Text that doesn't fit is cut at the window's edge, and the right column is drawn over the left one, as in the game.
    """
    frame: Frame = world.copy()
    height, width = world.shape[:2]
    layers = F3Layers(Letters(font, screen.gui_scale), width).of(screen)
    draw_all(frame, layers, (0, 0, width, height))
    return frame


class F3Layers:
    """Debug screens as layers in a window ``width`` pixels wide; a line that didn't change is the same layer again."""

    def __init__(self, letters: Letters, width: int) -> None:
        self._letters = letters
        # The last GUI pixel may be cut (FACTS: The F3 debug screen).
        self._columns = -(-width // letters.scale)
        self._line = lru_cache(_KEPT)(self._drawn)

    def of(self, screen: F3Screen) -> list[Layer]:
        """The layers of one debug screen, from the back to the front."""
        if screen.layout == "26.4":
            return group_layers(screen, self._letters)
        style = _STANDIN if screen.layout == "standin" else _VANILLA
        layers: list[Layer] = []
        for lines, is_right in ((left_lines(screen), False), (right_lines(screen), True)):
            drawn = [
                self._line(line.text, line.value, line.underlined, top, is_right, style)
                for line, top in _with_tops(lines, style)
            ]
            layers += [box for box, _ in drawn]
            layers += [layer for _, texts in drawn for layer in texts]
        return layers

    def _drawn(
        self, text: str, value: str, underlined: bool, top: int, is_right: bool, style: _Style
    ) -> tuple[Layer, list[Layer]]:
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
            texts.append(self._blend((left - 1, top + 8, left + width, top + 9), style.text, 255))
        return self._blend(box, style.box, style.alpha), texts

    def _blend(self, gui: tuple[int, int, int, int], colour: Colour, alpha: int) -> Blend:
        scale = self._letters.scale
        return Blend((gui[0] * scale, gui[1] * scale, gui[2] * scale, gui[3] * scale), colour, alpha)


def _with_tops(lines: list[TextLine], style: _Style) -> Iterator[tuple[TextLine, int]]:
    """Each line that isn't empty, and its top in GUI pixels."""
    top = style.edge
    for line in lines:
        if line.text:
            yield line, top
        top += style.pitch if line.text else style.empty
