"""A snapshot of the game's window: its title and size, the screen that it shows, and the debug screen's reading."""

from collections.abc import Callable
from dataclasses import dataclass, field

from mc_nested.live.connection import overlay_of
from mc_nested.live.devices import SWITCH_KEYS, Deadline, Devices, Display, Frame
from mc_nested.live.menus.screens import ScreenName, menu_name
from mc_nested.live.model.reading import Reading
from mc_nested.live.model.timing import PERSON_LOOK_S
from mc_nested.live.profile.fingerprint import Fingerprint, game_in
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.debug_screen import nothing_seen, read_found
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.game_screen import WindowScreen
from mc_nested.live.vision.layout import Scales
from mc_nested.live.vision.menu_labels import MenuLabels
from mc_nested.live.vision.overlay import SCALES, find_debug_screen

FRONT_S = 30.0
"""Time for a person to switch to the game: less than elsewhere, since the doctor also runs unattended."""

UNCALIBRATED = Profile()
"""What is known of a game without a profile."""

READABLE_S = 5.0
"""Time to then close the menu that the game opened meanwhile."""


@dataclass(frozen=True)
class ScreenContents:
    """A frame's contents: the screen; the beginning of the line that the debug screen was recognized by, if it is on.

    ``scales`` are those of any text of the game's that was found.
    """

    screen: ScreenName
    line: str | None
    scales: Scales | None
    reading: Reading


@dataclass(frozen=True)
class WindowSnapshot:
    """A snapshot; ``picture_size`` is in pixels, ``points`` the window's size in points of the desktop, if known.

    ``contents`` is None if another window is in front, since the picture may be of that, or if there is no font.
    ``picture`` is the frame itself.
    """

    window: Fingerprint
    picture_size: tuple[int, int]
    points: tuple[int, int] | None
    is_in_front: bool
    contents: ScreenContents | None
    picture: Frame | None = field(default=None, compare=False, repr=False)

    @property
    def is_world(self) -> bool:
        """Whether the world is visible with nothing over it, and the debug screen is read."""
        return self.contents is not None and self.contents.screen == "world"


def take_snapshot(devices: Devices, font: Font | None, profile: Profile = UNCALIBRATED) -> WindowSnapshot:
    """Take a snapshot, as the profile says that the game is drawn. DesktopError without a window."""
    display = devices.display
    is_in_front, frame = display.is_in_front(), display.grab()
    contents = None
    if is_in_front and font is not None:
        contents = _contents_of(frame, font, profile, display)
    window = Fingerprint(display.title(), display.size(), contents.scales if contents else None)
    area = devices.area() if devices.area else None
    points = (area.width, area.height) if area else None
    return WindowSnapshot(window, (frame.shape[1], frame.shape[0]), points, is_in_front, contents, frame)


def _contents_of(frame: Frame, font: Font, profile: Profile, display: Display) -> ScreenContents:
    """Return what a frame of the game shows. A debug screen whose layout differs from the profile's is found, too."""
    overlay = overlay_of(profile)
    found = find_debug_screen(frame, font, overlay) or (find_debug_screen(frame, font) if overlay else None)
    # A modpack's title says no version: the profile's does then, or a menu under the debug text would be the world.
    version = game_in(display.title(), profile.game).version
    screen = WindowScreen(display, font, found.overlay if found else None, version)
    reading = read_found(found, font) if found else nothing_seen(overlay)
    scales = screen.seen_scales()
    line, scale = (found.label, found.overlay.scale) if found else (None, None)
    if scales is None and scale is not None:
        scales = Scales(scale, scale)
    if reading.problem is None and screen.shows_world():
        return ScreenContents("world", line, scales, reading)
    if reading.problem is None and screen.is_chat_open():
        return ScreenContents("chat", line, scales, reading)
    name, menu_scale = _menu_in(frame, font)
    if menu_scale is not None:
        # The version in the title screen's corner begins like a line of the debug screen.
        debug_scale = scale if scale and reading.problem is None else menu_scale
        return ScreenContents(name, None, Scales(menu_scale, debug_scale), reading)
    if screen.is_chat_open():
        return ScreenContents("chat", line, scales, reading)
    return ScreenContents("menu" if reading.problem is None else "unknown", line, scales, reading)


def wait_until_readable(
    devices: Devices, font: Font | None, profile: Profile, say: Callable[[str], None]
) -> WindowSnapshot:
    """Return the first snapshot with the game in front and the debug screen readable; at the deadline, the last one."""
    clock = devices.clock
    deadline, has_arrived = Deadline(clock, FRONT_S), False
    snapshot = take_snapshot(devices, font, profile)
    if not _is_readable(snapshot):
        say(
            f"Switch to the game now with {SWITCH_KEYS}, not by a click, close its menus, "
            "and turn the debug screen on (F3): "
            f"the doctor looks for {READABLE_S if snapshot.is_in_front else FRONT_S:.0f} s."
        )
    while not _is_readable(snapshot):
        if snapshot.is_in_front and not has_arrived:
            has_arrived, deadline = True, Deadline(clock, READABLE_S)
        if deadline.has_passed:
            break
        clock.sleep_until(clock.now() + PERSON_LOOK_S)
        snapshot = take_snapshot(devices, font, profile)
    return snapshot


def _is_readable(snapshot: WindowSnapshot) -> bool:
    return snapshot.is_in_front and (snapshot.contents is None or snapshot.is_world)


def _menu_in(frame: Frame, font: Font) -> tuple[ScreenName, int | None]:
    """Return the menu in a frame and its GUI scale, or "unknown"."""
    for scale in SCALES:
        if (name := menu_name(MenuLabels(frame, font, scale))) is not None:
            return name, scale
    return "unknown", None
