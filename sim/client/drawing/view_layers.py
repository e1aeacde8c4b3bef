"""A view of the game as layers, from the hotbar at the back to the menu in front."""

from collections.abc import Mapping
from functools import lru_cache

from mc_nested.live.vision.font import Font
from sim.client.drawing.f3_layers import F3Layers
from sim.client.drawing.hud_layers import HudLayers
from sim.client.drawing.layers import Layer
from sim.client.drawing.letters import Letters
from sim.client.drawing.menu_layers import MenuLayers
from sim.client.drawing.notice_layers import NoticeLayers
from sim.client.game.edition import Edition
from sim.client.game.screens import IN_WORLD
from sim.client.game.view import View


class ViewLayers:
    """All that is drawn over the world, in a window of one size at one GUI scale.

    Args:
        size: the window's width and height in framebuffer pixels.
        scale: framebuffer pixels a GUI pixel.
        font: the font of all texts.
        edition: the game's version.
        words: the menus' texts in another language, by their English.
    """

    def __init__(
        self, size: tuple[int, int], scale: int, font: Font, edition: Edition, words: Mapping[str, str]
    ) -> None:
        letters = Letters(font, scale)
        gui = (-(-size[0] // scale), -(-size[1] // scale))
        self._f3 = F3Layers(letters, size)
        self._hud = HudLayers(letters, gui, edition)
        self._menu = MenuLayers(letters, gui, edition, words)
        # The same layers again, so that what doesn't change isn't drawn again.
        self._notices = lru_cache(8)(NoticeLayers(letters, gui[0]).of)

    def of(self, view: View) -> list[Layer]:
        """The layers of a view; one that didn't change is the same layer again."""
        layers: list[Layer] = []
        if view.menu.name in IN_WORLD:
            layers += self._hud.of(view)
            layers += self._f3.of(view.f3) if view.f3 else []
            layers += self._hud.chat(view.chat, view.typed) if view.chat or view.typed is not None else []
        return layers + self._menu.of(view) + self._notices(view.notices)
