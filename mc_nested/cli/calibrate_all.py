"""``mc-nested calibrate all``: the guided run through every calibration, its profile, and the report beside it."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from calibration.calibrate_all import calibrate_all
from calibration.context import StepResult
from calibration.doctor.check import Check
from calibration.doctor.examination import examine
from calibration.installation.folders import System
from calibration.open_context import context_opener
from calibration.registry import registered_steps
from calibration.report.page import TITLES
from mc_nested.cli.arena_options import ForScenarioOption, SizeOption, StandingOption, arena_size
from mc_nested.cli.calibrate_report import report_path, write_report
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite, ServerOption
from mc_nested.errors import ProfileError
from mc_nested.live.desktop import open_clipboard
from mc_nested.live.profile.store import profile_path


def calibrate(
    profile: ProfileToWrite = DEFAULT_PROFILE,
    yes: Annotated[bool, typer.Option("--yes", help="ask nothing: clear the arena's region, visit the title")] = False,
    font: Annotated[
        Path | None, typer.Option(metavar="JAR|PNG", help="take this client jar, resource pack or ascii.png")
    ] = None,
    size: SizeOption = None,
    scenario: ForScenarioOption = None,
    standing: StandingOption = None,
    server_allowed: ServerOption = False,
) -> None:
    """Do all of it in one go, in about two minutes; stand on the middle of the arena's near edge and look across it."""
    context_of = context_opener(
        typer.echo, (lambda _: True) if yes else typer.confirm, is_server_allowed=server_allowed
    )
    steps = registered_steps(font, size=arena_size(size, scenario), standing=standing, path=profile_path(profile))
    shown = Lines()
    whole = calibrate_all(profile, context_of, partial(_examined, font), steps, shown)
    left_out = [TITLES.get(name, name) for name in whole.run.skipped]
    without = f", without: {', '.join(left_out)}" if left_out else ""
    typer.echo(f"calibrated in {shown.seconds:.0f} s{without}")
    typer.echo(f"profile: {whole.path}")
    try:
        write_report(profile, report_path(whole.path))
    except ProfileError as error:
        typer.echo(f"warning: no report: {error}")


class Lines:
    """The run as lines: each step's name when it begins, what it found, and how long that took."""

    def __init__(self) -> None:
        self.seconds = 0.0

    def doctor_done(self, checks: Sequence[Check]) -> None:
        """How many of the doctor's rows have each status, and the rows where something is to be done."""
        counts = [(status, sum(check.status == status for check in checks)) for status in ("pass", "warn", "fail")]
        typer.echo(f"doctor: {', '.join(f'{count} {status}' for status, count in counts if count)}")
        for check in checks:
            if check.status in ("warn", "fail"):
                typer.echo(f"    {check.status}: {check.name}: {check.detail}{f'; {check.fix}' if check.fix else ''}")

    def begin(self, name: str, number: int, of: int) -> None:
        """Its name and number."""
        typer.echo(f"{number}/{of} {TITLES.get(name, name)}")

    def end(self, result: StepResult, seconds: float) -> None:
        """Its findings."""
        self._took(seconds)
        for line in result.lines:
            typer.echo(f"    {line}")
        typer.echo(f"    [{seconds:.0f} s, {self.seconds:.0f} s in all]")

    def skip(self, reason: str, seconds: float) -> None:
        """Why it isn't there."""
        self._took(seconds)
        typer.echo(f"    warning: {reason}; the run goes on without it")

    def _took(self, seconds: float) -> None:
        self.seconds += seconds


def _examined(font: Path | None, profile_name: str) -> Sequence[Check]:
    say = partial(typer.echo, err=True)
    return examine(profile_name, say=say, system=System.here(), clipboard=open_clipboard(), font=font).checks
