"""Walks through the game's menus, finds their buttons by the labels, and returns to the same world.

Every key and click is meant for a screen that was just seen. What is not seen is noted, and never guessed.
"""

from collections.abc import Callable

import numpy as np

from calibration.clicks.points import RecordedPoint
from mc_nested.errors import LiveError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import SWITCH_KEYS, Deadline, Frame, Region
from mc_nested.live.menus.click_points import record_point
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.menus.screens import BACK, ENTER, LABELS, LEAVE, PLAY, PLAY_IT, QUIT, WORLD
from mc_nested.live.menus.wait_for_player import wait_for_front, wait_until_standing_still
from mc_nested.live.model.timing import MENU_LOOK_S
from mc_nested.live.model.versions import may_be_shared, state_in, version_numbers
from mc_nested.live.profile.fingerprint import game_in
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.chat_region import without_chat
from mc_nested.live.vision.game_screen import WORLDS_TITLE
from mc_nested.live.vision.glyph_grid import GLYPH_ROWS, dots_in
from mc_nested.live.vision.layout import INK_SPREAD
from mc_nested.live.vision.menu_labels import MenuButton

MENU_S = 5.0
"""How long a menu may take to open after a key or a click, and how long a button is looked for."""

SAVING_S = 60.0
"""How long saving the world may take."""

HOVER_S = 0.2
"""From moving the mouse until the picture shows the button highlighted."""

OWN = "Open to LAN"
"""To 26.2 the Game Menu has this button only in a world that nobody else can be in. From 26.3 on no button tells that,
but the window's title does (FACTS: Screens and their buttons)."""

_BUTTON = (100, 10)
"""GUI pixels from the middle of the largest button to its sides: a button is opaque."""

_ROW = (-100, 135, 36)
"""GUI pixels of the first row in the list of worlds: from the window's middle to the start of the world's name, and to
the row's end; and the row's height."""


class MenuWalk:
    """A walk through the menus, and the points found on it.

    It starts once the game is in front, in its world, with a readable debug screen.

    Raises (all methods): NotInFrontError, LiveError and errors of the input controller, one line each.
    """

    def __init__(self, connection: GameConnection, profile: Profile, say: Callable[[str], None]) -> None:
        self._connection = connection
        self._display, self._clock = connection.devices.display, connection.devices.clock
        self._controller, self._screen = connection.controller, connection.screen
        self._recovery = Recovery(profile, connection)
        self._game = game_in(self._display.title(), profile.game)
        self.points: dict[str, RecordedPoint] = {}
        self.notes: list[str] = []
        """What the person is told afterwards, a line each."""
        self.is_single_player = False
        say(f"Switch to the game with {SWITCH_KEYS}. Its menus are gone through now: leave mouse and keys alone.")
        wait_for_front(connection.devices)
        self._recovery.recover()
        self._before = wait_until_standing_still(connection)
        self._size = self._display.size()
        self.scale = self._screen.gui_scale()

    def visit_pause_menu(self) -> None:
        """Find the Game Menu's buttons, and whether this is surely a single player's world. Then return there."""
        if self._open_pause():
            self._find(BACK, LABELS["pause"], is_over_world=True)
            self._find(LEAVE, (QUIT,), is_over_world=True)
            menu, title = self._screen.menu(), self._display.title()
            is_told_by_title = version_numbers(self._game.version) >= (26, 3) and state_in(title) is not None
            self.is_single_player = (
                not may_be_shared(title)
                and menu.button(QUIT).is_enabled
                and (is_told_by_title or menu.button(OWN).is_enabled)
            )
        else:
            self.notes.append("the Game Menu: no English label is seen after Esc, so nothing of it was recorded")
        self._return()

    def visit_title(self) -> None:
        """Leave the world, find the buttons of the title and of the list of worlds, and enter the world again."""
        if not self._open_pause():
            raise LiveError("the Game Menu didn't open: leave mouse and keys alone, and run this again")
        self._go(QUIT, lambda: self._recovery.screen_name() == "title", SAVING_S)
        self._find(ENTER, LABELS["title"])
        self._go(LABELS["title"][0], lambda: self._screen.menu().shows(WORLDS_TITLE), MENU_S)
        self._find_world()
        self._return()

    def _open_pause(self) -> bool:
        """Press Esc in the world, and return whether the Game Menu is seen."""
        deadline = Deadline(self._clock, MENU_S)
        while (name := self._recovery.screen_name()) != "pause":
            if deadline.has_passed:
                return False
            if name in ("world", "chat"):
                self._controller.confirm_screen("menu")
                self._controller.tap("esc", on="menu")
                self._wait_until(lambda: self._recovery.screen_name() == "pause", MENU_S / 4)
            else:
                self._controller.wait(MENU_LOOK_S)
        return True

    def _go(self, label: str, is_there: Callable[[], bool], patience_s: float) -> None:
        """Click on a button until the screen that it leads to is there: a click may get lost."""
        deadline = Deadline(self._clock, patience_s)
        while not deadline.has_passed:
            button = self._screen.menu().button(label)
            if button.middle is not None and button.is_enabled:
                self._controller.confirm_screen("menu")
                self._controller.click_at(*button.middle)
            if self._wait_until(is_there, MENU_S / 2):
                return
        raise LiveError(f"{label!r} led nowhere within {patience_s:g} s: enter your world by hand, and run this again")

    def _find(self, name: str, labels: tuple[str, ...], *, is_over_world: bool = False) -> None:
        """Record the button that has one of these labels, with the mouse over it."""
        seen: list[MenuButton] = []

        def look() -> bool:
            menu = self._screen.menu()
            seen[:] = [menu.button(label) for label in labels]
            return any(button.middle for button in seen)

        while self._wait_until(look, MENU_S):
            label, button = next(
                (label, each) for label, each in zip(labels, seen, strict=True) if each.middle is not None
            )
            if button.middle is None:
                break
            self._hover(button.middle)
            frame = self._picture()
            again = self._screen.menu().button(label)
            if (again.middle, again.scale) == (button.middle, button.scale):
                clean = without_chat(frame, button.scale, [_button_region(button)]) if is_over_world else frame
                self._record(name, button.middle, clean)
                return
        self.notes.append(f"{name}: {next((each.problem for each in seen if each.problem), 'not seen')}")

    def _find_world(self) -> None:
        """Record the topmost world of the list, which is the one that was just left, and the button that plays it."""
        pixel = self._topmost_world(self._picture())
        if pixel is None:
            self.notes.append(f"{WORLD}: no name of a world is seen in the list")
            return
        self._hover(pixel)
        frame = self._picture()
        self._controller.confirm_screen("menu")
        self._controller.click_at(*pixel)
        if not self._wait_until(lambda: self._screen.menu().button(PLAY).is_enabled, MENU_S):
            self.notes.append(f"{WORLD}: a click on the topmost name of the list didn't choose it")
            return
        self._record(WORLD, pixel, frame)
        self._find(PLAY_IT, (PLAY,))

    def _topmost_world(self, frame: Frame) -> tuple[int, int] | None:
        """Return a pixel on the first world's name: the topmost white text in the list's first row."""
        scale, top = self.scale, 32 if self._game.dialect == "1.12" else 48
        middle = -(-self._size[0] // scale) // 2
        left, right, height = middle + _ROW[0], middle + _ROW[1], _ROW[2]
        dots = dots_in(frame, scale)[top : top + height, left:right]
        ink = np.asarray((dots >= 255 - INK_SPREAD).all(2))
        if not ink.any():
            return None
        first = int(np.argwhere(ink)[0, 0])
        columns = np.argwhere(ink[first : first + GLYPH_ROWS])[:, 1]
        return (left + int(columns.min() + columns.max()) // 2) * scale, (top + first + GLYPH_ROWS // 2) * scale

    def _hover(self, pixel: tuple[int, int]) -> None:
        self._controller.confirm_screen("menu")
        self._controller.hover(*pixel)
        self._controller.wait(HOVER_S)

    def _record(self, name: str, pixel: tuple[int, int], frame: Frame) -> None:
        self.points[name] = RecordedPoint(name, record_point(name, frame, pixel, self.scale).at, frame)

    def _picture(self) -> Frame:
        """Return a picture of the window; LiveError if its size has changed."""
        frame = self._display.grab()
        self._check_size((int(frame.shape[1]), int(frame.shape[0])))
        return frame

    def _return(self) -> None:
        """Return to the world, and check that the player stands where the walk began."""
        self._recovery.recover()
        self._check_size(self._display.size())
        after = wait_until_standing_still(self._connection)
        if (after.xyz, after.yaw, after.pitch) != (self._before.xyz, self._before.yaw, self._before.pitch):
            raise LiveError(
                "after the menus the player stands elsewhere, perhaps in another world: enter yours, and run this again"
            )

    def _check_size(self, size: tuple[int, int]) -> None:
        if size != self._size:
            raise LiveError("the game's window changed its size: leave it as it is, and run this again")

    def _wait_until(self, is_so: Callable[[], bool], patience_s: float) -> bool:
        deadline = Deadline(self._clock, patience_s)
        while not is_so():
            if deadline.has_passed:
                return False
            self._controller.wait(MENU_LOOK_S)
        return True


def _button_region(button: MenuButton) -> Region:
    """Return the part of the picture that the button covers."""
    x, y = button.middle or (0, 0)
    wide, high = _BUTTON[0] * button.scale, _BUTTON[1] * button.scale
    return Region(x - wide, y - high, 2 * wide, 2 * high)
