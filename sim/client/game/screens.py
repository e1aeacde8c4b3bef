"""The game's screens other than the world: their texts and buttons (FACTS: Screens and their buttons).

Positions and sizes are in GUI pixels; ``width`` and ``height`` are the window's.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, NamedTuple

from sim.client.game.colours import GREY, WHITE, Colour
from sim.client.game.edition import Edition

ScreenName = Literal[
    "world", "chat", "inventory", "pause", "death", "disconnected", "title", "worlds", "servers", "loading", "saving"
]
IN_WORLD: frozenset[ScreenName] = frozenset({"world", "chat", "inventory", "pause", "death"})

Effect = Literal[
    "",
    "resume",
    "leave",
    "respawn",
    "to_title",
    "to_worlds",
    "to_servers",
    "select_world",
    "enter_world",
    "enter_selected",
]
"""What a click does: nothing for buttons that no test needs."""

_OLD_WHITE: Colour = (224, 224, 224)
_OLD_HOVER: Colour = (255, 255, 160)

DEATH_WAIT = 20
"""Ticks before the buttons of the death screen become active."""

_ROW = (270, 36)
_ICON = 32
_GRID = ((-154, 71), (-75, 71), (4, 71), (83, 71))
_OLD_GRID = ((-154, 72), (-76, 72), (4, 72), (82, 72))
"""Left edges from the middle, and widths, of the lower buttons of the list of worlds; the old one before 1.21.9."""


@dataclass(frozen=True)
class Widget:
    """A button, or an unlabelled part of the screen that can be clicked."""

    label: str
    left: int
    top: int
    width: int
    does: Effect = ""
    height: int = 20
    is_active: bool = True
    is_drawn: bool = True

    def contains(self, x: float, y: float) -> bool:
        """Whether a position in GUI pixels lies on it."""
        return self.left <= x < self.left + self.width and self.top <= y < self.top + self.height

    @property
    def middle(self) -> tuple[float, float]:
        """Its middle, in GUI pixels."""
        return self.left + self.width / 2, self.top + self.height / 2


@dataclass(frozen=True)
class MenuText:
    """A text with a shadow; ``left`` is its middle where it is centred, and ``size`` 2 a large title."""

    text: str
    left: int
    top: int
    colour: Colour = WHITE
    is_centred: bool = True
    size: int = 1


@dataclass(frozen=True)
class Menu:
    """A screen's texts and buttons."""

    texts: tuple[MenuText, ...] = ()
    buttons: tuple[Widget, ...] = ()


class MenuState(NamedTuple):
    """What the look of a screen depends on: ``is_ready`` is whether its buttons are active yet."""

    name: ScreenName
    is_ready: bool = True
    is_chosen: bool = False
    reason: str = ""
    world: str = "New World"


def menu(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    """The menu of a screen; an empty one for the world, the chat and the inventory."""
    laid_out = _MENUS.get(state.name)
    return laid_out(state, edition, width, height) if laid_out else Menu()


def label_colour(button: Widget, edition: Edition, *, is_hovered: bool) -> Colour:
    """The colour of a button's label."""
    if not button.is_active:
        return GREY
    if edition.since(1, 16):
        return WHITE
    return _OLD_HOVER if is_hovered else _OLD_WHITE


def _title(_state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    left, top = width // 2 - 100, height // 4 + 48
    buttons = (
        Widget("Singleplayer", left, top, 200, "to_worlds"),
        Widget("Multiplayer", left, top + 24, 200, "to_servers"),
        Widget("Minecraft Realms", left, top + 48, 200),
        Widget("Options...", left, top + 84, 98),
        Widget("Quit Game", width // 2 + 2, top + 84, 98),
    )
    version = MenuText(f"Minecraft {edition.version}", 2, height - 10, is_centred=False)
    return Menu((MenuText("MINECRAFT", width // 2, 30, size=3), version), buttons)


def _worlds(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    middle, lower, last = width // 2, height - 28, "Back" if edition.since(1, 20, 4) else "Cancel"
    top = 48 if edition.since(1, 13) else 32
    left = middle - _ROW[0] // 2
    chosen = state.is_chosen
    row = (
        Widget("", left, top, _ICON, "enter_world", _ROW[1], is_drawn=False),
        Widget("", left + _ICON, top, _ROW[0] - _ICON, "select_world", _ROW[1], is_drawn=False),
    )
    upper = (
        Widget("Play Selected World", middle - 154, height - 52, 150, "enter_selected", is_active=chosen),
        Widget("Create New World", middle + 4, height - 52, 150),
    )
    grid = _GRID if edition.since(1, 21, 9) else _OLD_GRID
    names = ("Edit", "Delete", "Re-Create", last)
    below = tuple(
        Widget(name, middle + x, lower, wide, "to_title" if name == last else "", is_active=chosen or name == last)
        for name, (x, wide) in zip(names, grid, strict=True)
    )
    texts = (
        MenuText("Select World", middle, 8 if edition.since(1, 13) else 20),
        MenuText(state.world, left + _ICON + 3, top + 1, is_centred=False),
        MenuText("Creative Mode, Cheats", left + _ICON + 3, top + 21, GREY, is_centred=False),
    )
    return Menu(texts, (*row, *upper, *below))


def _servers(_state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    middle, upper, lower = width // 2, height - 52, height - 28
    last = "Back" if edition.since(1, 20, 4) else "Cancel"
    buttons = (
        Widget("Join Server", middle - 154, upper, 100, is_active=False),
        Widget("Direct Connection" if edition.since(1, 16) else "Direct Connect", middle - 50, upper, 100),
        Widget("Add Server", middle + 54, upper, 100),
        Widget("Edit", middle - 154, lower, 70, is_active=False),
        Widget("Delete", middle - 74, lower, 70, is_active=False),
        Widget("Refresh", middle + 4, lower, 70),
        Widget(last, middle + 80, lower, 75, "to_title"),
    )
    # A server keeps the name that it gets where the player types none.
    server = MenuText("Minecraft Server", middle - _ROW[0] // 2 + _ICON + 3, 37, is_centred=False)
    return Menu((MenuText("Play Multiplayer", middle, 20), server), buttons)


def _pause(_state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    middle = width // 2
    title = (MenuText("Game Menu", middle, 40),)
    top = (height - 166) // 4 + 50 if edition.since(1, 19, 4) else height // 4 + 8
    left, wide, right = middle - 100, 200, middle + 2
    rows = [(24, ("Advancements", "Statistics")), (72, ("Options...", "Open to LAN"))]
    if edition.since(1, 14):
        left, wide, right = middle - 102, 204, middle + 4
        rows.insert(1, (48, ("Give Feedback", "Report Bugs")))
    pairs = tuple(
        Widget(name, x, top + down, 98) for down, row in rows for x, name in zip((left, right), row, strict=True)
    )
    back = Widget("Back to Game", left, top, wide, "resume")
    leave = Widget("Save and Quit to Title", left, top + 96, wide, "leave")
    return Menu(title, (back, *pairs, leave))


def _death(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    new, left = edition.since(1, 17), width // 2 - 100
    buttons = (
        Widget("Respawn", left, height // 4 + 72, 200, "respawn", is_active=state.is_ready),
        Widget(
            "Title Screen" if new else "Title screen", left, height // 4 + 96, 200, "leave", is_active=state.is_ready
        ),
    )
    title = MenuText("You Died!" if new else "You died!", width // 2, 60, size=2)
    return Menu((title, MenuText("Score: 0", width // 2, 100)), buttons)


def _disconnected(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    label = "Back to Server List" if edition.since(1, 17) else "Back to server list"
    top = min(height // 2 + 13, height - 30)
    texts = (
        MenuText("Connection Lost", width // 2, height // 2 - 22, GREY),
        MenuText(state.reason, width // 2, height // 2 - 4),
    )
    return Menu(texts, (Widget(label, width // 2 - 100, top, 200, "to_servers"),))


def _loading(_state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    dots = "..." if edition.since(1, 13) else ""
    return Menu((MenuText(f"Loading terrain{dots}", width // 2, height // 2),))


def _saving(_state: MenuState, _edition: Edition, width: int, height: int) -> Menu:
    return Menu((MenuText("Saving world", width // 2, height // 2),))


_MENUS: dict[ScreenName, Callable[[MenuState, Edition, int, int], Menu]] = {
    "title": _title,
    "worlds": _worlds,
    "servers": _servers,
    "pause": _pause,
    "death": _death,
    "disconnected": _disconnected,
    "loading": _loading,
    "saving": _saving,
}
