"""The menus, drawn: dimmed worlds, shadowed titles, grey buttons (FACTS: Screens and their buttons)."""

from collections.abc import Mapping
from functools import lru_cache

from sim.client.drawing.layers import Blend, Gradient, Layer, Rect
from sim.client.drawing.letters import Letters
from sim.client.game.edition import Edition
from sim.client.game.screens import MenuState, ScreenName, label_colour, menu
from sim.client.game.view import View
from sim.client.game.widgets import WHITE, Colour, MenuText, Panel, Widget

_BLACK: Colour = (0, 0, 0)
_DIM = ((16, 16, 16), 192), ((16, 16, 16), 208)
_DIMMED: frozenset[ScreenName] = frozenset({"pause", "debug_options", "friends"})
_RED = ((80, 0, 0), 96), ((128, 48, 48), 160)
_PANELS = {True: (195, 136, "Building Blocks"), False: (176, 166, "Crafting")}
_DARK: Colour = (64, 64, 64)
_PANEL: Colour = (24, 24, 24)


class MenuLayers:
    """The layers of menus in a window of a size in GUI pixels, in the language of ``words``."""

    def __init__(self, letters: Letters, gui: tuple[int, int], edition: Edition, words: Mapping[str, str]) -> None:
        self._letters, self._gui, self._edition, self._words = letters, gui, edition, words
        self._menu = lru_cache(32)(self._drawn_menu)
        self._inventory = lru_cache(2)(self._drawn_inventory)

    def of(self, view: View) -> list[Layer]:
        """The layers of a view that are in front of all others."""
        if view.menu.name in ("world", "chat"):
            return []
        if view.menu.name == "inventory":
            return self._inventory(view.is_creative)
        buttons = menu(view.menu, self._edition, *self._gui).buttons
        hovered = next((index for index, button in enumerate(buttons) if button.contains(*view.pointer)), -1)
        return self._menu(view.menu, hovered)

    def _drawn_menu(self, state: MenuState, hovered: int) -> list[Layer]:
        layers: list[Layer] = []
        if state.name in _DIMMED:
            layers.append(self._gradient(*_DIM))
        elif state.name == "death":
            layers.append(self._gradient(*_RED))
        shown = menu(state, self._edition, *self._gui)
        layers += [self._fill(_rect(panel), _PANEL, panel.alpha) for panel in shown.panels]
        for index, button in enumerate(shown.buttons):
            if button.is_drawn:
                layers += self._button(button, is_hovered=index == hovered)
            elif state.is_chosen and button.does == "select_world":
                layers.append(self._fill(_rect(button), (128, 128, 128), 80))
        return layers + [self._text(text) for text in shown.texts]

    def _drawn_inventory(self, is_creative: bool) -> list[Layer]:
        width, height, title = _PANELS[is_creative]
        left, top = (self._gui[0] - width) // 2, (self._gui[1] - height) // 2
        panel = self._fill((left, top, left + width, top + height), (198, 198, 198))
        slots = [
            self._fill((x, y, x + 16, y + 16), (139, 139, 139))
            for y in range(top + height - 82, top + height - 20, 18)
            for x in range(left + 8, left + 8 + 9 * 18, 18)
        ]
        return [self._gradient(*_DIM), panel, *slots, self._letters.text(title, left + 8, top + 6, _DARK)]

    def _button(self, button: Widget, *, is_hovered: bool) -> list[Layer]:
        left, top, right, bottom = _rect(button)
        face: Colour = (111, 111, 111) if button.is_active else (44, 44, 44)
        if is_hovered and button.is_active:
            face = (126, 136, 191)
        plain = [
            self._fill((left, top, right, bottom), _BLACK),
            self._fill((left + 1, top + 1, right - 1, bottom - 1), face),
        ]
        if not button.label:
            # A picture of the project's own: what it shows matters to nobody.
            return [*plain, self._fill((left + 5, top + 5, right - 5, bottom - 5), WHITE)]
        colour = button.colour or label_colour(button, self._edition, is_hovered=is_hovered)
        label = self._words.get(button.label, button.label)
        across, down = (button.width - self._letters.width(label)) // 2, (button.height - 8) // 2
        return [*plain, self._letters.text(label, left + across, top + down, colour, shadow=True)]

    def _text(self, text: MenuText) -> Layer:
        words = self._words.get(text.text, text.text)
        wide = self._letters.width(words) * text.size if text.is_centred else 0
        return self._letters.text(words, text.left - wide // 2, text.top, text.colour, shadow=True, size=text.size)

    def _fill(self, gui: Rect, colour: Colour, alpha: int = 255) -> Blend:
        scale = self._letters.scale
        return Blend((gui[0] * scale, gui[1] * scale, gui[2] * scale, gui[3] * scale), colour, alpha)

    def _gradient(self, upper: tuple[Colour, int], lower: tuple[Colour, int]) -> Gradient:
        scale = self._letters.scale
        return Gradient((0, 0, self._gui[0] * scale, self._gui[1] * scale), upper, lower)


def _rect(shown: Widget | Panel) -> Rect:
    return shown.left, shown.top, shown.left + shown.width, shown.top + shown.height
