"""A view of the game as a picture: a random world, and the view's layers over it."""

from collections.abc import Mapping
from functools import lru_cache

import numpy as np

from mc_nested.live.devices import Frame, Region
from mc_nested.live.model.reading import Block
from mc_nested.live.model.scales import Scales
from mc_nested.live.vision.font import Font
from sim.client.drawing.picture import LayeredPicture
from sim.client.drawing.scenery import SEEN, random_world
from sim.client.drawing.view_layers import ViewLayers
from sim.client.drawing.world_layer import WorldLayers
from sim.client.game.edition import Edition
from sim.client.game.screens import IN_WORLD
from sim.client.game.view import View

_SHIFTS = 16
"""Pixels, in each direction, by which the world behind the text shifts as the player moves from block to block."""

_DIRT, _TILE = 40, 32
"""The greatest brightness of the background of the title and the list of worlds, and its period in pixels."""


class Painter:
    """Draws a game in a window of one size, at one pair of scales.

    Args:
        size: the window's width and height in framebuffer pixels.
        scales: framebuffer pixels a GUI pixel, of the GUI and of the debug screen.
        font: the font of all texts.
        edition: the game's version.
        kind: the kind of world behind the text, of ``scenery.WORLDS``, bright, dark or ``scenery.SEEN``.
        seed: of the random world.
        words: the menus' texts in another language, by their English.
    """

    def __init__(
        self,
        size: tuple[int, int],
        scales: Scales,
        font: Font,
        edition: Edition,
        kind: str,
        seed: int,
        words: Mapping[str, str] | None = None,
    ) -> None:
        width, height = size
        rng = np.random.default_rng(seed)
        self._size = size
        # Of the world that is seen every part is drawn over this.
        self._world = random_world(rng, "flat" if kind == SEEN else kind, width + _SHIFTS, height + _SHIFTS)
        tile = rng.integers(0, _DIRT, (_TILE, _TILE, 3), np.uint8)
        self._dirt: Frame = np.tile(tile, (-(-height // _TILE), -(-width // _TILE), 1))[:height, :width]
        self._worlds = WorldLayers(size)
        self._layers = ViewLayers(size, scales, font, edition, words or {})
        self._scene = lru_cache(2 * _SHIFTS)(self._moved)
        self._shown: View | None = None
        self._picture = LayeredPicture(self._dirt)

    def grab(self, view: View, region: Region | None = None) -> Frame:
        """The picture of a view, or a region of it."""
        if view is not self._shown:
            self._shown = view
            world = [self._worlds.of(view.sight)] if view.sight else []
            self._picture.show(self._background(view), [*world, *self._layers.of(view)])
        return self._picture.grab(region)

    def _background(self, view: View) -> Frame:
        if view.menu.name not in IN_WORLD:
            return self._dirt
        return self._scene(*_shift(view.scene))

    def _moved(self, right: int, down: int) -> Frame:
        width, height = self._size
        return self._world[down : down + height, right : right + width]


def _shift(block: Block) -> tuple[int, int]:
    x, y, z = block
    return (7 * x + 3 * y) % _SHIFTS, (5 * z + y) % _SHIFTS
