"""Identify the screen that the game shows; the buttons of each screen.

A screen is known by its labels. Where none is found, as in another language, it is known by the points that a
calibration recorded, if they look like their pictures.
"""

from typing import Literal

from mc_nested.live.devices import Display
from mc_nested.live.menus.click_points import ClickPoints, looks_the_same
from mc_nested.live.vision.game_screen import WORLDS_TITLE, GameScreen, Labels

ScreenName = Literal["world", "chat", "pause", "death", "menu", "disconnected", "title", "worlds", "servers", "unknown"]
"""A ``menu`` lies over the world and has no other name here, such as the inventory, or a pause without a menu."""

LABELS: dict[ScreenName, tuple[str, ...]] = {
    "pause": ("Back to Game",),
    "death": ("Respawn",),
    "disconnected": ("Back to Server List", "Back to server list", "Back to Title Screen", "Back to title screen"),
    "title": ("Singleplayer",),
}
"""The buttons by which a screen is known and left, in every version (FACTS: Screens and their buttons)."""

TITLES: dict[ScreenName, str] = {"worlds": WORLDS_TITLE, "servers": "Play Multiplayer"}
"""The titles of the lists, whose buttons are greyed or lead elsewhere."""

QUIT = "Save and Quit to Title"
PLAY = "Play Selected World"

BACK = "back_to_game"
LEAVE = "save_and_quit_to_title"
ENTER = "singleplayer"
WORLD = "world"
PLAY_IT = "play_selected_world"
RESPAWN = "respawn"
"""The names of the points that stand for buttons whose labels aren't found."""

NO_HOTBAR = (
    "the hotbar isn't seen as the game draws it: take off a resource pack that changes it, leave the spectator mode, "
    "and close what lies over the world"
)
"""What may be so where nothing else shows why a world that can be read isn't seen played."""

POINTS: dict[ScreenName, str] = {"pause": BACK, "death": RESPAWN, "title": ENTER, "worlds": PLAY_IT}
"""The points by which a screen is known."""


def identify_screen(screen: GameScreen, display: Display, points: ClickPoints) -> tuple[ScreenName, str]:
    """Return which screen is shown, and why the debug screen can't be read there; "" where it can."""
    reading = screen.read()
    if reading.problem is None and screen.shows_world():
        return "world", ""
    if reading.problem is None and screen.is_chat_open():
        return "chat", ""
    # From 1.21.9 on the debug screen can be read over a menu, too.
    name = _menu_shown(screen, display, points, otherwise="unknown" if reading.problem else "menu")
    return name, reading.problem or "a menu lies over the world"


def _menu_shown(screen: GameScreen, display: Display, points: ClickPoints, otherwise: ScreenName) -> ScreenName:
    """Return the menu or the chat that is shown, by its marks from the surest on."""
    if (name := menu_name(screen.menu())) is not None:
        return name
    if screen.is_chat_open():
        return "chat"
    if (name := _identify_by_points(display, points)) != "unknown":
        return name
    return "death" if screen.shows_death() else otherwise


def menu_name(menu: Labels) -> ScreenName | None:
    """Return which menu is shown, by its labels; None where none is found."""
    for name, labels in LABELS.items():
        if any(menu.button(label).middle for label in labels):
            return name
    # From 1.21.9 on the debug screen may lie over the first button.
    if menu.button(QUIT).middle:
        return "pause"
    return next((name for name, title in TITLES.items() if menu.shows(title)), None)


def _identify_by_points(display: Display, points: ClickPoints) -> ScreenName:
    known = {name: points[point] for name, point in POINTS.items() if point in points}
    if not known:
        return "unknown"
    frame = display.grab()
    return next((name for name, point in known.items() if looks_the_same(point, frame)), "unknown")
