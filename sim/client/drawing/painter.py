"""A view of the game as a picture: the world behind, and the view's layers over it, from the hotbar to the menu.

From 1.21.9 on the debug screen lies over all of them (FACTS: The F3 debug screen). The world may be a random picture,
of many kinds: bright, dark and noisy.
"""

from collections.abc import Mapping
from functools import lru_cache, partial

import numpy as np

from mc_nested.live.devices import Frame, Region
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.layout import Scales
from sim.client.drawing.f3_layers import F3Layers
from sim.client.drawing.gui_layers import HudLayers, MenuLayers, notice_layers
from sim.client.drawing.layers import Layer, LayeredPicture
from sim.client.drawing.letters import Letters
from sim.client.drawing.world_layer import WorldLayers
from sim.client.game.edition import Edition
from sim.client.game.screens import IN_WORLD
from sim.client.game.view import View


class ViewLayers:
    """All that is drawn over the world, in a window of one size at one pair of scales.

    Args:
        size: the window's width and height in framebuffer pixels.
        scales: framebuffer pixels a GUI pixel, of the GUI and of the debug screen.
        font: the font of all texts.
        edition: the game's version.
        words: the menus' texts in another language, by their English.
    """

    def __init__(
        self, size: tuple[int, int], scales: Scales, font: Font, edition: Edition, words: Mapping[str, str]
    ) -> None:
        letters = Letters(font, scales.gui)
        gui = (-(-size[0] // scales.gui), -(-size[1] // scales.gui))
        # With a scale of its own the debug screen takes whole GUI pixels alone (FACTS: The F3 debug screen).
        is_own = scales.debug != scales.gui
        own = (size[0] // scales.debug, size[1] // scales.debug)
        self._f3 = F3Layers(Letters(font, scales.debug) if is_own else letters, own if is_own else gui)
        self._hud = HudLayers(letters, gui, edition)
        self._menu = MenuLayers(letters, gui, edition, words)
        # The same layers again, so that what doesn't change isn't drawn again.
        self._notices = lru_cache(8)(partial(notice_layers, letters, gui[0]))
        self._is_f3_last = edition.since(1, 21, 9)

    def of(self, view: View) -> list[Layer]:
        """Return the layers of a view; one that didn't change is the same layer again."""
        over = [*self._menu.of(view), *self._notices(view.notices)]
        if view.menu.name not in IN_WORLD:
            return over
        f3 = self._f3.of(view.f3) if view.f3 else []
        hud = self._hud.of(view)
        chat = self._hud.chat(view.chat, view.typed) if view.chat or view.typed is not None else []
        return [*hud, *chat, *over, *f3] if self._is_f3_last else [*hud, *f3, *chat, *over]


WORLDS = ("flat", "noise", "grey noise", "blocks", "gradient", "specks")
"""Kinds of worlds that are drawn at random; ``bright`` and ``dark`` are a sky at noon and a night."""

SEEN = "seen"
"""Instead of a random picture: the world that the player sees (world_layer.py)."""


def random_world(rng: np.random.Generator, kind: str, width: int, height: int) -> Frame:
    """Return a picture (height, width, 3) of one kind of ``WORLDS``, or of ``bright`` or ``dark``."""
    if kind in ("bright", "dark"):
        low, high = (200, 256) if kind == "bright" else (0, 30)
        return _blocks(rng.integers(low, high, (-(-height // 16), -(-width // 16), 3), np.uint8), 16, width, height)
    if kind == "flat":
        return np.full((height, width, 3), rng.integers(0, 256, 3), np.uint8)
    if kind == "noise":
        return rng.integers(0, 256, (height, width, 3), np.uint8)
    if kind == "grey noise":
        return np.repeat(rng.integers(0, 256, (height, width, 1), np.uint8), 3, 2)
    if kind == "gradient":
        slope = np.linspace(rng.integers(0, 256, 3), rng.integers(0, 256, 3), width)
        return np.array(np.broadcast_to(slope, (height, width, 3)), np.uint8)
    size = int(rng.choice([2, 3, 4, 16]))
    coarse = rng.integers(0, 256, (-(-height // size), -(-width // size), 3), np.uint8)
    if kind == "specks":
        coarse = (
            np.where(rng.random((*coarse.shape[:2], 1)) < 0.3, 224, rng.integers(0, 120)).astype(np.uint8).repeat(3, 2)
        )
    return _blocks(coarse, size, width, height)


def _blocks(coarse: Frame, size: int, width: int, height: int) -> Frame:
    return np.ascontiguousarray(coarse.repeat(size, 0).repeat(size, 1)[:height, :width])


_SHIFTS = 16
"""Pixels, in each direction, by which the world behind the text shifts as the player moves from block to block."""

_DIRT, _TILE = 40, 32
"""The greatest brightness of the background of the title and the list of worlds, and its period in pixels."""


class Painter:
    """Draws a game in a window of one size, at one pair of scales.

    Args:
        size, scales, font, edition, words: as of ``ViewLayers``.
        kind: the kind of world behind the text, of ``WORLDS``, bright, dark or ``SEEN``.
        seed: of the random world.
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
        """Return the picture of a view, or a region of it."""
        if view is not self._shown:
            self._shown = view
            world = [self._worlds.of(view.sight)] if view.sight else []
            self._picture.show(self._background(view), [*world, *self._layers.of(view)])
        return self._picture.grab(region)

    def _background(self, view: View) -> Frame:
        if view.menu.name not in IN_WORLD:
            return self._dirt
        x, y, z = view.scene
        return self._scene((7 * x + 3 * y) % _SHIFTS, (5 * z + y) % _SHIFTS)

    def _moved(self, right: int, down: int) -> Frame:
        width, height = self._size
        return self._world[down : down + height, right : right + width]
