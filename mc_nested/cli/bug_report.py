"""``mc-nested bug-report``: what others need to see what went wrong, in one file, without names or chat."""

from functools import partial
from pathlib import Path
from typing import Annotated

import typer

from calibration.bug_report import write_bug_report
from calibration.doctor.examination import examine
from calibration.installation.folders import System
from calibration.report.privacy import names_here
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileOption
from mc_nested.cli.recording_options import last_recording, recording_path
from mc_nested.errors import RecordingError
from mc_nested.live.desktop import open_clipboard
from mc_nested.live.profile.store import profile_path
from mc_nested.live.recording.run_recorder import kept_recordings


def bug_report(
    out: Annotated[Path, typer.Option(metavar="FILE", help="the file to write")] = Path("mc-nested-report.zip"),
    profile: ProfileOption = None,
    recording: Annotated[Path | None, typer.Option(metavar="REC", help="which recording [the last one]")] = None,
    no_recording: Annotated[bool, typer.Option("--no-recording", help="leave the recording out")] = False,
    minutes: Annotated[float, typer.Option(min=0.1, help="how much of the recording's end")] = 5.0,
) -> None:
    """Put the doctor's table, the profile, versions and a recording's end into one file, and say what is in it."""
    if out.exists():
        raise RecordingError(f"{out}: is there already: name a new file with --out FILE")
    name = DEFAULT_PROFILE if profile is None else profile
    kept = None
    if not no_recording and (recording is not None or kept_recordings()):
        kept = last_recording() if recording is None else recording_path(recording)
    say = partial(typer.echo, err=True)
    checks = examine(name, say=say, system=System.here(), clipboard=open_clipboard()).checks
    path = profile_path(name)
    text = path.read_text("utf-8-sig") if path.is_file() else None
    said = write_bug_report(out, checks, text, kept, minutes * 60, names_here())
    typer.echo(f"{out} holds:")
    for line in said:
        typer.echo(f"  {line}")
    typer.echo("Names of accounts and home folders are taken out. Look through it before you share it.")
