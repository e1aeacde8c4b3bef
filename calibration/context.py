"""The context that all calibration steps work in, the function that opens it, and the result that they return.

A step is a function from a context and a profile to a StepResult. It looks at the game and presses keys, and writes no
file. Its caller writes the profile once every step has succeeded.

A watchdog releases keys that are held too long; the panic key stops all input, and so does a free mouse in a corner.
"""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass

from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Devices, Frame
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.menus.click_points import ClickPoint
from mc_nested.live.menus.wait_for_player import wait_for_front
from mc_nested.live.profile.tables import Profile
from mc_nested.live.session import Opening


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


def context_opener(opening: Opening, ask: Callable[[str], bool]) -> OpenContext:
    """Open contexts as the opening says, whatever the profile; they ask the person through ``ask``.

    After a yes, the game is in front again. If the person doesn't return to it in time, asking raises NotInFrontError.
    """

    @contextmanager
    def opened(profile: Profile) -> Iterator[CalibrationContext]:
        with opening.connection(profile) as (connection, guarded), connection, guarded():
            asks = ask_in_terminal(ask, opening.say, connection.devices)
            yield CalibrationContext(connection, opening.say, asks)

    return opened


def ask_in_terminal(ask: Callable[[str], bool], say: Callable[[str], None], devices: Devices) -> Callable[[str], bool]:
    """Ask a question outside the game. After a yes, wait until the person has switched back to the game."""

    def ask_and_return(question: str) -> bool:
        is_yes = ask(question)
        if is_yes and not devices.display.is_in_front():
            say("Switch back to the game.")
            wait_for_front(devices)
        return is_yes

    return ask_and_return
