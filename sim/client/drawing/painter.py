"""A view of the game as layers, from the world at the back to the menu in front."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.reading import Block
from mc_nested.live.vision.font import Font
from sim.client.drawing.f3_layers import F3Layers
from sim.client.drawing.hud_layers import HudLayers
from sim.client.drawing.layers import Layer
from sim.client.drawing.letters import Letters
from sim.client.drawing.menu_layers import MenuLayers
from sim.client.drawing.notice_layers import NoticeLayers
from sim.client.drawing.picture import LayeredPicture
from sim.client.drawing.scenery import random_world
from sim.client.game.edition import Edition
from sim.client.game.screens import IN_WORLD
from sim.client.game.view import View

_SHIFTS = 16
"""Pixels, in each direction, by which the world behind the text shifts as the player moves from block to block."""

_DIRT, _TILE = 40, 32
"""The greatest brightness of the background of the title and the list of worlds, and its period in pixels."""


class Painter:
    """Draws a game in a window of one size, at one GUI scale.

    Args:
        size: the window's width and height in framebuffer pixels.
        scale: framebuffer pixels a GUI pixel.
        font: the font of all texts.
        edition: the game's version.
        kind: the kind of world behind the text, of ``scenery.WORLDS``, bright or dark.
        seed: of the random world.
        words: the menus' texts in another language, by their English.
    """

    def __init__(
        self,
        size: tuple[int, int],
        scale: int,
        font: Font,
        edition: Edition,
        kind: str,
        seed: int,
        words: Mapping[str, str] | None = None,
    ) -> None:
        width, height = size
        rng = np.random.default_rng(seed)
        self._size = size
        self._world = random_world(rng, kind, width + _SHIFTS, height + _SHIFTS)
        tile = rng.integers(0, _DIRT, (_TILE, _TILE, 3), np.uint8)
        self._dirt: Frame = np.tile(tile, (-(-height // _TILE), -(-width // _TILE), 1))[:height, :width]
        letters = Letters(font, scale)
        gui = (-(-width // scale), -(-height // scale))
        self._f3 = F3Layers(letters, width)
        self._hud = HudLayers(letters, gui, edition)
        self._menu = MenuLayers(letters, gui, edition, words or {})
        # The same layers again, so that what doesn't change isn't drawn again.
        self._notices = lru_cache(8)(NoticeLayers(letters, gui[0]).of)
        self._scene = lru_cache(2 * _SHIFTS)(self._moved)
        self._shown: View | None = None
        self._picture = LayeredPicture(self._dirt)

    def grab(self, view: View, region: Region | None = None) -> Frame:
        """The picture of a view, or a region of it."""
        if view is not self._shown:
            self._shown = view
            self._picture.show(self._background(view), self._layers(view))
        return self._picture.grab(region)

    def _background(self, view: View) -> Frame:
        if view.menu.name not in IN_WORLD:
            return self._dirt
        return self._scene(*_shift(view.scene))

    def _moved(self, right: int, down: int) -> Frame:
        width, height = self._size
        return self._world[down : down + height, right : right + width]

    def _layers(self, view: View) -> list[Layer]:
        layers: list[Layer] = []
        if view.menu.name in IN_WORLD:
            layers += self._hud.of(view)
            layers += self._f3.of(view.f3) if view.f3 else []
            layers += self._hud.chat(view.chat, view.typed) if view.chat or view.typed is not None else []
        return layers + self._menu.of(view) + self._notices(view.notices)


def _shift(block: Block) -> tuple[int, int]:
    x, y, z = block
    return (7 * x + 3 * y) % _SHIFTS, (5 * z + y) % _SHIFTS
