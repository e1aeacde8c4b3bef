"""What all calibration steps share: the context that they work in, and the result that they return.

A step is a function from a context and a profile to a StepResult. It looks at the game and presses keys, and writes no
file. Its caller writes the profile once every step has succeeded.
"""

from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Devices, Frame
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.menus.click_points import ClickPoint
from mc_nested.live.profile.tables import Profile


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
