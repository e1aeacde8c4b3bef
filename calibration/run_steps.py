"""The guided run: one step after the other, each on the profile that the one before left; nothing is written by it.

A step that the next ones stand on ends the run where it fails. One that they don't is passed over with a warning: a
button that isn't there costs its point, not the arena and the walk.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

from calibration.step import Bench, Found
from mc_nested.errors import DesktopError, LiveError, McNestedError, NotInFrontError, StoppedError, UserError
from mc_nested.live.profile import Profile

Run = Callable[[Bench, Profile], Found]


@dataclass(frozen=True)
class Step:
    """A step of the run: its name, what it does, and whether the run ends where it fails."""

    name: str
    run: Run
    is_needed: bool = True


class Progress(Protocol):
    """Somebody who watches the run; seconds are those of the bench's clock."""

    def begin(self, name: str, number: int, of: int) -> None:
        """Step ``number`` of so many begins, the first being 1."""

    def end(self, found: Found, seconds: float) -> None:
        """The step found this."""

    def passed_over(self, reason: str, seconds: float) -> None:
        """The step failed, and the run goes on without it."""


@dataclass(frozen=True)
class Guided:
    """What the run came to: the profile with all that was found, by step, and why steps were passed over."""

    profile: Profile
    found: tuple[Found, ...]
    passed_over: dict[str, str]


def run_steps(
    steps: Sequence[Step], bench: Bench, profile: Profile, progress: Progress, way_back: Callable[[Profile], None]
) -> Guided:
    """Run the steps in their order.

    ``way_back`` leads into the world again, where a step that is passed over may have left a menu open.

    Raises:
        McNestedError: a needed step failed, or, whatever the step, the game's window was taken away or made another
            size; it names the step. Every key is up then.
    """
    found: list[Found] = []
    passed_over: dict[str, str] = {}
    clock, display = bench.desktop.clock, bench.desktop.display
    size = display.size()
    for number, step in enumerate(steps, 1):
        progress.begin(step.name, number, len(steps))
        began = clock.now()
        try:
            each = step.run(bench, profile)
        except (NotInFrontError, StoppedError) as error:
            raise _named(step, error) from error
        except (LiveError, UserError) as error:
            if step.is_needed:
                raise _named(step, error) from error
            passed_over[step.name] = str(error)
            progress.passed_over(str(error), clock.now() - began)
            way_back(profile)
            continue
        finally:
            bench.hands.release_all()
        if (now := display.size()) != size:
            raise _named(step, _resized(size, now))
        found.append(each)
        profile = each.profile
        progress.end(each, clock.now() - began)
    return Guided(profile, tuple(found), passed_over)


def _resized(before: tuple[int, int], now: tuple[int, int]) -> DesktopError:
    was, is_now = (f"{size[0]} x {size[1]}" for size in (before, now))
    return DesktopError(f"the window was {was} pixels and is {is_now}: leave it as it is, and start again")


def _named(step: Step, error: McNestedError) -> McNestedError:
    """The same error, which says where it happened, and that nothing was lost."""
    return type(error)(f"{step.name}: {error} (the profile is as it was)")
