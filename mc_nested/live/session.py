"""Opening a live game from a profile: the window, the reader and the Game over them."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager

from mc_nested.arena.scenario import Scenario
from mc_nested.live.at_rest import read_at_rest
from mc_nested.live.debug_screen import Overlay, read_debug_screen
from mc_nested.live.desktop import open_desktop
from mc_nested.live.devices import Display
from mc_nested.live.font import load_font
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile import Profile, load_profile
from mc_nested.live.reading import Reading

PITCH, TEXT_COLOUR = 9, (224, 224, 224)
"""Dots from a line to the next, and the text's red, green and blue, in the game (FACTS: The F3 debug screen)."""


@contextmanager
def open_live_game(
    scenario: Scenario, profile_name: str, say: Callable[[str], None]
) -> Iterator[tuple[LiveGame, Display]]:
    """The scenario in the profile's window, and the window; every key is up again when the block is left.

    Waits until the game is in front and its debug screen can be read, and tells the player so with ``say``.

    ProfileError, FontError or DesktopError, one line each, where it can't be played; LiveError where the game did not
    come to the front.
    """
    profile = load_profile(profile_name)
    profile.marked_arena()
    font = load_font(profile.screen.font_path())
    overlay = overlay_of(profile)
    with open_desktop(profile.window.title) as desktop:

        def read() -> Reading:
            return read_debug_screen(desktop.display.grab(), font, overlay)

        if not desktop.display.is_in_front():
            say("Switch to the game now, with the debug screen on (F3). Switching away again stops the agent.")
        read_at_rest(desktop.display, desktop.clock, read)
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
    """How the profile says that the debug screen is drawn, the game's own way where it says only the GUI scale.

    None where it leaves the GUI scale to be found on the screen, and with it all the rest.
    """
    screen = profile.screen
    if screen.gui_scale is None:
        return None
    return Overlay(scale=screen.gui_scale, pitch=screen.line_pitch or PITCH, colour=screen.text_colour or TEXT_COLOUR)
