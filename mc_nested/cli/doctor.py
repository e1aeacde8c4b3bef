"""``mc-nested doctor``: what keeps an agent from playing here, what a picture says, and a report for others."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.constrain import Constrain
from rich.table import Table
from rich.text import Text

from calibration.bug_report import RECORDING, write_bug_report
from calibration.doctor.check import Check, Status
from calibration.doctor.examination import Examination, examine
from calibration.doctor.repair import repair
from calibration.installation.folders import System
from calibration.report.privacy import names_here
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileOption, is_alone
from mc_nested.cli.output import JsonOption, Output, prints
from mc_nested.cli.recordings import last_recording, recording_path
from mc_nested.errors import FontError, PictureError, RecordingError
from mc_nested.live.connection import overlay_of
from mc_nested.live.desktop import this_system
from mc_nested.live.model.debug_entries import GROUND_PITCH_DEG, switch_on
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.live.recording.run_recorder import kept_recordings
from mc_nested.live.vision.font import load_font
from mc_nested.live.vision.read_pictures import PictureReading, read_picture

STYLES: dict[Status, str] = {"pass": "green", "warn": "yellow", "fail": "bold red", "skip": "bright_black"}

WIDTH = 100
"""The table's width in columns; less in a narrower terminal."""

FAILED = 1
"""The exit code if a row fails."""

app = typer.Typer()


@dataclass(frozen=True)
class Examined:
    """What ``doctor`` prints."""

    checks: Annotated[Sequence[Check], "of each: name, status (pass, warn, fail or skip), detail, and the fix"]


@app.callback(invoke_without_command=True)
@prints(Examined)
def doctor(
    context: typer.Context,
    profile: ProfileOption = DEFAULT_PROFILE,
    as_json: JsonOption = False,
    fix: Annotated[
        bool,
        typer.Option("--fix", help="mend options.txt and debug-profile.json, with backups; the game must be closed"),
    ] = False,
) -> None:
    """Look at this computer, the game's window and its options: each row with the one thing to do."""
    if not is_alone(context):
        return
    found = examined(profile)
    if fix and repair(found, partial(typer.echo, err=True)):
        found = examined(profile)
    table = Constrain(table_of(found.checks), WIDTH)
    counts = {status: sum(check.status == status for check in found.checks) for status in STYLES}
    summary = ", ".join(f"{count} {status}" for status, count in counts.items() if count)
    Output(as_json=as_json).result(Examined(found.checks), table, summary)
    if any(check.status == "fail" for check in found.checks):
        raise typer.Exit(FAILED)


@app.command("bug-report")
def bug_report(
    out: Annotated[Path, typer.Option(metavar="FILE", help="the file to write")] = Path("mc-nested-report.zip"),
    profile: ProfileOption = DEFAULT_PROFILE,
    recording: Annotated[
        Path | None, typer.Option(metavar="REC", help="which recording", show_default="the last one")
    ] = None,
    no_recording: Annotated[bool, typer.Option("--no-recording", help="leave the recording out")] = False,
    minutes: Annotated[float, typer.Option(min=0.1, help="how much of the recording's end")] = 5.0,
) -> None:
    """Put the doctor's table, the profile, versions and a recording's end into one file, and say what is in it."""
    if out.exists():
        raise RecordingError(f"{out}: is there already: name a new file with --out FILE")
    kept = {}
    if not no_recording and (recording is not None or kept_recordings()):
        kept[RECORDING] = last_recording() if recording is None else recording_path(recording)
    checks = examined(profile).checks
    path = profile_path(profile)
    text = path.read_text("utf-8-sig") if path.is_file() else None
    said = write_bug_report(out, checks, text, kept, minutes * 60, names_here())
    typer.echo(f"{out} holds:")
    for line in said:
        typer.echo(f"  {line}")
    typer.echo("Names of accounts and home folders are taken out. Look through it before you share it.")


@app.command()
@prints(PictureReading)
def read(
    images: Annotated[list[Path], typer.Argument(metavar="IMAGE...", help="screenshots with the debug screen on")],
    font: Annotated[
        Path | None, typer.Option(metavar="PNG|JAR", help="the game's ascii.png, client jar or a resource pack")
    ] = None,
    profile: Annotated[
        str | None, typer.Option(metavar="NAME|FILE", help="take font and overlay from a profile")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Read pictures of the debug screen: position, view and the block looked at; with --json a line a picture.

    A file that is no picture ends it with exit code 2, once the others are read.
    """
    output = Output(as_json=as_json)
    known = load_profile(profile) if profile else None
    if font is None:
        if known is None:
            raise FontError(
                "name the game's font: --font with its client jar or ascii.png, or --profile with one that has it"
            )
        font = known.screen.font_path()
    glyphs = load_font(font.expanduser())
    overlay = overlay_of(known) if known else None
    unusable: list[PictureError] = []
    for image in images:
        try:
            found = read_picture(image, glyphs, overlay)
        except PictureError as error:
            unusable.append(error)
            continue
        output.result(found, _line(found))
    if unusable:
        count = len(unusable) - 1
        others = f"; {count} other file{'s' if count > 1 else ''} can't be read either" if count else ""
        raise PictureError(f"{unusable[0]}{others}")


def _line(found: PictureReading) -> str:
    if found.xyz is None or found.pitch is None:
        return f"{found.file}: unread: {found.problem}"
    position = " ".join(f"{value:.3f}" for value in found.xyz)
    target = found.target
    target_block = f"looks at {target.id} {target.pos and list(target.pos)}" if target else "looks at no block"
    if target is None and found.pitch >= GROUND_PITCH_DEG:
        target_block += f": if the ground is in view, that line is off: {switch_on(None)}"
    return f"{found.file}: at {position}, yaw {found.yaw}, pitch {found.pitch}, {target_block}"


def table_of(checks: Sequence[Check]) -> Table:
    """Return the rows as a table, with coloured statuses."""
    table = Table(show_edge=False, pad_edge=False)
    for name, ratio in (("check", None), ("", None), ("found", 5), ("to do", 4)):
        table.add_column(name, ratio=ratio, no_wrap=ratio is None, overflow="fold")
    for check in checks:
        table.add_row(check.name, Text(check.status, STYLES[check.status]), Text(check.detail), Text(check.fix))
    return table


def examined(profile: str, font: Path | None = None) -> Examination:
    """Examine this computer and its game, read with that font, or one that is found."""
    say = partial(typer.echo, err=True)
    return examine(profile, say=say, system=System.here(), clipboard=this_system().open_clipboard(), font=font)
