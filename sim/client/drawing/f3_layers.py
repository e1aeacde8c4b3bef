"""The debug screen, drawn: positions and colours of every layout of the facts' table, and of the stand-in's.

The texts are in game/f3_text.py (FACTS: The F3 debug screen).
"""

from functools import lru_cache
from typing import NamedTuple

from mc_nested.live.devices import Frame
from mc_nested.live.vision.font import Font
from sim.client.drawing.f3_boxes import F3Boxes
from sim.client.drawing.layers import Blend, Group, Layer, draw_all
from sim.client.drawing.letters import Letters
from sim.client.game.colours import TEXT, WHITE, Colour
from sim.client.game.f3_screen import F3Screen, Part, TextLine
from sim.client.game.f3_text import both_columns


class _Style(NamedTuple):
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


_VANILLA = _Style(pitch=9, empty=9, edge=2, box=(80, 80, 80), alpha=144, margin=1, text=TEXT)
_STANDIN = _Style(pitch=10, empty=9, edge=1, box=(110, 110, 110), alpha=128, margin=0, text=WHITE)

_VALUES: dict[str, Colour] = {"true": (85, 255, 85), "false": (255, 85, 85)}

_KEPT = 512
"""Parts whose layers are cached: a screen has about ten, and the next one shares most of them."""


def paint(world: Frame, screen: F3Screen, font: Font) -> Frame:
    """The world (height, width, 3), blue green red, with the debug screen over it. The world itself is not changed.

    Text that doesn't fit is cut at the window's edge, and the right column is drawn over the left one, as in the game.
    """
    frame: Frame = world.copy()
    height, width = world.shape[:2]
    gui = (-(-width // screen.gui_scale), -(-height // screen.gui_scale))
    layers = F3Layers(Letters(font, screen.gui_scale), gui).of(screen)
    draw_all(frame, layers, (0, 0, width, height))
    return frame


class F3Layers:
    """Debug screens as layers in a window of a size in GUI pixels; a part that didn't change is the same layer again.

    The last GUI pixel may be cut (FACTS: The F3 debug screen).
    """

    def __init__(self, letters: Letters, gui: tuple[int, int]) -> None:
        self._letters, self._columns = letters, gui[0]
        self._boxes = F3Boxes(letters, gui)
        self._part = lru_cache(_KEPT)(self._drawn_part)

    def of(self, screen: F3Screen) -> list[Layer]:
        """The layers of one debug screen, from the back to the front."""
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
        """One layer, or none if all lines are empty, and the top of what stands below, in GUI pixels."""
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
            texts.append(self._blend((left - 1, top + 8, left + width, top + 9), style.text, 255))
        return self._blend(box, style.box, style.alpha), texts

    def _blend(self, gui: tuple[int, int, int, int], colour: Colour, alpha: int) -> Blend:
        scale = self._letters.scale
        return Blend((gui[0] * scale, gui[1] * scale, gui[2] * scale, gui[3] * scale), colour, alpha)
