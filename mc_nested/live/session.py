"""Opening a live game from a profile: the window, the reader and the Game over them."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

from mc_nested.arena.scenario import Scenario
from mc_nested.live.at_rest import read_at_rest
from mc_nested.live.debug_screen import Overlay
from mc_nested.live.desktop import Desktop, open_desktop
from mc_nested.live.devices import Display
from mc_nested.live.fingerprint import Seen, check_fit
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.live_game import LiveGame
from mc_nested.live.point_pictures import load_click_points
from mc_nested.live.profile import Profile, load_profile, profile_path
from mc_nested.live.watchdog import watched

PITCH, TEXT_COLOUR = 9, (224, 224, 224)
"""Dots from a line to the next, and the text's red, green and blue, in the game (FACTS: The F3 debug screen)."""


@contextmanager
def open_live_game(
    scenario: Scenario,
    profile_name: str,
    say: Callable[[str], None],
    *,
    evidence: Path | None = None,
    is_server_allowed: bool = False,
    open_devices: Callable[[str], AbstractContextManager[Desktop]] = open_desktop,
) -> Iterator[tuple[LiveGame, Display]]:
    """The scenario in the profile's window, and the window; every key is up again when the block is left.

    ``evidence`` and ``is_server_allowed`` are as LiveGame takes them; ``open_devices`` opens the window of a title.

    Waits until the game is in front and its debug screen can be read, and tells the player so with ``say``.

    ProfileError, FontError or DesktopError, one line each, where it can't be played, or the profile was calibrated on
    another version, window or GUI scale; LiveError where the game did not come to the front.
    """
    profile = load_profile(profile_name)
    profile.marked_arena()
    font = load_font(profile.screen.font_path())
    overlay = overlay_of(profile)
    with open_devices(profile.window.title) as desktop:
        screen = WindowScreen(desktop.display, font, overlay)
        # Twice: what can be known before anybody has to switch windows, and the window as it is then.
        check_fit(profile.calibrated, seen_of(desktop.display), profile_name)
        if not desktop.display.is_in_front():
            say("Switch to the game now, with the debug screen on (F3). Switching away again stops the agent.")
        read_at_rest(desktop.display, desktop.clock, screen.read)
        check_fit(profile.calibrated, seen_of(desktop.display, screen.scale()), profile_name)
        game = LiveGame(
            scenario,
            profile,
            display=desktop.display,
            keyboard=desktop.keyboard,
            pointer=desktop.pointer,
            clock=desktop.clock,
            screen=screen,
            points=load_click_points(profile, profile_path(profile_name)),
            evidence=evidence,
            is_server_allowed=is_server_allowed,
        )
        # Imported here, since it needs the display that is open only now.
        from mc_nested.live.desktop.panic import open_panic_switch

        with game, watched(game.hands), open_panic_switch(profile.keys.panic, game.hands.stop):
            yield game, desktop.display


def seen_of(display: Display, gui_scale: int | None = None) -> Seen:
    """What is seen of the game now, to compare with what a profile was calibrated on."""
    return Seen(display.title(), display.size(), gui_scale)


def overlay_of(profile: Profile) -> Overlay | None:
    """How the profile says that the debug screen is drawn, the game's own way where it says only the GUI scale.

    None where it leaves the GUI scale to be found on the screen, and with it all the rest.
    """
    screen = profile.screen
    if screen.gui_scale is None:
        return None
    return Overlay(scale=screen.gui_scale, pitch=screen.line_pitch or PITCH, colour=screen.text_colour or TEXT_COLOUR)
