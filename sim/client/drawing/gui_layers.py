"""The layers over the world: crosshair, hotbar and chat while it is played, else a menu; over everything, notices.

Menus have dimmed worlds, shadowed titles and grey buttons (FACTS: Screens and their buttons; Answers). Notices (toasts)
are boxes at the upper right (FACTS: The F3 debug screen).
"""

from collections.abc import Mapping
from functools import lru_cache

from sim.client.drawing.layers import Gradient, Layer, Rect
from sim.client.drawing.letters import Letters
from sim.client.drawing.world_shapes import block_colour
from sim.client.game.chat import ChatLine, TypedLine
from sim.client.game.edition import Edition
from sim.client.game.realm import Stack
from sim.client.game.screens import MenuState, ScreenName, label_colour, menu
from sim.client.game.view import View
from sim.client.game.widgets import DRAFT, PLAIN, WHITE, Colour, MenuPanel, MenuText, Widget

_CHAT_WIDTH = 320
_PITCH = 9
_OPAQUE = 8
_AXES: tuple[Colour, ...] = ((255, 0, 0), (0, 255, 0), (127, 127, 255))

_HOTBAR_FRAME = {0: 0, 1: 0x93, 2: 0x5D, 19: 0x7E, 20: 0x5D, 21: 0}
"""The greys of the hotbar's opaque rows, by the row from its top (FACTS: Screens and their buttons)."""

_CHOSEN: Colour = (240, 240, 240)
"""The frame around the chosen slot."""


class HudLayers:
    """The layers in a window of a size in GUI pixels; what didn't change is the same layer again."""

    def __init__(self, letters: Letters, gui: tuple[int, int], edition: Edition) -> None:
        self._letters, self._fill = letters, letters.fill
        self._width, self._height = gui
        self._chat_bottom = self._height - (40 if edition.since(1, 13) else 48)
        self._crosshair = lru_cache(2)(self._drawn_crosshair)
        self._hotbar = lru_cache(16)(self._drawn_hotbar)
        self._line = lru_cache(256)(self._drawn_line)
        self._wrapped = lru_cache(256)(self._wrap)
        self._input = lru_cache(16)(self._drawn_input)

    def of(self, view: View) -> list[Layer]:
        """Return crosshair and hotbar."""
        if not view.hotbar:
            return []
        return [*self._crosshair(view.f3 is not None and view.f3.has_axes), *self._hotbar(view.hotbar, view.slot)]

    def chat(self, lines: tuple[ChatLine, ...], typed: TypedLine | None) -> list[Layer]:
        """Return the chat's lines, the newest at the bottom, and the line being typed."""
        layers: list[Layer] = []
        row = 0
        for line in lines:
            for text in reversed(self._wrapped(line.text)):
                layers += self._line(line._replace(text=text), row)
                row += 1
        return layers + (self._input(typed) if typed is not None else [])

    def _drawn_crosshair(self, has_axes: bool) -> list[Layer]:
        x, y = self._width // 2, self._height // 2
        if not has_axes:
            white = (230, 230, 230)
            return [self._fill((x - 4, y, x + 5, y + 1), white), self._fill((x, y - 4, x + 1, y + 5), white)]
        ends = ((x, y, x + 8, y + 1), (x, y - 8, x + 1, y), (x - 6, y + 1, x, y + 2))
        return [self._fill(end, colour) for end, colour in zip(ends, _AXES, strict=True)]

    def _drawn_hotbar(self, hotbar: tuple[Stack | None, ...], slot: int) -> list[Layer]:
        left, top = self._width // 2 - 91, self._height - 22
        layers: list[Layer] = [
            self._fill((left, top, left + 182, top + 22), (0, 0, 0), 128),
            *(
                self._fill((left, top + row, left + 182, top + row + 1), (shade, shade, shade))
                for row, shade in _HOTBAR_FRAME.items()
            ),
        ]
        chosen = left + 20 * slot
        ring = ((-1, -1, 23, 2), (-1, 2, 2, 20), (20, 2, 23, 20), (-1, 20, 23, 22))
        layers += [self._fill((chosen + x, top + y, chosen + w, top + h), _CHOSEN) for x, y, w, h in ring]
        for index, stack in enumerate(hotbar):
            if stack is None:
                continue
            x, y = left + 3 + 20 * index, top + 3
            layers.append(self._fill((x, y, x + 16, y + 16), block_colour(stack.block)))
            if stack.count > 1:
                count = str(stack.count)
                left_of_count = x + 17 - self._letters.width(count)
                layers.append(self._letters.text(count, left_of_count, y + 9, (255, 255, 255), shadow=True))
        return layers

    def _wrap(self, text: str) -> list[str]:
        lines = [""]
        for word in text.split(" "):
            longer = f"{lines[-1]} {word}" if lines[-1] else word
            if lines[-1] and self._letters.width(longer) > _CHAT_WIDTH:
                lines.append(word)
            else:
                lines[-1] = longer
        return lines

    def _drawn_line(self, line: ChatLine, row: int) -> list[Layer]:
        text, colour, opacity, ground = line
        bottom = self._chat_bottom - _PITCH * row
        faded = (colour[0] * opacity // _OPAQUE, colour[1] * opacity // _OPAQUE, colour[2] * opacity // _OPAQUE)
        return [
            self._fill((0, bottom - _PITCH, _CHAT_WIDTH + 8, bottom), (0, 0, 0), ground * opacity // _OPAQUE),
            self._letters.text(text, 4, bottom - _PITCH + 1, faded, shadow=True),
        ]

    def _drawn_input(self, typed: TypedLine) -> list[Layer]:
        letters, top = self._letters, self._height - 12
        shown, cursor = typed.text, "_"
        while letters.width(shown + cursor) > self._width - 8:
            shown = shown[1:]
        ground = self._fill((2, self._height - 14, self._width - 2, self._height - 2), (0, 0, 0), typed.ground)
        if not typed.is_draft:
            return [ground, letters.text(shown + cursor, 4, top, PLAIN, shadow=True)]
        return [
            ground,
            letters.text(shown, 4, top, DRAFT, shadow=True, is_slanted=True),
            letters.text(cursor, 4 + letters.width(shown), top, PLAIN, shadow=True),
        ]


WIDTH, HEIGHT, MOST = 160, 32, 5
"""GUI pixels of a notice, and how many there are at most."""

_EDGE: Colour = (85, 85, 85)
_FACE: Colour = (33, 33, 33)
_TITLE: Colour = (255, 255, 0)


def notice_layers(letters: Letters, width: int, notices: tuple[str, ...]) -> list[Layer]:
    """Return the layers of notices, from the top down, in a window so many GUI pixels wide.

    An empty text leaves its place free.
    """
    layers: list[Layer] = []
    left = width - WIDTH
    for place, text in enumerate(notices[:MOST]):
        if text:
            top = place * HEIGHT
            layers += [
                letters.fill((left, top, left + WIDTH, top + HEIGHT), _EDGE),
                letters.fill((left + 2, top + 2, left + WIDTH - 2, top + HEIGHT - 2), _FACE),
                letters.fill((left + 8, top + 8, left + 24, top + 24), _EDGE),
                letters.text(text, left + 30, top + 7, _TITLE),
                letters.text("Press E", left + 30, top + 18, WHITE),
            ]
    return layers


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
        self._letters, self._fill = letters, letters.fill
        self._gui, self._edition, self._words = gui, edition, words
        self._menu = lru_cache(32)(self._drawn_menu)
        self._inventory = lru_cache(2)(self._drawn_inventory)

    def of(self, view: View) -> list[Layer]:
        """Return the layers of a view that are in front of all others."""
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

    def _gradient(self, upper: tuple[Colour, int], lower: tuple[Colour, int]) -> Gradient:
        scale = self._letters.scale
        return Gradient((0, 0, self._gui[0] * scale, self._gui[1] * scale), upper, lower)


def _rect(shown: Widget | MenuPanel) -> Rect:
    return shown.left, shown.top, shown.left + shown.width, shown.top + shown.height
