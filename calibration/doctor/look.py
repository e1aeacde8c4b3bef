"""One look at the game's window: what it is, which screen it shows, and what its debug screen says."""

from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.live.debug_screen import Overlay, nothing_seen, read_screen
from mc_nested.live.desktop import Desktop
from mc_nested.live.devices import Frame
from mc_nested.live.fingerprint import Seen
from mc_nested.live.font import Font
from mc_nested.live.game_screen import WORLDS_TITLE, WindowScreen
from mc_nested.live.menu_labels import Menu
from mc_nested.live.overlay import SCALES, see
from mc_nested.live.reading import Reading
from mc_nested.live.screen_lines import Screen
from mc_nested.live.way_back import LABELS, ScreenName

FRONT_S = 30.0
"""Seconds that a person has to switch to the game: less than elsewhere, since the doctor also runs unattended."""

READABLE_S = 5.0
"""Seconds that they have, once they are there, to close the menu that the game opened meanwhile."""

LOOK_S = 0.25


@dataclass(frozen=True)
class Shown:
    """What a frame shows: which screen, and of the debug screen how the line begins that it was known by, if it is on.

    ``scale`` is the GUI scale that any text of the game was seen at.
    """

    screen: ScreenName
    line: str | None
    scale: int | None
    reading: Reading


@dataclass(frozen=True)
class Look:
    """A look at the window; ``pictured`` is the width and height of its picture, ``points`` of the window itself.

    ``shown`` is None where another window is in front, whose picture it may be, or where there is no font to read with.
    """

    seen: Seen
    pictured: tuple[int, int]
    points: tuple[int, int] | None
    is_in_front: bool
    shown: Shown | None

    @property
    def is_world(self) -> bool:
        """Whether the world is there, nothing over it, and the debug screen is read."""
        return self.shown is not None and self.shown.screen == "world"


def look(desktop: Desktop, font: Font | None, overlay: Overlay | None = None) -> Look:
    """Look once; ``overlay`` is how the profile says that the debug screen is drawn. DesktopError without a window."""
    display = desktop.display
    is_in_front, frame = display.is_in_front(), display.grab()
    shown = None
    if is_in_front and font is not None:
        shown = shown_in(frame, font, overlay, WindowScreen(display, font, overlay).is_chat_open)
    seen = Seen(display.title(), display.size(), shown.scale if shown else None)
    points = desktop.points() if desktop.points else None
    return Look(seen, (frame.shape[1], frame.shape[0]), points, is_in_front, shown)


def shown_in(frame: Frame, font: Font, overlay: Overlay | None, is_chat_open: Callable[[], bool]) -> Shown:
    """What a frame of the game shows. A debug screen that is drawn otherwise than the profile says is found, too."""
    sight = see(frame, font, overlay) or (see(frame, font) if overlay else None)
    reading = read_screen(Screen(sight, font)) if sight else nothing_seen(overlay)
    line, scale = (sight.prefix, sight.overlay.scale) if sight else (None, None)
    if reading.problem is None:
        return Shown("chat" if is_chat_open() else "world", line, scale, reading)
    name, menu_scale = _menu_in(frame, font)
    if name != "unknown":
        # The title screen's version, in its corner, begins as a line of the debug screen does.
        return Shown(name, None, menu_scale, reading)
    return Shown("chat" if is_chat_open() else "unknown", line, scale, reading)


def look_until_read(desktop: Desktop, font: Font | None, overlay: Overlay | None, say: Callable[[str], None]) -> Look:
    """Look until the game is in front and the debug screen is read, or a person has had the time for that."""
    clock = desktop.clock
    until, arrived = clock.now() + FRONT_S, False
    seen = look(desktop, font, overlay)
    if not _is_enough(seen):
        say(
            "Switch to the game now, close its menus, and turn the debug screen on (F3): "
            f"the doctor looks for {READABLE_S if seen.is_in_front else FRONT_S:.0f} s."
        )
    while not _is_enough(seen):
        if seen.is_in_front and not arrived:
            arrived, until = True, clock.now() + READABLE_S
        if clock.now() >= until:
            break
        clock.sleep_until(clock.now() + LOOK_S)
        seen = look(desktop, font, overlay)
    return seen


def _is_enough(seen: Look) -> bool:
    return seen.is_in_front and (seen.shown is None or seen.is_world)


def _menu_in(frame: Frame, font: Font) -> tuple[ScreenName, int | None]:
    """The menu in a frame and its GUI scale; "unknown" where there is none that is known."""
    for scale in SCALES:
        menu = Menu(frame, font, scale)
        for name, labels in LABELS.items():
            if any(menu.button(label).middle for label in labels):
                return name, scale
        if menu.shows(WORLDS_TITLE):
            return "worlds", scale
    return "unknown", None
