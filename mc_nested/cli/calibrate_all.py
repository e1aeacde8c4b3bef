"""``mc-nested calibrate all``: the guided run through every calibration, its profile, and the report beside it."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from calibration.calibrate_all import calibrate_all
from calibration.context import StepResult
from calibration.doctor.check import Check
from calibration.doctor.examination import examine
from calibration.installation.folders import System
from calibration.registry import registered_steps
from calibration.report.page import TITLES
from mc_nested.cli.arena_options import ForScenarioOption, SizeOption, StandingOption, arena_size
from mc_nested.cli.calibrate_report import report_path, write_report
from mc_nested.cli.calibrating import calibrating
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite, ServerOption
from mc_nested.cli.output import JsonOption, Output, QuietOption
from mc_nested.cli.recording_options import RecordOption
from mc_nested.cli.scenario_options import LayerOption
from mc_nested.cli.viewing import ViewOption
from mc_nested.errors import ProfileError
from mc_nested.live.desktop import open_clipboard
from mc_nested.live.profile.store import profile_path
from mc_nested.view.publisher import Publisher


def calibrate(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    profile: ProfileToWrite = DEFAULT_PROFILE,
    yes: Annotated[bool, typer.Option("--yes", help="ask nothing: clear the arena's region, visit the title")] = False,
    font: Annotated[
        Path | None, typer.Option(metavar="JAR|PNG", help="take this client jar, resource pack or ascii.png")
    ] = None,
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
    with calibrating(
        "all",
        profile,
        is_viewed=view,
        record=record,
        server_allowed=server_allowed,
        say=output.instruction,
        ask=partial(typer.confirm, err=as_json),
        yes=yes,
    ) as opened:
        shown = Lines(output.note, opened.publisher)
        whole = calibrate_all(profile, opened.context_of, partial(_examined, font), steps, shown)
    left_out = [TITLES.get(name, name) for name in whole.run.skipped]
    without = f", without: {', '.join(left_out)}" if left_out else ""
    said: list[str] = []
    report: Path | None = report_path(whole.path)
    try:
        write_report(profile, report_path(whole.path), say=said.append)
    except ProfileError as error:
        report, said = None, [f"warning: no report: {error}"]
    found = {
        "profile": whole.path,
        "seconds": round(shown.seconds, 1),
        "steps": [{"step": own.step, "lines": own.lines, "samples": own.samples} for own in whole.run.results],
        "left_out": whole.run.skipped,
        "report": report,
    }
    output.result(found, f"calibrated in {shown.seconds:.0f} s{without}", f"profile: {whole.path}", *said)


class Lines:
    """The run as lines: each step's name when it begins, what it found, and how long that took."""

    def __init__(self, say: Callable[[str], None], publisher: Publisher) -> None:
        self.seconds = 0.0
        self._say = say
        self._publisher = publisher

    def doctor_done(self, checks: Sequence[Check]) -> None:
        """How many of the doctor's rows have each status, and the rows where something is to be done."""
        counts = [(status, sum(check.status == status for check in checks)) for status in ("pass", "warn", "fail")]
        self._say(f"doctor: {', '.join(f'{count} {status}' for status, count in counts if count)}")
        for check in checks:
            if check.status in ("warn", "fail"):
                self._say(f"    {check.status}: {check.name}: {check.detail}{f'; {check.fix}' if check.fix else ''}")

    def begin(self, name: str, number: int, of: int) -> None:
        """Its name and number, once nobody wants a pause any more."""
        self._publisher.wait_while_paused()
        self._publisher.board.does(f"step {number} of {of}: {TITLES.get(name, name)}")
        self._say(f"{number}/{of} {TITLES.get(name, name)}")

    def end(self, result: StepResult, seconds: float) -> None:
        """Its findings."""
        self._took(seconds)
        for line in result.lines:
            self._say(f"    {line}")
        self._say(f"    [{seconds:.0f} s, {self.seconds:.0f} s in all]")

    def skip(self, reason: str, seconds: float) -> None:
        """Why it isn't there."""
        self._took(seconds)
        self._say(f"    warning: {reason}; the run goes on without it")

    def _took(self, seconds: float) -> None:
        self.seconds += seconds


def _examined(font: Path | None, profile_name: str) -> Sequence[Check]:
    say = partial(typer.echo, err=True)
    return examine(profile_name, say=say, system=System.here(), clipboard=open_clipboard(), font=font).checks
