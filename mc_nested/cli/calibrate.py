"""``mc-nested calibrate``: the guided run through every step, its report, and undoing what the last one wrote."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from calibration.calibrate_all import calibrate_all as calibrate_every_step
from calibration.calibrate_all import registered_steps
from calibration.context import StepResult
from calibration.doctor.check import Check
from calibration.doctor.examination import examine
from calibration.installation.folders import System
from calibration.report.page import TITLES, report_path, write_report
from mc_nested.cli.calibrate_steps import FontOption, arena, calibrating, clicks, font, walk
from mc_nested.cli.options import (
    DEFAULT_PROFILE,
    ForScenarioOption,
    LayerOption,
    ProfileOption,
    ProfileToWrite,
    RecordOption,
    ServerOption,
    SizeOption,
    StandingOption,
    arena_size,
    opening_of,
)
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints
from mc_nested.cli.view import ViewOption
from mc_nested.errors import ProfileError
from mc_nested.live.desktop import open_clipboard
from mc_nested.live.profile.store import profile_path, undo_profile
from mc_nested.view.publisher import Publisher

app = typer.Typer(help="Tell the agent where your arena and your buttons are.")


@dataclass(frozen=True)
class Calibrated:
    """What ``calibrate all`` prints."""

    profile: Annotated[Path, "the profile's file"]
    seconds: Annotated[float, "that the steps took"]
    steps: Annotated[Sequence[object], "of each: its name, what it found as lines, and on how many samples"]
    left_out: Annotated[Mapping[str, str], "steps that failed, with the reason"]
    report: Annotated[Path | None, "the report's file"]


@app.command("all")
@prints(Calibrated)
def calibrate_all(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    profile: ProfileToWrite = DEFAULT_PROFILE,
    yes: Annotated[bool, typer.Option("--yes", help="ask nothing: clear the arena's region, visit the title")] = False,
    font: FontOption = None,
    size: SizeOption = None,
    scenario: ForScenarioOption = None,
    layer: LayerOption = None,
    standing: StandingOption = None,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
    view: ViewOption = False,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Do all of it in one go, in about two minutes: stand on the arena's near edge, and look across it and down."""
    output = Output(quiet, as_json)
    steps = registered_steps(
        font, size=arena_size(size, scenario, layer), standing=standing, path=profile_path(profile)
    )
    opening = replace(
        opening_of(profile, "calibrate-all", record, server_allowed=server_allowed), say=output.instruction
    )
    ask = partial(typer.confirm, err=as_json)
    with calibrating("all", opening, is_viewed=view, ask=ask, yes=yes) as opened:
        shown = Lines(output.note, opened.publisher)
        whole = calibrate_every_step(profile, opened.context_of, partial(_examined, font), steps, shown)
    left_out = [TITLES.get(name, name) for name in whole.run.skipped]
    without = f", without: {', '.join(left_out)}" if left_out else ""
    said: list[str] = []
    report: Path | None = report_path(whole.path)
    try:
        write_report(profile, report, said.append)
    except ProfileError as error:
        report, said = None, [f"warning: no report: {error}"]
    results = [{"step": own.step, "lines": own.lines, "samples": own.samples} for own in whole.run.results]
    found = Calibrated(whole.path, round(shown.seconds, 1), results, whole.run.skipped, report)
    output.result(found, f"calibrated in {shown.seconds:.0f} s{without}", f"profile: {whole.path}", *said)


for step in (font, arena, walk, clicks):
    app.command()(step)


@app.command()
def report(
    profile: ProfileOption = DEFAULT_PROFILE,
    out: Annotated[
        Path | None, typer.Option(metavar="FILE", help="the HTML file", show_default="beside the profile")
    ] = None,
    no_images: Annotated[bool, typer.Option("--no-images", help="leave the pictures out")] = False,
) -> None:
    """Make one HTML file of a profile and of what its calibration saw; the file lists what is in it."""
    write_report(profile, out, typer.echo, with_pictures=not no_images)


@app.command()
def undo(profile: ProfileToWrite = DEFAULT_PROFILE) -> None:
    """Put the profile back as it was before the last calibration; a second time undoes that."""
    path = profile_path(profile)
    broken = undo_profile(path)
    typer.echo(f"{path} is as it was before")
    if broken:
        typer.echo(f"what stood there is no profile that can be read: it is kept in {broken}")


class Lines:
    """The run as lines: each step's name when it begins, what it found, and how long that took."""

    def __init__(self, say: Callable[[str], None], publisher: Publisher) -> None:
        self.seconds = 0.0
        self._say = say
        self._publisher = publisher

    def doctor_done(self, checks: Sequence[Check]) -> None:
        """Say how many of the doctor's rows have each status, and name the rows where something is to be done."""
        counts = [(status, sum(check.status == status for check in checks)) for status in ("pass", "warn", "fail")]
        self._say(f"doctor: {', '.join(f'{count} {status}' for status, count in counts if count)}")
        for check in checks:
            if check.status in ("warn", "fail"):
                self._say(f"    {check.status}: {check.name}: {check.detail}{f'; {check.fix}' if check.fix else ''}")

    def begin(self, name: str, number: int, of: int) -> None:
        """Wait while somebody wants a pause, then show the step's name and number."""
        self._publisher.wait_while_paused()
        self._publisher.board.does(f"step {number} of {of}: {TITLES.get(name, name)}")
        self._say(f"{number}/{of} {TITLES.get(name, name)}")

    def end(self, result: StepResult, seconds: float) -> None:
        """Say what the step found."""
        self.seconds += seconds
        for line in result.lines:
            self._say(f"    {line}")
        self._say(f"    [{seconds:.0f} s, {self.seconds:.0f} s in all]")

    def skip(self, reason: str, seconds: float) -> None:
        """Say why the step is left out."""
        self.seconds += seconds
        self._say(f"    warning: {reason}; the run goes on without it")


def _examined(font: Path | None, profile_name: str) -> Sequence[Check]:
    say = partial(typer.echo, err=True)
    return examine(profile_name, say=say, system=System.here(), clipboard=open_clipboard(), font=font).checks
