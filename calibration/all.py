"""Everything calibrated in one go: the doctor, the steps, a proof; then the profile, written once, and what was seen.

doctor -> font -> arena -> walk -> clicks -> F3+C -> proof -> the profile -> the doctor again -> kept for the report
"""

import dataclasses
import datetime
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Protocol

from calibration import run_steps
from calibration.arena.copy_note import forget_known_copy, saying_how_to_undo
from calibration.bench import BenchOf
from calibration.doctor.check import Check
from calibration.report.kept import keep_or_warn
from calibration.run_steps import Guided, Step
from calibration.start import profile_to_calibrate
from calibration.step import Bench, Found
from calibration.written import write_found
from mc_nested.errors import DesktopError
from mc_nested.live.devices import Display
from mc_nested.live.fingerprint import check_single_player, game_in, version_in
from mc_nested.live.font import load_font
from mc_nested.live.game_screen import WindowScreen
from mc_nested.live.profile import Profile
from mc_nested.live.profile_tables import Calibrated
from mc_nested.live.session import overlay_of
from mc_nested.live.way_back import WayBack

GATES = frozenset(
    {
        *("session", "display scaling", "game's window", "in front", "size and GUI scale"),
        *("reduced debug info", "position line", "looked-at line", "input"),
    }
)
"""Rows of the doctor's that nothing can be calibrated without; what else fails, a step may mend, or do without."""

Examined = Callable[[str], Sequence[Check]]
"""The doctor's rows for a profile of that name."""


class Progress(run_steps.Progress, Protocol):
    """Somebody who watches it all."""

    def checked(self, checks: Sequence[Check]) -> None:
        """The doctor has looked at everything, and nothing that all the rest needs fails."""


@dataclass(frozen=True)
class Whole:
    """What it came to: the profile's file, what the steps found, and the doctor's rows with the new profile."""

    path: Path
    guided: Guided
    checks: Sequence[Check]


def calibrate_all(
    profile_name: str,
    bench_of: BenchOf,
    examined: Examined,
    steps: Sequence[Step],
    progress: Progress,
    today: str | None = None,
    *,
    is_server_allowed: bool = False,
) -> Whole:
    """Calibrate a profile, a new one where there is none of that name; nothing of it is written before all is done.

    ``today`` is the day that is noted, as year-month-day. Unless ``is_server_allowed``, a game that others may share is
    refused before anything is pressed.

    Raises:
        DesktopError: a row of the doctor's fails that all the rest needs, or others may share the game; it says what
            to do.
        UserError, LiveError: a needed step failed, or the game was taken away. The profile is as it was, every key up;
            where an arena was built, a note beside the profile lets it be undone.
    """
    path, profile = profile_to_calibrate(profile_name)
    checks = examined(profile_name)
    for check in checks:
        if check.status == "fail" and check.name in GATES:
            raise DesktopError(f"{check.name}: {check.detail}: {check.fix or 'run mc-nested doctor'}")
    progress.checked(checks)
    with saying_how_to_undo(path), bench_of(profile) as bench:
        display = bench.desktop.display
        check_single_player(display.title(), is_server_allowed=is_server_allowed)
        profile = profile.model_copy(update={"game": game_in(display.title(), profile.game)})
        guided = run_steps.run_steps(steps, bench, profile, progress, partial(_find_world, bench))
        fingerprint = _fingerprint(guided, display, today or datetime.date.today().isoformat())
    guided = dataclasses.replace(guided, profile=guided.profile.model_copy(update={"calibrated": fingerprint}))
    points = tuple(point for found in guided.found for point in found.points)
    with saying_how_to_undo(path):
        write_found(Found("all", guided.profile, (), 0, points=points), path)
    forget_known_copy(guided.profile, path)
    checks = examined(profile_name)
    keep_or_warn(bench.say, path, guided.found, checks, fingerprint.date)
    return Whole(path, guided, checks)


def _find_world(bench: Bench, profile: Profile) -> None:
    desktop = bench.desktop
    screen = WindowScreen(desktop.display, load_font(profile.screen.font_path()), overlay_of(profile))
    WayBack(profile, bench.hands, screen, desktop.display, desktop.clock).find()


def _fingerprint(guided: Guided, display: Display, day: str) -> Calibrated:
    """What the profile was calibrated on, as it is seen now."""
    profile = guided.profile
    screen = WindowScreen(display, load_font(profile.screen.font_path()), overlay_of(profile))
    return Calibrated(
        date=day,
        version=version_in(display.title()),
        window=display.size(),
        gui_scale=screen.scale(),
        samples={found.step: found.samples for found in guided.found},
    )
