"""Opening a live game from a profile: its window, the connection to it, and the Game that is played there."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

from mc_nested.arena.scenario import Scenario
from mc_nested.live.connection import connect, prepare_keyboard
from mc_nested.live.desktop import open_desktop
from mc_nested.live.devices import SWITCH_KEYS, Devices, Display
from mc_nested.live.input.stops import Stop, watched
from mc_nested.live.journal import Journal, Journals
from mc_nested.live.live_game import LiveGame, check_fits
from mc_nested.live.menus.click_points import load_click_points
from mc_nested.live.menus.wait_for_player import check_block_is_named, check_hotbar, wait_until_standing_still
from mc_nested.live.model.versions import later_version_line
from mc_nested.live.profile.fingerprint import Fingerprint, check_fit, game_in
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.live.recording.run_recorder import OpenRecorder, no_recorder
from mc_nested.live.vision.font import load_font
from mc_nested.live.vision.layout import Scales


@contextmanager
def open_live_game(  # noqa: PLR0913 - each of a session's parts can be another, as in tests
    scenario: Scenario,
    profile_name: str,
    say: Callable[[str], None],
    *,
    evidence: Path | None = None,
    is_server_allowed: bool = False,
    journal: Journal | None = None,
    open_recorder: OpenRecorder = no_recorder,
    open_devices: Callable[[str], AbstractContextManager[Devices]] = open_desktop,
    open_panic_switch: Callable[[str, Stop], AbstractContextManager[None]] | None = None,
) -> Iterator[tuple[LiveGame, Display]]:
    """The scenario in the profile's window, and the window. Every key is up again when the block is left.

    Asks the player with ``say`` to switch to the game, and waits until it is in front and its debug screen can be read.

    Args:
        scenario: what is built.
        profile_name: the profile's name or file.
        say: shows one line to the player.
        evidence: the folder for the last frames, as LiveGame takes it.
        is_server_allowed: whether to play in a game that others may share.
        journal: is told what is waited for, read, planned and done.
        open_recorder: opens what records the run.
        open_devices: opens the window whose title matches.
        open_panic_switch: opens the panic switch of the key that a profile names; None for the desktop's.

    Raises:
        ProfileError, FontError, DesktopError: it can't be played, or the profile was calibrated on another version,
            window or GUI scale. One line each.
        LiveError: the game did not come to the front, its debug screen can't be read, or its hotbar can't be seen.
    """
    profile = load_profile(profile_name)
    check_fits(scenario, profile, profile_name)
    load_font(profile.screen.font_path())
    with open_devices(profile.window.title) as window, open_recorder(profile, window) as recording:
        prepare_keyboard(profile, window)
        devices = recording.devices(window)
        version = game_in(devices.display.title(), profile.game).version
        if line := later_version_line(version):
            say(line)
        journals = Journals(*([journal] if journal else []), recording)
        connection = connect(
            profile, devices, is_server_allowed=is_server_allowed, journal=journals, on_screen=recording.screen
        )
        # Checked twice: before anybody has to switch windows, and again once the GUI scale can be read.
        check_fit(profile.calibrated, fingerprint_of(devices.display), profile_name)
        if not devices.display.is_in_front():
            say(
                f"Switch to the game now with {SWITCH_KEYS}, not by a click, and have the debug screen on (F3). "
                "Switching away again stops the agent."
            )
        reading = wait_until_standing_still(connection, say)
        points = load_click_points(profile, profile_path(profile_name))
        check_hotbar(connection, points)
        check_fit(profile.calibrated, fingerprint_of(devices.display, connection.screen.seen_scales()), profile_name)
        check_block_is_named(reading, version)
        game = LiveGame(scenario, profile, connection, points=points, evidence=evidence)
        controller = connection.controller
        panic = open_panic_switch or _panic_switch_of_the_desktop
        with game, watched(controller), panic(profile.keys.panic, recording.stopping(controller.stop)):
            yield game, devices.display


def _panic_switch_of_the_desktop(key: str, stop: Stop) -> AbstractContextManager[None]:
    # Imported here: importing it needs a display, which is open only now.
    from mc_nested.live.desktop.panic import open_panic_switch

    return open_panic_switch(key, stop)


def fingerprint_of(display: Display, scales: Scales | None = None) -> Fingerprint:
    """The window as it is now, to compare with the one that a profile was calibrated on."""
    return Fingerprint(display.title(), display.size(), scales)
