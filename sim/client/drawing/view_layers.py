"""A view of the game as layers, from the hotbar at the back to the menu in front.

From 1.21.9 on the debug screen lies over all of them (FACTS: The F3 debug screen).
"""

from collections.abc import Mapping
from functools import lru_cache

from mc_nested.live.model.scales import Scales
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
        self._notices = lru_cache(8)(NoticeLayers(letters, gui[0]).of)
        self._is_f3_last = edition.since(1, 21, 9)

    def of(self, view: View) -> list[Layer]:
        """The layers of a view; one that didn't change is the same layer again."""
        f3 = self._f3.of(view.f3) if view.f3 and view.menu.name in IN_WORLD else []
        hud, chat = self._hud_and_chat(view)
        over = [*self._menu.of(view), *self._notices(view.notices)]
        return [*hud, *chat, *over, *f3] if self._is_f3_last else [*hud, *f3, *chat, *over]

    def _hud_and_chat(self, view: View) -> tuple[list[Layer], list[Layer]]:
        if view.menu.name not in IN_WORLD:
            return [], []
        has_chat = view.chat or view.typed is not None
        return self._hud.of(view), self._hud.chat(view.chat, view.typed) if has_chat else []
