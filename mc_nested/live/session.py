"""Open a live game: its window, the connection to it, and the Game that is played there, from one value, an Opening."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path

import tomlkit

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import table_of
from mc_nested.errors import RecordingError
from mc_nested.live.connection import GameConnection, prepare_keyboard
from mc_nested.live.desktop import open_desktop
from mc_nested.live.desktop.panic import open_panic_switch, open_takeover_key
from mc_nested.live.devices import SWITCH_KEYS, Devices, Display
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.input.stops import Stop, Switch, Takeover, watched
from mc_nested.live.journal import Journal, Journals
from mc_nested.live.live_game import LiveGame, check_fits
from mc_nested.live.menus.click_points import load_click_points
from mc_nested.live.menus.wait_for_player import check_block_is_named, check_hotbar, wait_until_standing_still
from mc_nested.live.model.versions import later_version_line
from mc_nested.live.profile.fingerprint import Fingerprint, check_fit, game_in
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.live.profile.tables import Profile
from mc_nested.live.recording.recorder import Recorder
from mc_nested.live.recording.run_recorder import open_recorder
from mc_nested.live.vision.font import load_font
from mc_nested.live.vision.layout import Scales

OFF = "off"
"""Instead of a folder for the recording: nothing is recorded."""


Guard = Callable[[], AbstractContextManager[None]]
"""While it lasts, a watchdog releases keys that are held too long, and the panic switch stops all input."""


@dataclass(frozen=True)
class Opening:
    """The settings for opening a game's window: its profile, who is told what happens there, and what is recorded.

    Args:
        profile: the profile's name or file.
        say: shows one line to the player.
        what: the run, in a word or two, as "train-line": what its recording is named.
        record: a new folder for the recording, or "off"; None for one among the others.
        is_server_allowed: whether to play in a game that others may share.
        journal: is told what is waited for, read, planned and done.
        evidence: the folder for the last frames of a game that was given up.
        open_devices: opens the window whose title matches.
        open_panic_switch: opens the panic switch of the key that a profile names.
        open_takeover_key: has that key of a profile switch over between agent and player.
        takeover: how a player may take over; None where nobody may.

    Raises:
        RecordingError: the recording's folder holds something already.
    """

    profile: str
    say: Callable[[str], None]
    what: str = "play"
    record: str | Path | None = OFF
    is_server_allowed: bool = False
    journal: Journal | None = None
    evidence: Path | None = None
    open_devices: Callable[[str], AbstractContextManager[Devices]] = open_desktop
    open_panic_switch: Callable[[str, Stop], AbstractContextManager[None]] = open_panic_switch
    open_takeover_key: Callable[[str, Switch], AbstractContextManager[None]] = open_takeover_key
    takeover: Takeover | None = None

    def __post_init__(self) -> None:
        folder = self._recordings_folder
        if folder is not None and folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise RecordingError(f"{folder}: holds something already: name a new folder for the recording, or {OFF!r}")

    @contextmanager
    def connection(self, profile: Profile, scenario: Scenario | None = None) -> Iterator[tuple[GameConnection, Guard]]:
        """Open the profile's window, recorded if that is asked for; it isn't read yet, and nothing is pressed.

        Yields the connection to it, and what guards a block in which something is pressed.

        Args:
            profile: whose window it is.
            scenario: what is built there, if anything: the recording keeps it.

        Raises:
            DesktopError: there is no such window, or this keyboard lacks one of the profile's keys.
        """
        with self.open_devices(profile.window.title) as window, self._recorder(profile, window, scenario) as recorder:
            prepare_keyboard(profile, window)
            devices = recorder.devices(window) if recorder else window
            if line := later_version_line(game_in(devices.display.title(), profile.game).version):
                self.say(line)
            controller = InputController(devices, profile.input, *([recorder.hands] if recorder else []))
            connection = GameConnection(
                devices,
                controller,
                is_server_allowed=self.is_server_allowed,
                journal=Journals(*(each for each in (self.journal, recorder) if each)),
                on_screen=recorder.screen if recorder else lambda screen: screen,
            )
            stop = recorder.stopping(controller.stop) if recorder else controller.stop

            @contextmanager
            def guarded() -> Iterator[None]:
                with ExitStack() as guards:
                    guards.enter_context(watched(controller))
                    guards.enter_context(self.open_panic_switch(profile.keys.panic, stop))
                    if self.takeover is not None:
                        guards.enter_context(self.open_takeover_key(profile.keys.takeover, controller.switch_over))
                        guards.enter_context(self.takeover.offer(controller.switch_over))
                    yield

            yield connection, guarded

    @property
    def _recordings_folder(self) -> Path | None:
        return None if self.record in (None, OFF) else Path(self.record)

    def _recorder(
        self, profile: Profile, window: Devices, scenario: Scenario | None
    ) -> AbstractContextManager[Recorder | None]:
        if self.record == OFF:
            return nullcontext()
        facts = {"is_server_allowed": str(self.is_server_allowed).lower()}
        if scenario is not None:
            facts["scenario"] = tomlkit.dumps(table_of(scenario).model_dump(exclude_none=True))
        return open_recorder(self._recordings_folder, self.what, self.say, profile, window, facts)


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
    with opening.connection(profile, scenario) as (unread, guarded):
        connection = unread.for_profile(profile)
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
        if opening.takeover is not None:
            say(f"To take over, and to give back, press {profile.keys.takeover}.")
        takeover = replace(opening.takeover or Takeover(), say=say)
        game = LiveGame(scenario, profile, connection, points=points, evidence=opening.evidence, takeover=takeover)
        with game, guarded():
            yield game, display


def fingerprint_of(display: Display, scales: Scales | None = None) -> Fingerprint:
    """Return the window as it is now, to compare with the one that a profile was calibrated on."""
    return Fingerprint(display.title(), display.size(), scales)
