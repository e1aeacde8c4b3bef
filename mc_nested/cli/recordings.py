"""``mc-nested recordings``: the recordings of live runs: list, verify, trim and cut them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import typer
from rich.table import Column, Table

from calibration.report.privacy import names_here
from mc_nested.atomic_file import whole_folder
from mc_nested.cli.options import is_alone
from mc_nested.cli.output import JsonOption, Output, prints
from mc_nested.errors import RecordingError, with_extra
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.live.recording.cut import cut, trim
from mc_nested.live.recording.demonstrations import played_in
from mc_nested.live.recording.recording_file import Overview, overview_of
from mc_nested.live.recording.run_recorder import kept_recordings, recordings_folder

app = typer.Typer()

RecordingArgument = Annotated[
    Path, typer.Argument(metavar="REC", help="a recording: its name in mc-nested recordings, its folder or its file")
]

WHOLE = "whole"
"""The state of a recording of which nothing is lost."""

DAMAGED = 1
"""The exit code of verify where something of it is lost."""


@dataclass(frozen=True)
class RecordingList:
    """What ``recordings list`` prints."""

    folder: Annotated[Path, "where they are kept"]
    recordings: Annotated[Sequence[Overview], "for each, the fields of recordings verify"]


@app.callback(invoke_without_command=True)
def recordings(context: typer.Context, as_json: JsonOption = False) -> None:
    """List the recordings that are kept; verify, trim and cut them."""
    if is_alone(context):
        list_recordings(as_json)


@app.command("list")
@prints(RecordingList)
def list_recordings(as_json: JsonOption = False) -> None:
    """List the recordings that are kept, the newest last."""
    found = [_found(path) for path in kept_recordings()]
    heads = ("recording", "of", "began", "lasts", "actions", "size", "state")
    table = Table(*(Column(head, overflow="fold") for head in heads), show_edge=False, pad_edge=False)
    for each in found:
        table.add_row(each.recording.name, *_row(each), "; ".join(each.damage) or WHOLE)
    Output(as_json=as_json).result(
        RecordingList(recordings_folder(), found),
        *([table] if found else []),
        f"{'1 recording' if len(found) == 1 else f'{len(found)} recordings'} in {recordings_folder()}",
    )


@app.command()
@prints(Overview)
def verify(recording: RecordingArgument, as_json: JsonOption = False) -> None:
    """Read a recording as a whole, and say whether anything of it is lost: exit code 0 if all is there, 1 if not."""
    path = recording_path(recording)
    seen = overview_of(path)
    Output(as_json=as_json).result(
        seen,
        f"{path}: {seen.calls:,} calls, {seen.actions:,} actions, {seen.pictures:,} pictures, {_state(seen)}",
    )
    if seen.damage:
        raise typer.Exit(DAMAGED)


@app.command("trim")
def trim_to(
    recording: RecordingArgument,
    last: Annotated[float, typer.Option(min=1, metavar="SECONDS", help="how much of its end is kept")],
) -> None:
    """Keep a recording's end alone; what came before is deleted."""
    path = recording_path(recording)
    trim(path, last)
    typer.echo(f"{path}: {_state(overview_of(path))}")


@app.command("cut")
def cut_out(
    recording: RecordingArgument,
    out: Annotated[Path, typer.Argument(metavar="FILE", help="a new file, as part.mcap")],
    first: Annotated[float, typer.Option("--from", min=0, help="seconds from its beginning")] = 0.0,
    last: Annotated[
        float, typer.Option("--to", min=0, help="seconds from its beginning", show_default="its end")
    ] = math.inf,
    no_pictures: Annotated[bool, typer.Option("--no-pictures", help="leave the window's pictures out")] = False,
) -> None:
    """Write a part of a recording as one file, without names, from a reset on; in tests/recordings/ it is a test."""
    path = recording_path(recording)
    if out.exists():
        raise RecordingError(f"{out}: is there already: name a new file")
    calls = cut(path, out, first, last, names_here().removed_from, with_pictures=not no_pictures)
    typer.echo(f"{out}: {calls:,} calls, {_state(overview_of(out))}")


@app.command()
def export(
    recordings: Annotated[list[Path], typer.Argument(metavar="REC...", help="recordings, each as for verify")],
    form: Annotated[
        Literal["lerobot", "minari"], typer.Option("--format", help="frames and video, or the Env's transitions")
    ],
    out: Annotated[Path, typer.Option(metavar="FOLDER", help="a new folder")],
    fps: Annotated[int, typer.Option(min=1, max=60, help="frames a second, of lerobot")] = 20,
) -> None:
    """Write what was played in recordings as a dataset that others can learn from, the chat blanked."""
    found = [played_in(recording_path(each)) for each in recordings]
    with signals_as_exit(), whole_folder(out, RecordingError) as folder:
        try:
            if form == "minari":
                from mc_nested.report.minari_dataset import write_minari

                what = write_minari(folder, found)
            else:
                from mc_nested.report.lerobot_dataset import write_lerobot

                what = write_lerobot(folder, found, fps)
        except ImportError as error:
            raise RecordingError(f"--format {form} needs {error.name}: {with_extra('share')}") from None
    for played in found:
        actions = [f"{played.left_out} actions"] if played.left_out else []
        if missing := [*actions, *played.damage]:
            typer.echo(f"{played.path}: left out: {'; '.join(missing)}", err=True)
    episodes = [each for played in found for each in played.episodes]
    typer.echo(f"{out}: {what}, {len(episodes):,} episodes, {sum(len(each.steps) for each in episodes):,} actions")


def _found(path: Path) -> Overview:
    try:
        return overview_of(path)
    except RecordingError as error:
        return Overview(path, damage=(str(error).split(": ", 1)[-1],))


def _row(found: Overview) -> tuple[str, str, str, str, str]:
    if found.what is None or found.size is None:
        return "", "", "", "", ""
    began = "" if found.began is None else f"{found.began:%Y-%m-%d %H:%M:%S}"
    return found.what, began, f"{found.seconds:.0f} s", str(found.actions), f"{found.size / 1e6:.1f} MB"


def _state(seen: Overview) -> str:
    _, _, lasts, _, size = _row(seen)
    return f"{lasts}, {size}, {'; '.join(seen.damage) or WHOLE}"


def recording_path(named: Path) -> Path:
    """Return the recording of that name, or at that path; raise RecordingError if there is none."""
    for path in (named, recordings_folder() / named):
        if path.exists():
            return path
    known = ", ".join(path.name for path in kept_recordings()[-3:]) or "none yet"
    raise RecordingError(f"no recording {str(named)!r}: the last ones kept are: {known}")


def last_recording() -> Path:
    """Return the newest recording that is kept; raise RecordingError if there is none."""
    kept = kept_recordings()
    if not kept:
        raise RecordingError("no recording is kept yet: play, train or calibrate in a running game first")
    return kept[-1]
