"""The guided run (``mc-nested calibrate all``): every step in one go, then the profile is written, once.

doctor -> font -> arena -> walk -> clicks -> F3+C -> acceptance test -> profile -> doctor again -> data for the report

Each step works on the profile that the step before left. If a needed step fails, the run ends. Any other failed step is
skipped with a warning: a missing button costs its click point, but not the arena and the walk.
"""

import dataclasses
import datetime
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

from calibration.acceptance_test import run_acceptance_test
from calibration.arena.build import build_arena
from calibration.arena.mark import check_standing
from calibration.arena.undo import remove_saved_copy_note
from calibration.clicks.find import find_clicks_unattended
from calibration.context import CalibrationContext, OpenContext, StepResult
from calibration.cross_check import cross_check
from calibration.doctor.check import Check, CheckName
from calibration.font.find import find_font, sources_for, sources_here
from calibration.font.sources import FontSources
from calibration.report.findings import save_findings_or_warn
from calibration.step_profile import starting_profile, write_result
from calibration.walk.measure import walk
from mc_nested.arena.action import Cell
from mc_nested.arena.scenario import DEFAULT_SIZE
from mc_nested.errors import DesktopError, LiveError, McNestedError, NotInFrontError, StoppedError, UserError
from mc_nested.live.connection import screen_for
from mc_nested.live.devices import Devices
from mc_nested.live.menus.recovery import Recovery
from mc_nested.live.model.versions import version_in
from mc_nested.live.profile.arena import near_middle
from mc_nested.live.profile.fingerprint import game_in, size_text
from mc_nested.live.profile.tables import CalibratedTable, Profile

StepFunction = Callable[[CalibrationContext, Profile], StepResult]


@dataclass(frozen=True)
class CalibrationStep:
    """A step of the run: its name, its function, and whether the run ends if it fails."""

    name: str
    run: StepFunction
    is_needed: bool = True


def registered_steps(
    font: Path | None = None,
    sources: Callable[[str | None], FontSources] = sources_here,
    *,
    size: int = DEFAULT_SIZE,
    standing: Cell | None = None,
    path: Path | None = None,
) -> list[CalibrationStep]:
    """Return all steps. Missing buttons and an unreachable clipboard don't end the run.

    ``font`` and ``sources`` are as in ``font.sources_for``. ``size``, ``standing`` and ``path`` are as in
    ``build_arena``. UserError as ``check_standing``.
    """
    check_standing(near_middle(size) if standing is None else standing, size)
    return [
        CalibrationStep("font", lambda opened, own: find_font(opened, own, sources_for(opened, own, font, sources))),
        CalibrationStep("arena", partial(build_arena, path=path, size=size, standing=standing)),
        CalibrationStep("walk", walk),
        CalibrationStep("clicks", find_clicks_unattended, is_needed=False),
        CalibrationStep("cross-check", cross_check, is_needed=False),
        CalibrationStep("proof", run_acceptance_test),
    ]


class CalibrationProgress(Protocol):
    """Is notified of the progress of the run. Seconds are those of the game window's clock."""

    def doctor_done(self, checks: Sequence[Check]) -> None:
        """Tell that the doctor is done, and that every gate is passed."""

    def begin(self, name: str, number: int, of: int) -> None:
        """Step ``number`` of ``of`` begins; the first is 1."""

    def end(self, result: StepResult, seconds: float) -> None:
        """Tell that the step succeeded."""

    def skip(self, reason: str, seconds: float) -> None:
        """Tell that the step failed, and that the run continues without it."""


@dataclass(frozen=True)
class RunResult:
    """The profile with everything that was found, the results of the steps, and why steps were skipped, by name."""

    profile: Profile
    results: tuple[StepResult, ...]
    skipped: dict[str, str]


def run_steps(
    steps: Sequence[CalibrationStep],
    context: CalibrationContext,
    profile: Profile,
    progress: CalibrationProgress,
    recover: Callable[[Profile], object],
) -> RunResult:
    """Run the steps in order.

    ``recover`` returns to the world, since a skipped step may have left a menu open.

    Raises:
        McNestedError: a needed step failed; or, in any step, the game lost the front, the person stopped the run, or
            the window was resized. The message names the step. Every key is released.
    """
    results: list[StepResult] = []
    skipped: dict[str, str] = {}
    clock, display = context.devices.clock, context.devices.display
    size = display.size()
    for number, step in enumerate(steps, 1):
        progress.begin(step.name, number, len(steps))
        started_at = clock.now()
        try:
            result = step.run(context, profile)
        except (NotInFrontError, StoppedError) as error:
            raise _named(step, error) from error
        except (LiveError, UserError) as error:
            if step.is_needed:
                raise _named(step, error) from error
            skipped[step.name] = str(error)
            progress.skip(str(error), clock.now() - started_at)
            recover(profile)
            continue
        finally:
            context.controller.release_all()
        if (now := display.size()) != size:
            resized = (
                f"the window was {size_text(size)} pixels and is {size_text(now)}: leave it as it is, and start again"
            )
            raise _named(step, DesktopError(resized))
        results.append(result)
        profile = result.profile
        progress.end(result, clock.now() - started_at)
    return RunResult(profile, tuple(results), skipped)


def _named(step: CalibrationStep, error: McNestedError) -> McNestedError:
    """Return the same error with the step's name, and a note that the profile is unchanged."""
    return type(error)(f"{step.name}: {error} (the profile is as it was)")


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


def check_gates(checks: Sequence[Check]) -> None:
    """Raise DesktopError, which says what to do, if a gate fails."""
    for check in checks:
        if check.status == "fail" and check.name in GATES:
            raise DesktopError(f"{check.name}: {check.detail}: {check.fix or 'run mc-nested doctor'}")


Examine = Callable[[str], Sequence[Check]]
"""The doctor's checks for the profile of that name."""


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
    with open_context(profile) as context:
        display = context.devices.display
        context.connection.check_single_player()
        profile = profile.model_copy(update={"game": game_in(display.title(), profile.game)})
        connection = context.connection
        run = run_steps(steps, context, profile, progress, lambda p: Recovery(p, connection.for_profile(p)).recover())
        fingerprint = _fingerprint(run, context.devices, today or datetime.date.today().isoformat())
    run = dataclasses.replace(run, profile=run.profile.model_copy(update={"calibrated": fingerprint}))
    points = tuple(point for result in run.results for point in result.points)
    write_result(StepResult("all", run.profile, (), 0, points=points), path)
    remove_saved_copy_note(run.profile, path)
    checks = examine(profile_name)
    save_findings_or_warn(context.say, path, run.results, checks, fingerprint.date)
    return CalibrationResult(path, run, checks)


def _fingerprint(run: RunResult, devices: Devices, day: str) -> CalibratedTable:
    """Return the game's state that the profile was calibrated for, as it is seen now."""
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
