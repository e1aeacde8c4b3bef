"""The way back into the world from whatever screen is there, one press a look, in bounded time.

A screen is known by its labels; where none is found, as in another language, by the points that a calibration recorded,
if they look like their pictures.
"""

from dataclasses import dataclass
from typing import Literal

from mc_nested.errors import LiveError, NotInFrontError
from mc_nested.live.click_points import ClickPoints, click_on, looks_the_same
from mc_nested.live.devices import Clock, Display
from mc_nested.live.game_screen import WORLDS_TITLE, GameScreen, Labels
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile

ScreenName = Literal["world", "chat", "pause", "death", "disconnected", "title", "worlds", "unknown"]

LABELS: dict[ScreenName, tuple[str, ...]] = {
    "pause": ("Back to Game",),
    "death": ("Respawn",),
    "disconnected": ("Back to Title Screen", "Back to title screen", "Back to Menu"),
    "title": ("Singleplayer",),
}
"""The buttons that screens are known by, and left with, in every version (FACTS: Screens and their buttons)."""

QUIT = "Save and Quit to Title"
PLAY = "Play Selected World"

BACK = "back_to_game"
LEAVE = "save_and_quit_to_title"
ENTER = "singleplayer"
WORLD = "world"
PLAY_IT = "play_selected_world"
RESPAWN = "respawn"
"""The names of the points that stand for buttons whose labels aren't found."""

POINTS: dict[ScreenName, str] = {"pause": BACK, "death": RESPAWN, "title": ENTER, "worlds": PLAY_IT}
"""The points that screens are known by."""

PATIENCE_S = 60.0
"""How long the way back may take, a world that loads included."""

FRONT_PATIENCE_S = 20.0
"""How long another window may be in front."""

AFTER_S = 0.3
"""From a press until its effect is looked for: six ticks."""

UNKNOWN_S = 1.5
"""How long a screen may be unknown before something is pressed: pictures freeze, worlds load."""

NOT_ON_A_SERVER: frozenset[ScreenName] = frozenset({"title", "worlds", "disconnected"})
"""The screens from which the way leads into a world of one's own, and never back to a server."""

_ROW_LEFT, _ROW_MIDDLE = 119, 18
"""GUI pixels from the window's middle to the icon of a world's row, and from the list's top to the row's middle."""


@dataclass(frozen=True)
class Way:
    """The screens that were there on a way back, in order."""

    screens: tuple[ScreenName, ...]


class WayBack:
    """Finds the way back into the world that was left.

    Where the window's title said Multiplayer when this was made, there is none from the title screen on: nobody's own
    world is entered instead (FACTS: Input and windows; to 1.14 no title says so).

    Raises (everything): NotInFrontError where the game's window stays behind another; LiveError where the world was
    not found in time, or where it is a server's and was left; what the hands raise.
    """

    def __init__(
        self,
        profile: Profile,
        hands: Hands,
        screen: GameScreen,
        display: Display,
        clock: Clock,
        points: ClickPoints | None = None,
    ) -> None:
        self._profile = profile
        self._hands = hands
        self._screen = screen
        self._display = display
        self._clock = clock
        self._points = points or {}
        self._is_chosen = False
        self._is_multiplayer = self._says_multiplayer()

    def find(self, problem: str = "") -> Way:
        """Get to the world with its debug screen on, nothing over it, and the game's window in front.

        ``problem`` is what is said where that fails: why the debug screen could not be read.
        """
        until = self._clock.now() + PATIENCE_S
        seen: list[ScreenName] = []
        unknown_since: float | None = None
        tried_debug = False
        while True:
            self._wait_for_front()
            name, reason = self._name()
            self._check_server(name)
            if name == "world":
                return Way(tuple(seen))
            if self._clock.now() >= until:
                raise LiveError(
                    f"the way back into the world was not found in {PATIENCE_S:g} s, the screen is {name} "
                    f"({reason or problem}): open the world, with the debug screen on, and start again"
                )
            if not seen or seen[-1] != name:
                seen.append(name)
            if name != "unknown":
                unknown_since, tried_debug = None, False
                self._leave(name)
            elif unknown_since is None:
                unknown_since = self._clock.now()
            elif self._clock.now() - unknown_since >= UNKNOWN_S:
                # The debug screen may be off; if not, Esc closes what is there, or opens a menu that is known.
                self._press(self._profile.keys.debug if not tried_debug else "esc")
                tried_debug, unknown_since = not tried_debug, None
            self._pass(AFTER_S)

    def leave_world(self) -> None:
        """Save the world, and get to the title screen."""
        if self._is_multiplayer:
            raise LiveError("a server's world is not left, since nothing leads back: take a profile without [world]")
        until = self._clock.now() + PATIENCE_S
        while (name := self._name()[0]) != "title":
            if self._clock.now() >= until:
                raise LiveError(f"the title screen was not reached, the screen is {name}: leave the world, start again")
            self._wait_for_front()
            if name == "pause":
                self._click((QUIT,), LEAVE)
            elif name in ("world", "chat"):
                self._press("esc")
            elif name != "unknown":
                self._leave(name)
            self._pass(AFTER_S)

    def name(self) -> ScreenName:
        """Which screen is there."""
        return self._name()[0]

    def _says_multiplayer(self) -> bool:
        return "Multiplayer" in self._display.title()

    def _check_server(self, name: ScreenName) -> None:
        """LiveError where this screen leads, or has led, from a server to another world, or the other way round."""
        if self._is_multiplayer and name in NOT_ON_A_SERVER:
            raise LiveError(f"the server was left, the screen is {name}: join the server again, then start again")
        if name == "world" and self._says_multiplayer() != self._is_multiplayer:
            was, now = ("a server's", "your own") if self._is_multiplayer else ("your own", "a server's")
            raise LiveError(f"the world was {was}, and is {now} now: go back to the one before, then start again")

    def _name(self) -> tuple[ScreenName, str]:
        reading = self._screen.read()
        if reading.problem is None:
            return ("chat" if self._screen.is_chat_open() else "world"), ""
        menu = self._screen.menu()
        for name, labels in LABELS.items():
            if any(menu.button(label).middle for label in labels):
                return name, reading.problem
        if menu.shows(WORLDS_TITLE):
            return "worlds", reading.problem
        if self._screen.is_chat_open():
            return "chat", reading.problem
        return self._name_by_points(), reading.problem

    def _name_by_points(self) -> ScreenName:
        known = {name: self._points[point] for name, point in POINTS.items() if point in self._points}
        if not known:
            return "unknown"
        frame = self._display.grab()
        return next((name for name, point in known.items() if looks_the_same(point, frame)), "unknown")

    def _leave(self, name: ScreenName) -> None:
        if name == "chat":
            self._press("esc")
        elif name == "worlds":
            self._enter_world()
        else:
            self._click(LABELS[name], POINTS.get(name))

    def _click(self, labels: tuple[str, ...], point: str | None) -> bool:
        """Click on the button with one of these labels, else on the point; whether anything was clicked."""
        if self._click_label(self._screen.menu(), labels):
            return True
        return point is not None and point in self._points and click_on(self._points[point], self._hands, self._display)

    def _click_label(self, menu: Labels, labels: tuple[str, ...]) -> bool:
        for label in labels:
            button = menu.button(label)
            if button.middle is not None and button.is_enabled:
                self._hands.saw("menu")
                self._hands.click_at(*button.middle)
                return True
        return False

    def _enter_world(self) -> None:
        """Choose the world by its name, or the first of the list, which is the one that was left last, and play it."""
        world = self._profile.world
        if self._is_chosen and self._click((PLAY,), PLAY_IT):
            self._is_chosen = False
            return
        self._is_chosen = True
        if world is not None:
            if place := self._screen.place_of(world.name):
                self._hands.saw("menu")
                self._hands.click_at(*place)
            return
        if WORLD in self._points and not self._screen.menu().shows(WORLDS_TITLE):
            click_on(self._points[WORLD], self._hands, self._display)
            return
        scale, (width, _) = self._screen.scale(), self._display.size()
        top = 32 if self._profile.game.dialect == "1.12" else 48
        middle = -(-width // scale) // 2
        self._hands.saw("menu")
        self._hands.click_at(round((middle - _ROW_LEFT + 60) * scale), round((top + _ROW_MIDDLE) * scale))

    def _press(self, key: str) -> None:
        self._hands.saw("menu")
        self._hands.tap(key, on="menu")

    def _wait_for_front(self) -> None:
        until = self._clock.now() + FRONT_PATIENCE_S
        while not self._display.is_in_front():
            if self._clock.now() >= until:
                raise NotInFrontError(
                    "the game's window is not in front, so no key is pressed: click on it, then start again"
                )
            self._clock.sleep_until(self._clock.now() + AFTER_S)

    def _pass(self, seconds: float) -> None:
        """Let time pass, in front or not."""
        self._clock.sleep_until(self._clock.now() + seconds)
