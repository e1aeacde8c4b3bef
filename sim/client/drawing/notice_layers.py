"""Notices (toasts), drawn over everything else: boxes at the upper right (FACTS: The F3 debug screen)."""

from sim.client.drawing.layers import Blend, Layer, Rect
from sim.client.drawing.letters import Letters
from sim.client.game.colours import WHITE, Colour

WIDTH, HEIGHT, MOST = 160, 32, 5
"""GUI pixels of a notice, and how many there are at most."""

_EDGE: Colour = (85, 85, 85)
_FACE: Colour = (33, 33, 33)
_TITLE: Colour = (255, 255, 0)


class NoticeLayers:
    """The layers of notices in a window so many GUI pixels wide."""

    def __init__(self, letters: Letters, width: int) -> None:
        self._letters, self._left = letters, width - WIDTH

    def of(self, notices: tuple[str, ...]) -> list[Layer]:
        """The layers of these texts from the top down; an empty one leaves its place free."""
        layers: list[Layer] = []
        for place, text in enumerate(notices[:MOST]):
            if text:
                top, left = place * HEIGHT, self._left
                layers += [
                    self._fill((left, top, left + WIDTH, top + HEIGHT), _EDGE),
                    self._fill((left + 2, top + 2, left + WIDTH - 2, top + HEIGHT - 2), _FACE),
                    self._fill((left + 8, top + 8, left + 24, top + 24), _EDGE),
                    self._letters.text(text, left + 30, top + 7, _TITLE),
                    self._letters.text("Press E", left + 30, top + 18, WHITE),
                ]
        return layers

    def _fill(self, gui: Rect, colour: Colour) -> Blend:
        scale = self._letters.scale
        return Blend((gui[0] * scale, gui[1] * scale, gui[2] * scale, gui[3] * scale), colour, 255)
