"""The screens over and beside the world: their texts and buttons (FACTS: Screens and their buttons).

Everything is in GUI pixels of a window that is ``width`` x ``height`` of them.
"""

from dataclasses import dataclass
from typing import Literal

from sim.client.edition import Edition
from sim.client.layers import Colour

ScreenName = Literal[
    "world", "chat", "inventory", "pause", "death", "disconnected", "title", "worlds", "loading", "saving"
]
IN_WORLD: frozenset[ScreenName] = frozenset({"world", "chat", "inventory", "pause", "death"})

Effect = Literal[
    "", "resume", "leave", "respawn", "to_title", "to_worlds", "select_world", "enter_world", "enter_selected"
]
"""What a click does; nothing, for the buttons that nobody needs."""

WHITE: Colour = (255, 255, 255)
GREY: Colour = (160, 160, 160)
_OLD_WHITE: Colour = (224, 224, 224)
_OLD_HOVER: Colour = (255, 255, 160)

DEATH_WAIT = 20
"""Ticks before the buttons of the death screen can be pressed."""

_ROW = (270, 36)
_ICON = 32


@dataclass(frozen=True)
class Button:
    """A button, or a part of the screen that can be clicked and has no label of its own."""

    label: str
    left: int
    top: int
    width: int
    does: Effect = ""
    height: int = 20
    is_active: bool = True
    is_drawn: bool = True

    def holds(self, x: float, y: float) -> bool:
        """Whether a place in GUI pixels lies on it."""
        return self.left <= x < self.left + self.width and self.top <= y < self.top + self.height

    @property
    def middle(self) -> tuple[float, float]:
        """Its middle, in GUI pixels."""
        return self.left + self.width / 2, self.top + self.height / 2


@dataclass(frozen=True)
class Text:
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

    texts: tuple[Text, ...] = ()
    buttons: tuple[Button, ...] = ()


@dataclass(frozen=True)
class MenuState:
    """What a menu's look depends on: whether its buttons can be pressed yet, and whether a world is chosen."""

    name: ScreenName
    is_ready: bool = True
    is_chosen: bool = False
    reason: str = ""
    world: str = "New World"


def menu(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    """The menu of a screen; an empty one for the world, the chat and the inventory."""
    if state.name == "title":
        return _title(edition, width, height)
    if state.name == "worlds":
        return _worlds(state, edition, width, height)
    if state.name == "pause":
        return _pause(edition, width, height)
    if state.name == "death":
        return _death(state, edition, width, height)
    if state.name == "disconnected":
        return _disconnected(state, edition, width, height)
    if state.name == "loading":
        return Menu(
            (Text("Loading terrain..." if edition.since(1, 13) else "Loading terrain", width // 2, height // 2),)
        )
    if state.name == "saving":
        return Menu((Text("Saving world", width // 2, height // 2),))
    return Menu()


def label_colour(button: Button, edition: Edition, *, is_hovered: bool) -> Colour:
    """The colour of a button's label."""
    if not button.is_active:
        return GREY
    if edition.since(1, 16):
        return WHITE
    return _OLD_HOVER if is_hovered else _OLD_WHITE


def _title(edition: Edition, width: int, height: int) -> Menu:
    left, top = width // 2 - 100, height // 4 + 48
    buttons = (
        Button("Singleplayer", left, top, 200, "to_worlds"),
        Button("Multiplayer", left, top + 24, 200),
        Button("Minecraft Realms", left, top + 48, 200),
        Button("Options...", left, top + 84, 98),
        Button("Quit Game", width // 2 + 2, top + 84, 98),
    )
    version = Text(f"Minecraft {edition.version}", 2, height - 10, is_centred=False)
    return Menu((Text("MINECRAFT", width // 2, 30, size=3), version), buttons)


def _worlds(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    middle, lower, last = width // 2, height - 28, "Back" if edition.since(1, 21, 9) else "Cancel"
    top = 48 if edition.since(1, 13) else 32
    left = middle - _ROW[0] // 2
    chosen = state.is_chosen
    row = (
        Button("", left, top, _ICON, "enter_world", _ROW[1], is_drawn=False),
        Button("", left + _ICON, top, _ROW[0] - _ICON, "select_world", _ROW[1], is_drawn=False),
    )
    upper = (
        Button("Play Selected World", middle - 154, height - 52, 150, "enter_selected", is_active=chosen),
        Button("Create New World", middle + 4, height - 52, 150),
    )
    grid = ((-154, 71), (-75, 71), (4, 71), (83, 71)) if edition.since(1, 21, 9) else _OLD_GRID
    names = ("Edit", "Delete", "Re-Create", last)
    below = tuple(
        Button(name, middle + x, lower, wide, "to_title" if name == last else "", is_active=chosen or name == last)
        for name, (x, wide) in zip(names, grid, strict=True)
    )
    texts = (
        Text("Select World", middle, 8 if edition.since(1, 13) else 20),
        Text(state.world, left + _ICON + 3, top + 1, is_centred=False),
        Text("Creative Mode, Cheats", left + _ICON + 3, top + 21, GREY, is_centred=False),
    )
    return Menu(texts, (*row, *upper, *below))


_OLD_GRID = ((-154, 72), (-76, 72), (4, 72), (82, 72))


def _pause(edition: Edition, width: int, height: int) -> Menu:
    middle = width // 2
    title = (Text("Game Menu", middle, 40),)
    top = (height - 166) // 4 + 50 if edition.since(1, 19, 4) else height // 4 + 8
    left, wide, right = middle - 100, 200, middle + 2
    rows = [(24, ("Advancements", "Statistics")), (72, ("Options...", "Open to LAN"))]
    if edition.since(1, 14):
        left, wide, right = middle - 102, 204, middle + 4
        rows.insert(1, (48, ("Give Feedback", "Report Bugs")))
    pairs = tuple(
        Button(name, x, top + down, 98) for down, row in rows for x, name in zip((left, right), row, strict=True)
    )
    back = Button("Back to Game", left, top, wide, "resume")
    leave = Button("Save and Quit to Title", left, top + 96, wide, "leave")
    return Menu(title, (back, *pairs, leave))


def _death(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    new, left = edition.since(1, 17), width // 2 - 100
    buttons = (
        Button("Respawn", left, height // 4 + 72, 200, "respawn", is_active=state.is_ready),
        Button(
            "Title Screen" if new else "Title screen", left, height // 4 + 96, 200, "leave", is_active=state.is_ready
        ),
    )
    title = Text("You Died!" if new else "You died!", width // 2, 60, size=2)
    return Menu((title, Text("Score: 0", width // 2, 100)), buttons)


def _disconnected(state: MenuState, edition: Edition, width: int, height: int) -> Menu:
    label = "Back to Title Screen" if edition.since(1, 17) else "Back to title screen"
    top = min(height // 2 + 13, height - 30)
    texts = (
        Text("Connection Lost", width // 2, height // 2 - 22, GREY),
        Text(state.reason, width // 2, height // 2 - 4),
    )
    return Menu(texts, (Button(label, width // 2 - 100, top, 200, "to_title"),))
