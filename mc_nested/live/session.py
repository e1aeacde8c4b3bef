"""Opening a live game from a profile: the window, the reader and the Game over them."""

from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.arena.scenario import Scenario
from mc_nested.live.debug_screen import Overlay, read_debug_screen
from mc_nested.live.desktop import open_desktop
from mc_nested.live.devices import Display
from mc_nested.live.font import load_font
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile import Profile, load_profile
from mc_nested.live.reading import Reading


@contextmanager
def open_live_game(scenario: Scenario, profile_name: str) -> Iterator[tuple[LiveGame, Display]]:
    """The scenario in the profile's window, and the window; every key is up again when the block is left.

    ProfileError, FontError or DesktopError, one line each, where it can't be played.
    """
    profile = load_profile(profile_name)
    profile.marked_arena()
    font = load_font(profile.screen.font_path())
    overlay = overlay_of(profile)
    with open_desktop(profile.window.title) as desktop:

        def read() -> Reading:
            return read_debug_screen(desktop.display.grab(), font, overlay)

        game = LiveGame(
            scenario,
            profile,
            display=desktop.display,
            keyboard=desktop.keyboard,
            pointer=desktop.pointer,
            clock=desktop.clock,
            read=read,
        )
        with game:
            yield game, desktop.display


def overlay_of(profile: Profile) -> Overlay | None:
    """How the profile says that the debug screen is drawn; None where it leaves anything to be found on the screen."""
    screen = profile.screen
    if screen.gui_scale is None or screen.line_pitch is None or screen.text_colour is None:
        return None
    return Overlay(scale=screen.gui_scale, pitch=screen.line_pitch, colour=screen.text_colour)
