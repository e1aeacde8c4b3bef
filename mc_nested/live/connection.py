"""GameConnection: one running game: its window's devices, the one owner of held keys, and the screen reader."""

import dataclasses
from collections.abc import Callable

from mc_nested.errors import ProfileError
from mc_nested.live.devices import Devices
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.journal import Journal, Journals
from mc_nested.live.profile.fingerprint import check_single_player, game_in
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.chat_region import ChatLines
from mc_nested.live.vision.font import load_font
from mc_nested.live.vision.game_screen import GameScreen, WindowScreen
from mc_nested.live.vision.layout import LAYOUTS, VANILLA, Overlay


class GameConnection:
    """A running game, for all code that plays, types or reads. As a context manager it releases every key at the end.

    Args:
        devices: the game window's display, keyboard, pointer, clock and clipboard.
        controller: presses keys and buttons, and releases them.
        screen: reads the window; None while the game's font is not known.
        is_server_allowed: whether to play in a game that others may share.
        journal: is told what is waited for, read, planned and done.
        on_screen: what every screen that reads the window is wrapped in, as by a recording.
        chat_lines: what was sent through the game's chat so far.
    """

    def __init__(
        self,
        devices: Devices,
        controller: InputController,
        screen: GameScreen | None = None,
        *,
        is_server_allowed: bool = False,
        journal: Journal | None = None,
        on_screen: Callable[[GameScreen], GameScreen] = lambda screen: screen,
        chat_lines: ChatLines | None = None,
    ) -> None:
        self.devices = devices
        self.controller = controller
        self.is_server_allowed = is_server_allowed
        self.journal = journal or Journals()
        self.chat_lines = chat_lines or ChatLines()
        self._screen = on_screen(screen) if screen else None
        if self._screen is not None:
            controller.guard_world(self._screen.shows_world)
        self._on_screen = on_screen

    def __enter__(self) -> "GameConnection":
        self.controller.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        self.controller.__exit__()

    @property
    def screen(self) -> GameScreen:
        """The reader of the window; raises ProfileError while the game's font is not known."""
        if self._screen is None:
            raise ProfileError("the game's font is not known yet: run mc-nested calibrate font first")
        return self._screen

    def for_profile(self, profile: Profile) -> "GameConnection":
        """Return the same game, read with that profile's font and layout.

        Raises ProfileError or FontError where the profile names no font that can be used.
        """
        return self.with_screen(screen_for(profile, self.devices))

    def with_screen(self, screen: GameScreen) -> "GameConnection":
        """Return the same game, read by that screen."""
        return GameConnection(
            self.devices,
            self.controller,
            screen,
            is_server_allowed=self.is_server_allowed,
            journal=self.journal,
            on_screen=self._on_screen,
            chat_lines=self.chat_lines,
        )

    def check_single_player(self) -> None:
        """Raise DesktopError if the window's title says that others may play there, unless that is allowed."""
        check_single_player(self.devices.display.title(), is_server_allowed=self.is_server_allowed)


def prepare_keyboard(profile: Profile, devices: Devices) -> None:
    """Have keys pressed as the game in that window takes them.

    Raise DesktopError if this keyboard lacks a profile's key.

    Nothing is pressed. The version is the one in the window's title, or else the profile's.
    """
    if game_in(devices.display.title(), profile.game).takes_symbols:
        devices.keyboard.go_by_symbols(profile.keys.pressed())


def screen_for(profile: Profile, devices: Devices) -> WindowScreen:
    """Return the screen that reads the window as the profile says.

    Raise ProfileError or FontError without a usable font.
    """
    font, overlay, display = load_font(profile.screen.font_path()), overlay_of(profile), devices.display
    version = game_in(display.title(), profile.game).version
    return WindowScreen(display, font, overlay, version)


def overlay_of(profile: Profile) -> Overlay | None:
    """Return the overlay of a profile that names its scale: what else it leaves out is its layout's.

    None where the scale, and with it all the rest, is found on the screen.
    """
    screen = profile.screen
    if screen.debug_scale is None:
        return None
    layout = LAYOUTS[screen.layout] if screen.layout else VANILLA
    if screen.line_pitch is not None:
        layout = dataclasses.replace(layout, pitch=screen.line_pitch)
    return Overlay(screen.debug_scale, layout, screen.text_colour or layout.text_colour)
