"""The game's screens other than the world: their texts and buttons (FACTS: Screens and their buttons).

Positions and sizes are in GUI pixels; ``width`` and ``height`` are the window's.
"""

from collections.abc import Callable
from typing import Literal, NamedTuple

from sim.client.game.debug_options import Choice, debug_options
from sim.client.game.edition import Edition
from sim.client.game.widgets import GREY, WHITE, Colour, Menu, MenuPanel, MenuText, Widget

ScreenName = Literal[
    "world",
    "chat",
    "inventory",
    "pause",
    "paused",
    "debug_options",
    "friends",
    "death",
    "disconnected",
    "title",
    "title_friends",
    "worlds",
    "servers",
    "loading",
    "saving",
]
"""``paused`` is the pause without a menu; the friends are opened over a world, or over the title."""

PAUSING: frozenset[ScreenName] = frozenset({"pause", "paused", "debug_options", "friends"})
"""The screens that stop the world."""

IN_WORLD: frozenset[ScreenName] = PAUSING | {"world", "chat", "inventory", "death"}

FRIENDS: frozenset[ScreenName] = frozenset({"friends", "title_friends"})

_OLD_WHITE: Colour = (224, 224, 224)
_OLD_HOVER: Colour = (255, 255, 160)

DEATH_WAIT = 20
"""Ticks before the buttons of the death screen become active."""

_ROW = (270, 36)
_ICON = 32
_ICONS = 20, 4
"""An icon's side, and the gap between two."""

_FRIENDS_WIDTH, _FRIENDS_ABOVE = 220, 80
"""The width of the friends' panel inside its border, and how much lower than the window it is."""

_BORDER = 8
_GRID = ((-154, 71), (-75, 71), (4, 71), (83, 71))
_OLD_GRID = ((-154, 72), (-76, 72), (4, 72), (82, 72))
"""Left edges from the middle, and widths, of the lower buttons of the list of worlds; the old one before 1.21.9."""


class MenuState(NamedTuple):
    """The state that the look of a screen depends on: ``is_ready`` is whether its buttons are active yet.

    ``choices`` are those of the debug options, found by the text ``searched``.
    """

    name: ScreenName
    is_ready: bool = True
    is_chosen: bool = False
    reason: str = ""
    world: str = "New World"
    choices: tuple[Choice, ...] = ()
    searched: str = ""


def menu(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    """Return the menu of a screen; an empty one for the world, the chat and the inventory."""
    laid_out = _MENUS.get(state.name)
    return laid_out(state, edition, width, height) if laid_out else Menu()


def label_colour(button: Widget, edition: Edition, *, is_hovered: bool) -> Colour:
    """Return the colour of a button's label."""
    if not button.is_active:
        return GREY
    if edition.since(1, 16):
        return WHITE
    return _OLD_HOVER if is_hovered else _OLD_WHITE


def _title(_state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    left, top = width // 2 - 100, height // 4 + 48
    has_icons = edition.since(26, 2)
    last = top + (96 if has_icons else 84)
    buttons = (
        Widget("Singleplayer", left, top, 200, "to_worlds"),
        Widget("Multiplayer", left, top + 24, 200, "to_servers"),
        Widget("Minecraft Realms", left, top + 48, 200),
        *(_icons(3, width, top + 72) if has_icons else ()),
        Widget("Options...", left, last, 98),
        Widget("Quit Game", width // 2 + 2, last, 98),
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
    others = "World Options..." if edition.since(26, 3) else "Open to LAN"
    rows = [(24, ("Advancements", "Statistics")), (72, ("Options...", others))]
    has_icons = edition.since(26, 2)
    if edition.since(1, 14):
        left, wide, right = middle - 102, 204, middle + 4
    if edition.since(1, 14) and not has_icons:
        rows.insert(1, (48, ("Give Feedback", "Report Bugs")))
    pairs = tuple(
        Widget(name, x, top + down, 98) for down, row in rows for x, name in zip((left, right), row, strict=True)
    )
    icons = _icons(4, width, top + 48) if has_icons else ()
    back = Widget("Back to Game", left, top, wide, "resume")
    leave = Widget("Save and Quit to Title", left, top + 96, wide, "leave")
    return Menu(title, (back, *pairs, *icons, leave))


def _paused(_state: MenuState, edition: Edition, width: int, _height: int) -> Menu:
    return Menu((MenuText("Game Paused" if edition.since(1, 17) else "Game paused", width // 2, 10),))


def _friends(_state: MenuState, _edition: Edition, width: int, height: int) -> Menu:
    """Return two tabs above a panel. A click beside them leads back."""
    left, high = width // 2 - _FRIENDS_WIDTH // 2, height - _FRIENDS_ABOVE
    top = _FRIENDS_ABOVE // 2
    tabs = tuple(
        Widget(name, left + across, top - 27, _FRIENDS_WIDTH // 2, is_active=across > 0)
        for across, name in ((0, "Friends"), (_FRIENDS_WIDTH // 2, "Requests (0)"))
    )
    panel = MenuPanel(left - _BORDER, top - _BORDER, _FRIENDS_WIDTH + 2 * _BORDER, high + 2 * _BORDER + 1)
    inside = Widget("", panel.left, top - 27, panel.width, height=27 + high + 2 * _BORDER, is_drawn=False)
    beside = Widget("", 0, 0, width, "behind", height, is_drawn=False)
    return Menu((MenuText("Loading friends", width // 2, height // 2),), (*tabs, inside, beside), (panel,))


def _debug_options(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    return debug_options(state.choices, state.searched, edition, width, height)


def _icons(count: int, width: int, top: int) -> tuple[Widget, ...]:
    """Return a row of so many buttons with pictures, in the middle."""
    side, gap = _ICONS
    left = width // 2 - (count * (side + gap) - gap) // 2
    return tuple(Widget("", left + index * (side + gap), top, side, height=side) for index in range(count))


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
    "paused": _paused,
    "debug_options": _debug_options,
    "friends": _friends,
    "title_friends": _friends,
    "death": _death,
    "disconnected": _disconnected,
    "loading": _loading,
    "saving": _saving,
}
