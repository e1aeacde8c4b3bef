"""Recover to the world from any screen, one key or click a look, within PATIENCE_S.

A screen is left by its labels, else by the recorded points.
"""

from mc_nested.errors import LiveError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Deadline
from mc_nested.live.input.input_controller import not_in_front_error
from mc_nested.live.menus.click_points import ClickPoints, click_on
from mc_nested.live.menus.screens import (
    LABELS,
    LEAVE,
    NO_HOTBAR,
    PLAY,
    PLAY_IT,
    POINTS,
    QUIT,
    WORLD,
    ScreenName,
    identify_screen,
)
from mc_nested.live.model.timing import MENU_LOOK_S
from mc_nested.live.model.versions import may_be_shared
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.game_screen import WORLDS_TITLE, Labels

_ROW_LEFT, _ROW_MIDDLE = 119, 18
"""GUI pixels from the window's middle to the icon of a world's row, and from the list's top to the row's middle."""

PATIENCE_S = 60.0
"""How long a recovery may take, a world that loads included."""

FRONT_PATIENCE_S = 20.0
"""How long another window may be in front."""

EFFECT_S = 0.3
"""From a press until its effect is looked for: six ticks."""

UNKNOWN_S = 1.5
"""How long a screen may be unknown before something is pressed: pictures freeze, worlds load."""

FRONT = "the game's window to come to the front"

NOT_ON_A_SERVER: frozenset[ScreenName] = frozenset({"title", "worlds", "servers", "disconnected"})
"""The screens that lead only into a world of one's own, never back to a server."""


class Recovery:
    """Leads back into the world that was left, by what leads from one screen to the next.

    Nothing is clicked where neither label nor point is found.

    If the window's title didn't say that the world was one's own when this was made, a recovery stops at the title
    screen. Otherwise it would enter one's own world instead (FACTS: Input and windows; to 1.14 no title says so).

    Raises (everything): NotInFrontError where the game's window stays behind another; LiveError where the world was
    not reached in time, or where it is a server's and was left; whatever the input controller raises.
    """

    def __init__(self, profile: Profile, connection: GameConnection, points: ClickPoints | None = None) -> None:
        self._profile = profile
        self._screen = connection.screen
        self._display = connection.devices.display
        self._clock = connection.devices.clock
        self._controller = connection.controller
        self._journal = connection.journal
        self._points = points or {}
        self._is_world_chosen = False
        self._is_multiplayer = self._says_multiplayer()

    def recover(self) -> tuple[ScreenName, ...]:
        """Get to the world with its debug screen on, nothing over it, and the game's window in front.

        Return the screens that were shown before the world, in order.
        """
        deadline = Deadline(self._clock, PATIENCE_S)
        passed: list[ScreenName] = []
        unknown_since: float | None = None
        tried_debug = False
        while True:
            self._wait_for_front()
            name, reason = self._identify()
            self._check_server(name)
            if name == "world":
                return tuple(passed)
            if deadline.has_passed:
                raise LiveError(
                    f"the world was not reached in {PATIENCE_S:g} s, the screen is {name} "
                    f"({reason}): open the world, with the debug screen on, and start again"
                )
            if name == "menu" and passed[-2:] == ["menu", "pause"]:
                # Esc closed nothing there, but opened the Game Menu, which was left.
                raise LiveError(NO_HOTBAR)
            if not passed or passed[-1] != name:
                passed.append(name)
                self._journal.note("recovers", screen=name)
            if name != "unknown":
                unknown_since, tried_debug = None, False
                self.leave(name)
            elif unknown_since is None:
                unknown_since = self._clock.now()
            elif self._clock.now() - unknown_since >= UNKNOWN_S:
                # The debug screen may be off; if not, Esc closes what is there, or opens a menu that is known.
                self.press(self._profile.keys.debug if not tried_debug else "esc")
                tried_debug, unknown_since = not tried_debug, None
            self._sleep(EFFECT_S)

    def leave_world(self) -> None:
        """Save the world, and get to the title screen."""
        if self._is_multiplayer:
            raise LiveError("a server's world is not left, since nothing leads back: take a profile without [world]")
        deadline = Deadline(self._clock, PATIENCE_S)
        while (name := self.screen_name()) != "title":
            if deadline.has_passed:
                raise LiveError(f"the title screen was not reached, the screen is {name}: leave the world, start again")
            self._wait_for_front()
            if name == "pause":
                self._click((QUIT,), LEAVE)
            elif name in ("world", "chat"):
                self.press("esc")
            elif name != "unknown":
                self.leave(name)
            self._sleep(EFFECT_S)

    def screen_name(self) -> ScreenName:
        """Return which screen is shown."""
        return self._identify()[0]

    def _identify(self) -> tuple[ScreenName, str]:
        """Return the screen, and why it can't be read. A picture may be torn: a menu without a name is seen twice."""
        seen = identify_screen(self._screen, self._display, self._points)
        if seen[0] != "menu":
            return seen
        self._sleep(MENU_LOOK_S)
        return identify_screen(self._screen, self._display, self._points)

    def _says_multiplayer(self) -> bool:
        return may_be_shared(self._display.title())

    def _check_server(self, name: ScreenName) -> None:
        """Raise LiveError where this screen leads, or has led, from a server to another world, or the reverse."""
        if self._is_multiplayer and name in NOT_ON_A_SERVER:
            raise LiveError(f"the server was left, the screen is {name}: join the server again, then start again")
        if name == "world" and self._says_multiplayer() != self._is_multiplayer:
            was, now = ("a server's", "your own") if self._is_multiplayer else ("your own", "a server's")
            raise LiveError(f"the world was {was}, and is {now} now: go back to the one before, then start again")

    def _wait_for_front(self) -> None:
        deadline = Deadline(self._clock, FRONT_PATIENCE_S)
        if not self._display.is_in_front():
            self._journal.note("waits", on=FRONT)
        while not self._display.is_in_front():
            if deadline.has_passed:
                raise not_in_front_error()
            self._sleep(EFFECT_S)

    def _sleep(self, seconds: float) -> None:
        """Let time pass, whether the window is in front or not; raise where it is ended."""
        self._controller.check_stopped()
        self._controller.check_yielded()
        self._clock.sleep_until(self._clock.now() + seconds)

    # What leads from one screen to the next. The caller has just seen which one is shown.

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

    def _click(self, labels: tuple[str, ...], point: str | None) -> bool:
        """Click on the button with one of these labels, else on the point; return whether anything was clicked."""
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
        """Return the first world's row in the list, a little right of its icon, in framebuffer pixels."""
        scale, (width, _) = self._screen.gui_scale(), self._display.size()
        top = 32 if self._profile.game.dialect == "1.12" else 48
        middle = -(-width // scale) // 2
        return round((middle - _ROW_LEFT + 60) * scale), round((top + _ROW_MIDDLE) * scale)
