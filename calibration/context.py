"""What all calibration steps share: the context that they work in, how it is opened, and the result that they return.

A step is a function from a context and a profile to a StepResult. It looks at the game and presses keys, and writes no
file. Its caller writes the profile once every step has succeeded.

A watchdog releases keys that are held too long; the panic key stops all input, and so does a free mouse in a corner.
"""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass

from mc_nested.live.connection import GameConnection, prepare_keyboard
from mc_nested.live.desktop import open_desktop
from mc_nested.live.devices import Devices, Frame
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.input.stops import watched
from mc_nested.live.journal import Journal, Journals
from mc_nested.live.menus.click_points import ClickPoint
from mc_nested.live.menus.wait_for_player import wait_for_front
from mc_nested.live.model.versions import later_version_line
from mc_nested.live.profile.fingerprint import game_in
from mc_nested.live.profile.tables import Profile
from mc_nested.live.recording.run_recorder import OpenRecorder, no_recorder


@dataclass(frozen=True)
class CalibrationContext:
    """The running game, and the person: ``say`` shows them a line, ``ask`` puts a yes-or-no question.

    The connection has no screen reader, since the font step finds the font only later. A step that reads the screen
    takes ``connection.for_profile(profile)``.
    """

    connection: GameConnection
    say: Callable[[str], None]
    ask: Callable[[str], bool]

    @property
    def devices(self) -> Devices:
        """The devices of the game's window."""
        return self.connection.devices

    @property
    def controller(self) -> InputController:
        """The owner of held keys."""
        return self.connection.controller


@dataclass(frozen=True)
class ReportPicture:
    """A picture for the report, (height, width, 3) blue green red: a screenshot or a drawing, with its caption."""

    title: str
    frame: Frame
    note: str = ""


@dataclass(frozen=True)
class StepResult:
    """A step's result: the new profile, one line per finding, the number of measurements, and pictures for the report.

    ``points`` are the recorded click points; their pictures are written beside the profile.
    """

    step: str
    profile: Profile
    lines: tuple[str, ...]
    samples: int
    pictures: tuple[ReportPicture, ...] = ()
    points: tuple[ClickPoint, ...] = ()


OpenContext = Callable[[Profile], AbstractContextManager[CalibrationContext]]
"""Opens the context of a profile's window. When it ends, every key is released."""


def context_opener(
    say: Callable[[str], None],
    ask: Callable[[str], bool],
    *,
    is_server_allowed: bool = False,
    open_recorder: OpenRecorder = no_recorder,
    journal: Journal | None = None,
) -> OpenContext:
    """Opens contexts on this desktop that speak to the person through ``say`` and ``ask``. DesktopError if no window.

    ``open_recorder`` opens what records the calibration; ``journal`` is told what it does.

    After a yes, the game is in front again. If the person doesn't return to it in time, asking raises NotInFrontError.
    """

    @contextmanager
    def opened(profile: Profile) -> Iterator[CalibrationContext]:
        with open_desktop(profile.window.title) as window, open_recorder(profile, window) as recording:
            # Imported here, since it needs the display that is open only now.
            from mc_nested.live.desktop.panic import open_panic_switch

            prepare_keyboard(profile, window)
            devices = recording.devices(window)
            controller = InputController(devices, profile.input)
            connection = GameConnection(
                devices,
                controller,
                is_server_allowed=is_server_allowed,
                journal=Journals(*([journal] if journal else []), recording),
                on_screen=recording.screen,
            )
            stop = recording.stopping(controller.stop)
            if line := later_version_line(game_in(devices.display.title(), profile.game).version):
                say(line)
            with connection, watched(controller), open_panic_switch(profile.keys.panic, stop):
                yield CalibrationContext(connection, say, ask_in_terminal(ask, say, devices))

    return opened


def ask_in_terminal(ask: Callable[[str], bool], say: Callable[[str], None], devices: Devices) -> Callable[[str], bool]:
    """Asks a question outside the game. After a yes, waits until the person has switched back to the game."""

    def ask_and_return(question: str) -> bool:
        is_yes = ask(question)
        if is_yes and not devices.display.is_in_front():
            say("Switch back to the game.")
            wait_for_front(devices)
        return is_yes

    return ask_and_return
