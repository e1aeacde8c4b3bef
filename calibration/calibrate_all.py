"""The guided run (``mc-nested calibrate all``): every step in one go, then the profile is written, once.

doctor -> font -> arena -> walk -> clicks -> F3+C -> acceptance test -> profile -> doctor again -> data for the report
"""

import dataclasses
import datetime
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

from calibration import runner
from calibration.arena.copy_note import remove_saved_copy_note, undo_hint_on_error
from calibration.context import CalibrationContext, StepResult
from calibration.doctor.check import Check, CheckName
from calibration.open_context import OpenContext
from calibration.report.kept import keep_or_warn
from calibration.runner import CalibrationStep, RunResult
from calibration.starting_profile import starting_profile
from calibration.write_result import write_result
from mc_nested.errors import DesktopError
from mc_nested.live.connection import screen_for
from mc_nested.live.devices import Devices
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.profile.fingerprint import game_in
from mc_nested.live.profile.tables import CalibratedTable, Profile
from mc_nested.live.profile.window_title import version_in

GATES = frozenset(
    {
        CheckName.SESSION,
        CheckName.DISPLAY_SCALING,
        CheckName.WINDOW,
        CheckName.IN_FRONT,
        CheckName.SIZE_AND_SCALE,
        CheckName.REDUCED_DEBUG_INFO,
        CheckName.POSITION_LINE,
        CheckName.TARGET_LINE,
        CheckName.INPUT,
    }
)
"""The doctor's checks without which nothing can be calibrated. Other failures are mended by a step, or do no harm."""

Examine = Callable[[str], Sequence[Check]]
"""The doctor's checks for the profile of that name."""


class CalibrationProgress(runner.StepProgress, Protocol):
    """Is notified of the progress of the guided run."""

    def doctor_done(self, checks: Sequence[Check]) -> None:
        """The doctor is done, and every gate is passed."""


@dataclass(frozen=True)
class CalibrationResult:
    """The profile's file, the result of the steps, and the doctor's checks with the new profile."""

    path: Path
    run: RunResult
    checks: Sequence[Check]


def calibrate_all(
    profile_name: str,
    open_context: OpenContext,
    examine: Examine,
    steps: Sequence[CalibrationStep],
    progress: CalibrationProgress,
    today: str | None = None,
) -> CalibrationResult:
    """Calibrate a profile, or a new one if there is none of that name. Nothing is written until every step is done.

    ``today`` is the date to record (year-month-day). A game that others may share is refused before any key is pressed,
    unless the context allows it.

    Raises:
        DesktopError: a gate of the doctor's fails, or others may share the game. The message says what to do.
        UserError, LiveError: a needed step failed, or the game was taken away. The profile is unchanged and every key
            is released. If an arena was built, a note beside the profile allows it to be undone.
    """
    path, profile = starting_profile(profile_name)
    checks = examine(profile_name)
    check_gates(checks)
    progress.doctor_done(checks)
    with undo_hint_on_error(path), open_context(profile) as context:
        display = context.devices.display
        context.connection.check_single_player()
        profile = profile.model_copy(update={"game": game_in(display.title(), profile.game)})
        run = runner.run_steps(steps, context, profile, progress, partial(_recover, context))
        fingerprint = _fingerprint(run, context.devices, today or datetime.date.today().isoformat())
    run = dataclasses.replace(run, profile=run.profile.model_copy(update={"calibrated": fingerprint}))
    points = tuple(point for result in run.results for point in result.points)
    with undo_hint_on_error(path):
        write_result(StepResult("all", run.profile, (), 0, points=points), path)
    remove_saved_copy_note(run.profile, path)
    checks = examine(profile_name)
    keep_or_warn(context.say, path, run.results, checks, fingerprint.date)
    return CalibrationResult(path, run, checks)


def check_gates(checks: Sequence[Check]) -> None:
    """DesktopError with the remedy of the first gate that fails."""
    for check in checks:
        if check.status == "fail" and check.name in GATES:
            raise DesktopError(f"{check.name}: {check.detail}: {check.fix or 'run mc-nested doctor'}")


def _recover(context: CalibrationContext, profile: Profile) -> None:
    Recovery(profile, context.connection.for_profile(profile)).recover()


def _fingerprint(run: RunResult, devices: Devices, day: str) -> CalibratedTable:
    """The game's state that the profile was calibrated for, as it is seen now."""
    profile = run.profile
    scales = screen_for(profile, devices).seen_scales()
    return CalibratedTable(
        date=day,
        version=version_in(devices.display.title()),
        window=devices.display.size(),
        gui_scale=scales and scales.gui,
        debug_scale=scales and scales.debug,
        samples={result.step: result.samples for result in run.results},
    )
