"""The runner of the steps: what each step gets, what ends the run, and which steps are skipped."""

import contextlib
from dataclasses import dataclass, field

import pytest

from calibration.context import CalibrationContext, StepResult
from calibration.runner import CalibrationStep, RunResult, StepFunction, run_steps
from mc_nested.errors import (
    LiveError,
    McNestedError,
    NotConfirmedError,
    NotInFrontError,
    ProfileError,
    StoppedError,
    UserError,
)
from mc_nested.live.profile.tables import GameVersion, KeysTable, Profile
from sim.client.client import VirtualClient
from tests.calibration.contexts import context_over


@dataclass
class ProgressLog:
    """Notes the progress of the run."""

    events: list[object] = field(default_factory=list)

    def begin(self, name: str, number: int, of: int) -> None:
        self.events.append((name, number, of))

    def end(self, result: StepResult, seconds: float) -> None:
        self.events.append((result.lines, round(seconds, 6)))

    def skip(self, reason: str, seconds: float) -> None:
        self.events.append((reason, round(seconds, 6)))


class Room:
    """A virtual client with a calibration context, and the profiles with which the run recovered."""

    def __init__(self) -> None:
        self.client = VirtualClient()
        self.progress = ProgressLog()
        self.recoveries: list[Profile] = []
        self.context = context_over(self.client)

    def run(self, *steps: CalibrationStep, profile: Profile | None = None) -> RunResult:
        return run_steps(steps, self.context, profile or Profile(), self.progress, self.recoveries.append)


def sets(**tables: object) -> StepFunction:
    """A step that takes a second and finds these tables."""

    def run(context: CalibrationContext, profile: Profile) -> StepResult:
        context.devices.clock.sleep_until(context.devices.clock.now() + 1)
        return StepResult("+".join(tables), profile.model_copy(update=tables), (f"found {', '.join(tables)}",), 1)

    return run


def fails(error: BaseException) -> StepFunction:
    """A step that fails after half a second, a key still down."""

    def run(context: CalibrationContext, _profile: Profile) -> StepResult:
        context.controller.confirm_screen("world")
        context.controller.press(context.devices.clock.now() + 2, "w")
        context.devices.clock.sleep_until(context.devices.clock.now() + 0.5)
        raise error

    return run


OLD = GameVersion(version="1.12.2")
SWAPPED = KeysTable(left="d", right="a")


def test_each_step_stands_on_what_the_one_before_found() -> None:
    room = Room()
    seen: list[Profile] = []

    def last(_context: CalibrationContext, profile: Profile) -> StepResult:
        seen.append(profile)
        return StepResult("last", profile, (), 0)

    result = room.run(
        CalibrationStep("game", sets(game=OLD)),
        CalibrationStep("keys", sets(keys=SWAPPED)),
        CalibrationStep("last", last),
    )
    assert result.profile == seen[0] == Profile(game=OLD, keys=SWAPPED)
    assert [each.step for each in result.results] == ["game", "keys", "last"]
    assert result.skipped == {}
    assert room.progress.events == [
        ("game", 1, 3),
        (("found game",), 1.0),
        ("keys", 2, 3),
        (("found keys",), 1.0),
        ("last", 3, 3),
        ((), 0.0),
    ]


@pytest.mark.parametrize("error", [NotConfirmedError("no"), ProfileError("no")])
def test_a_needed_step_that_fails_ends_the_run_and_names_itself(error: McNestedError) -> None:
    room = Room()
    with pytest.raises(type(error), match=r"^walk: no \(the profile is as it was\)$"):
        room.run(CalibrationStep("walk", fails(error)), CalibrationStep("never", fails(AssertionError())))
    assert room.recoveries == []


@pytest.mark.parametrize("error", [LiveError("no such button"), UserError("no such button")])
def test_a_step_that_nothing_stands_on_is_skipped_and_the_world_found_again(error: McNestedError) -> None:
    room = Room()
    result = room.run(
        CalibrationStep("game", sets(game=OLD)),
        CalibrationStep("clicks", fails(error), is_needed=False),
        CalibrationStep("keys", sets(keys=SWAPPED)),
    )
    assert result.profile == Profile(game=OLD, keys=SWAPPED)
    assert [each.step for each in result.results] == ["game", "keys"]
    assert result.skipped == {"clicks": "no such button"}
    assert ("no such button", 0.5) in room.progress.events
    assert room.recoveries == [Profile(game=OLD)]


@pytest.mark.parametrize("error", [NotInFrontError("behind"), StoppedError("the panic key was pressed")])
def test_losing_the_game_ends_the_run_in_any_step(error: McNestedError) -> None:
    with pytest.raises(type(error), match="clicks: "):
        Room().run(
            CalibrationStep("clicks", fails(error), is_needed=False), CalibrationStep("never", fails(AssertionError()))
        )


@pytest.mark.parametrize("is_needed", [True, False])
@pytest.mark.parametrize("error", [NotConfirmedError("no"), KeyboardInterrupt(), StoppedError("stop")])
def test_no_key_stays_down_however_a_step_ends(error: BaseException, is_needed: bool) -> None:
    room = Room()
    with contextlib.suppress(LiveError, KeyboardInterrupt):
        room.run(CalibrationStep("walk", fails(error), is_needed=is_needed))
    assert not room.client.window.down
