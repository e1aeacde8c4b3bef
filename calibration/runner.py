"""Runs the calibration steps one after the other, each on the profile that the step before left. Writes no file.

If a needed step fails, the run ends. Any other failed step is skipped with a warning: a missing button costs its click
point, but not the arena and the walk.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from calibration.context import CalibrationContext, StepResult
from mc_nested.errors import DesktopError, LiveError, McNestedError, NotInFrontError, StoppedError, UserError
from mc_nested.live.profile.tables import Profile

StepFunction = Callable[[CalibrationContext, Profile], StepResult]


@dataclass(frozen=True)
class CalibrationStep:
    """A step of the run: its name, its function, and whether the run ends if it fails."""

    name: str
    run: StepFunction
    is_needed: bool = True


class StepProgress(Protocol):
    """Is notified of the progress of the run. Seconds are those of the game window's clock."""

    def begin(self, name: str, number: int, of: int) -> None:
        """Step ``number`` of ``of`` begins; the first is 1."""

    def end(self, result: StepResult, seconds: float) -> None:
        """The step succeeded."""

    def skip(self, reason: str, seconds: float) -> None:
        """The step failed, and the run continues without it."""


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
    progress: StepProgress,
    recover: Callable[[Profile], None],
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
            raise _named(step, _resized(size, now))
        results.append(result)
        profile = result.profile
        progress.end(result, clock.now() - started_at)
    return RunResult(profile, tuple(results), skipped)


def _resized(before: tuple[int, int], now: tuple[int, int]) -> DesktopError:
    was, is_now = (f"{size[0]} x {size[1]}" for size in (before, now))
    return DesktopError(f"the window was {was} pixels and is {is_now}: leave it as it is, and start again")


def _named(step: CalibrationStep, error: McNestedError) -> McNestedError:
    """The same error with the step's name, and a note that the profile is unchanged."""
    return type(error)(f"{step.name}: {error} (the profile is as it was)")
