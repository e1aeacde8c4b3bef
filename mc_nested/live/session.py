"""Opening a live game from a profile: its window, the connection to it, and the Game that is played there."""

from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.arena.scenario import Scenario
from mc_nested.live.devices import SWITCH_KEYS, Display
from mc_nested.live.live_game import LiveGame, check_fits
from mc_nested.live.menus.click_points import load_click_points
from mc_nested.live.menus.wait_for_player import check_block_is_named, check_hotbar, wait_until_standing_still
from mc_nested.live.opening import Opening
from mc_nested.live.profile.fingerprint import Fingerprint, check_fit, game_in
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.live.vision.font import load_font
from mc_nested.live.vision.layout import Scales


@contextmanager
def open_live_game(scenario: Scenario, opening: Opening) -> Iterator[tuple[LiveGame, Display]]:
    """Yield the scenario in the profile's window, and the window. Every key is up again when the block is left.

    Asks the player to switch to the game, and waits until it is in front and its debug screen can be read.

    Args:
        scenario: what is built.
        opening: the profile, and all else that opens its window.

    Raises:
        ProfileError, FontError, DesktopError: it can't be played, or the profile was calibrated on another version,
            window or GUI scale. One line each.
        LiveError: the game did not come to the front, its debug screen can't be read, or its hotbar can't be seen.
    """
    profile, say = load_profile(opening.profile), opening.say
    check_fits(scenario, profile, opening.profile)
    load_font(profile.screen.font_path())
    with opening.connection(profile, scenario) as window:
        connection = window.connection.for_profile(profile)
        display = connection.devices.display
        # Checked twice: before anybody has to switch windows, and again once the GUI scale can be read.
        check_fit(profile.calibrated, fingerprint_of(display), opening.profile)
        if not display.is_in_front():
            say(
                f"Switch to the game now with {SWITCH_KEYS}, not by a click, and have the debug screen on (F3). "
                "Switching away again stops the agent."
            )
        reading = wait_until_standing_still(connection, say)
        points = load_click_points(profile, profile_path(opening.profile))
        check_hotbar(connection, points)
        check_fit(profile.calibrated, fingerprint_of(display, connection.screen.seen_scales()), opening.profile)
        check_block_is_named(reading, game_in(display.title(), profile.game).version)
        game = LiveGame(scenario, profile, connection, points=points, evidence=opening.evidence)
        with game, window.guarded():
            yield game, display


def fingerprint_of(display: Display, scales: Scales | None = None) -> Fingerprint:
    """Return the window as it is now, to compare with the one that a profile was calibrated on."""
    return Fingerprint(display.title(), display.size(), scales)
