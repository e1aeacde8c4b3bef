"""A walk through the game's menus that finds buttons by their labels, and ends where it began: in the same world.

Every press is meant for a screen that was just seen; what is not seen is noted, and never guessed.
"""

from collections.abc import Callable

import numpy as np

from calibration.clicks.shown import Point
from calibration.report.chat_region import without_chat
from calibration.step import Bench
from mc_nested.errors import LiveError
from mc_nested.live.at_rest import read_at_rest, wait_for_front
from mc_nested.live.click_points import recorded
from mc_nested.live.devices import Frame, Region
from mc_nested.live.dots import GLYPH_ROWS
from mc_nested.live.fingerprint import game_in
from mc_nested.live.font import Font
from mc_nested.live.game_screen import WORLDS_TITLE, WindowScreen
from mc_nested.live.menu_labels import Button
from mc_nested.live.profile import Profile
from mc_nested.live.session import overlay_of
from mc_nested.live.text_lines import INK_SPREAD
from mc_nested.live.way_back import BACK, ENTER, LABELS, LEAVE, PLAY, PLAY_IT, QUIT, WORLD, WayBack

SOON_S = 5.0
"""How long a menu may take to be there after a key or a click, and how long a button is looked for."""

SAVING_S = 60.0
"""How long saving the world may take."""

LOOK_S = 0.1

HOVERED_S = 0.2
"""From moving the mouse until the picture shows the button under it."""

LAN = "Open to LAN"
"""A button that the Game Menu has only in a world that nobody else can be in (FACTS: Screens and their buttons)."""

_BUTTON = (100, 10)
"""GUI pixels from the middle of the largest button to its sides: nothing shines through there."""

_ROW = (-100, 135, 36)
"""GUI pixels, of the first row in the list of worlds: from the window's middle to where the world's name begins and
where the row ends; and how high it is."""


class MenuWalk:
    """A walk, and the points found on it. Begins once the game is in front, in its world, its debug screen readable.

    Raises (everything): NotInFrontError, LiveError and what the hands raise, one line each.
    """

    def __init__(self, bench: Bench, profile: Profile, font: Font) -> None:
        self._display, self._hands, self._clock = bench.desktop.display, bench.hands, bench.desktop.clock
        self._screen = WindowScreen(self._display, font, overlay_of(profile))
        self._way = WayBack(profile, self._hands, self._screen, self._display, self._clock)
        self._game = game_in(self._display.title(), profile.game)
        self.points: dict[str, Point] = {}
        self.notes: list[str] = []
        self.is_single_player = False
        bench.say("Switch to the game. Its menus are gone through now: leave mouse and keys alone.")
        wait_for_front(self._display, self._clock)
        self._way.find()
        self._before = read_at_rest(self._display, self._clock, self._screen.read)
        self._size = self._display.size()
        self.scale = self._screen.scale()

    def note(self, text: str) -> None:
        """Keep a line for the person."""
        self.notes.append(text)

    def through_pause(self) -> None:
        """Find the Game Menu's buttons, and whether the world is surely a single player's; in the world again then."""
        if self._open_pause():
            self._find(BACK, LABELS["pause"], is_over_world=True)
            self._find(LEAVE, (QUIT,), is_over_world=True)
            menu, title = self._screen.menu(), self._display.title()
            self.is_single_player = "Multiplayer" not in title and all(
                menu.button(each).is_enabled for each in (QUIT, LAN)
            )
        else:
            self.note("the Game Menu: no English label is seen after Esc, so nothing of it was recorded")
        self._return()

    def through_title(self) -> None:
        """Leave the world, find the buttons of the title and of the list of worlds, and enter the world again."""
        if not self._open_pause():
            raise LiveError("the Game Menu didn't open: leave mouse and keys alone, and run this again")
        self._go(QUIT, lambda: self._way.name() == "title", SAVING_S)
        self._find(ENTER, LABELS["title"])
        self._go(LABELS["title"][0], lambda: self._screen.menu().shows(WORLDS_TITLE), SOON_S)
        self._find_world()
        self._return()

    def _open_pause(self) -> bool:
        """Press Esc in the world; whether the Game Menu is seen then."""
        until = self._clock.now() + SOON_S
        while (name := self._way.name()) != "pause":
            if self._clock.now() >= until:
                return False
            if name in ("world", "chat"):
                self._hands.saw("menu")
                self._hands.tap("esc", on="menu")
                self._wait_until(lambda: self._way.name() == "pause", SOON_S / 4)
            else:
                self._hands.wait(LOOK_S)
        return True

    def _go(self, label: str, is_there: Callable[[], bool], patience_s: float) -> None:
        """Click on a button until the screen that it leads to is there; a click may get lost."""
        until = self._clock.now() + patience_s
        while self._clock.now() < until:
            button = self._screen.menu().button(label)
            if button.middle is not None and button.is_enabled:
                self._hands.saw("menu")
                self._hands.click_at(*button.middle)
            if self._wait_until(is_there, SOON_S / 2):
                return
        raise LiveError(f"{label!r} led nowhere within {patience_s:g} s: enter your world by hand, and run this again")

    def _find(self, name: str, labels: tuple[str, ...], *, is_over_world: bool = False) -> None:
        """Record the button that has one of these labels, with the mouse over it."""
        seen: list[Button] = []

        def look() -> bool:
            menu = self._screen.menu()
            seen[:] = [menu.button(label) for label in labels]
            return any(button.middle for button in seen)

        while self._wait_until(look, SOON_S):
            label, button = next(
                (label, each) for label, each in zip(labels, seen, strict=True) if each.middle is not None
            )
            if button.middle is None:
                break
            self._hover(button.middle)
            frame = self._whole_picture()
            again = self._screen.menu().button(label)
            if (again.middle, again.scale) == (button.middle, button.scale):
                kept = without_chat(frame, button.scale, [_around(button)]) if is_over_world else frame
                self._keep(name, button.middle, kept)
                return
        self.note(f"{name}: {next((each.problem for each in seen if each.problem), 'not seen')}")

    def _find_world(self) -> None:
        """Record the topmost world of the list, which is the one that was left last, and the button that plays it."""
        place = self._topmost_world(self._whole_picture())
        if place is None:
            self.note(f"{WORLD}: no name of a world is seen in the list")
            return
        self._hover(place)
        frame = self._whole_picture()
        self._hands.saw("menu")
        self._hands.click_at(*place)
        if not self._wait_until(lambda: self._screen.menu().button(PLAY).is_enabled, SOON_S):
            self.note(f"{WORLD}: a click on the topmost name of the list didn't choose it")
            return
        self._keep(WORLD, place, frame)
        self._find(PLAY_IT, (PLAY,))

    def _topmost_world(self, frame: Frame) -> tuple[int, int] | None:
        """A place on the first world's name, in pixels: the topmost white text where the list's first row is."""
        scale, top = self.scale, 32 if self._game.dialect == "1.12" else 48
        middle = -(-self._size[0] // scale) // 2
        left, right, height = middle + _ROW[0], middle + _ROW[1], _ROW[2]
        dots = frame[scale // 2 :: scale, scale // 2 :: scale][top : top + height, left:right]
        ink = np.asarray((dots >= 255 - INK_SPREAD).all(2))
        if not ink.any():
            return None
        first = int(np.argwhere(ink)[0, 0])
        columns = np.argwhere(ink[first : first + GLYPH_ROWS])[:, 1]
        return (left + int(columns.min() + columns.max()) // 2) * scale, (top + first + GLYPH_ROWS // 2) * scale

    def _hover(self, place: tuple[int, int]) -> None:
        self._hands.saw("menu")
        self._hands.hover(*place)
        self._hands.wait(HOVERED_S)

    def _keep(self, name: str, place: tuple[int, int], frame: Frame) -> None:
        self.points[name] = Point(name, recorded(name, frame, place, self.scale).at, frame)

    def _whole_picture(self) -> Frame:
        """The window as it is, of the size that it had at first."""
        frame = self._display.grab()
        self._check_size((int(frame.shape[1]), int(frame.shape[0])))
        return frame

    def _return(self) -> None:
        """Be in the world again, and stand where the walk began."""
        self._way.find()
        self._check_size(self._display.size())
        after = read_at_rest(self._display, self._clock, self._screen.read)
        if (after.xyz, after.yaw, after.pitch) != (self._before.xyz, self._before.yaw, self._before.pitch):
            raise LiveError(
                "after the menus the player stands elsewhere, perhaps in another world: enter yours, and run this again"
            )

    def _check_size(self, size: tuple[int, int]) -> None:
        if size != self._size:
            raise LiveError("the game's window changed its size: leave it as it is, and run this again")

    def _wait_until(self, is_so: Callable[[], bool], patience_s: float) -> bool:
        until = self._clock.now() + patience_s
        while not is_so():
            if self._clock.now() >= until:
                return False
            self._hands.wait(LOOK_S)
        return True


def _around(button: Button) -> Region:
    """The part of a picture that the button hides, whatever is behind it."""
    x, y = button.middle or (0, 0)
    wide, high = _BUTTON[0] * button.scale, _BUTTON[1] * button.scale
    return Region(x - wide, y - high, 2 * wide, 2 * high)
