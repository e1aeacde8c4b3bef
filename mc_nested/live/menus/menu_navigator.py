"""Leaving the screen that is shown, one key or click at a time: by its labels, else by the recorded points."""

from mc_nested.live.connection import GameConnection
from mc_nested.live.menus.click_points import ClickPoints, click_on
from mc_nested.live.menus.screens import LABELS, LEAVE, PLAY, PLAY_IT, POINTS, QUIT, WORLD, ScreenName
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.game_screen import WORLDS_TITLE, Labels

_ROW_LEFT, _ROW_MIDDLE = 119, 18
"""GUI pixels from the window's middle to the icon of a world's row, and from the list's top to the row's middle."""


class MenuNavigator:
    """Presses what leads from one screen to the next.

    The caller has just seen which screen is shown. Nothing is clicked where neither label nor point is found.

    Raises (everything): whatever the input controller raises.
    """

    def __init__(self, profile: Profile, connection: GameConnection, points: ClickPoints) -> None:
        self._profile = profile
        self._controller = connection.controller
        self._screen = connection.screen
        self._display = connection.devices.display
        self._points = points
        self._is_world_chosen = False

    def press(self, key: str) -> None:
        """Press a key that opens or closes a screen."""
        self._controller.confirm_screen("menu")
        self._controller.tap(key, on="menu")

    def leave(self, name: ScreenName) -> None:
        """Take one step from that screen, a known one outside the world, toward the world."""
        if name in ("chat", "servers", "menu"):
            self.press("esc")
        elif name == "worlds":
            self._enter_world()
        elif not self._click(LABELS[name], POINTS.get(name)) and name == "pause":
            self.press("esc")

    def save_and_quit(self) -> None:
        """Save the world and go to the title screen, from the pause menu."""
        self._click((QUIT,), LEAVE)

    def _click(self, labels: tuple[str, ...], point: str | None) -> bool:
        """Click on the button with one of these labels, else on the point; whether anything was clicked."""
        if self._click_label(self._screen.menu(), labels):
            return True
        return (
            point is not None
            and point in self._points
            and click_on(self._points[point], self._controller, self._display)
        )

    def _click_label(self, menu: Labels, labels: tuple[str, ...]) -> bool:
        for label in labels:
            button = menu.button(label)
            if button.middle is not None and button.is_enabled:
                self._click_at(*button.middle)
                return True
        return False

    def _click_at(self, x: int, y: int) -> None:
        self._controller.confirm_screen("menu")
        self._controller.click_at(x, y)

    def _enter_world(self) -> None:
        """Choose the profile's world by its name, else the first of the list, the one left last; then play it."""
        if self._is_world_chosen and self._click((PLAY,), PLAY_IT):
            self._is_world_chosen = False
            return
        self._is_world_chosen = True
        world = self._profile.world
        if world is not None:
            if name_middle := self._screen.position_of(world.name):
                self._click_at(*name_middle)
        elif WORLD in self._points and not self._screen.menu().shows(WORLDS_TITLE):
            click_on(self._points[WORLD], self._controller, self._display)
        else:
            self._click_at(*self._first_row())

    def _first_row(self) -> tuple[int, int]:
        """The first world's row in the list, a little right of its icon, in framebuffer pixels."""
        scale, (width, _) = self._screen.gui_scale(), self._display.size()
        top = 32 if self._profile.game.dialect == "1.12" else 48
        middle = -(-width // scale) // 2
        return round((middle - _ROW_LEFT + 60) * scale), round((top + _ROW_MIDDLE) * scale)
