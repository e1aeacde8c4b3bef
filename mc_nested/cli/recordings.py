"""``mc-nested recordings``: the recordings of live runs: list, verify, trim and cut them."""

import datetime
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Annotated, Literal

import typer
from rich.table import Column, Table

from calibration.report.privacy import names_here
from mc_nested.atomic_file import whole_folder
from mc_nested.cli.options import is_alone
from mc_nested.cli.output import JsonOption, Output, prints
from mc_nested.errors import RecordingError
from mc_nested.live.recording.cut import cut, trim
from mc_nested.live.recording.frames import played_in
from mc_nested.live.recording.recording_file import Overview, overview_of
from mc_nested.live.recording.run_recorder import is_recording, kept_recordings, recordings_folder

app = typer.Typer()

RecordingArgument = Annotated[
    Path, typer.Argument(metavar="REC", help="a recording: its name in mc-nested recordings, its folder or its file")
]

WHOLE = "whole"
"""The state of a recording of which nothing is lost."""

DAMAGED = 1
"""The exit code of verify where something of it is lost."""


@dataclass(frozen=True)
class RecordingFound:
    """What ``recordings verify`` prints."""

    recording: Annotated[Path, "its folder or file"]
    what: Annotated[str | None, "what was recorded, as build-house"] = None
    version: Annotated[str | None, "of mc-nested that wrote it"] = None
    began: Annotated[datetime.datetime | None, "local time"] = None
    seconds: Annotated[float | None, "its length"] = None
    calls: Annotated[int | None, "of devices, screen and journal"] = None
    actions: Annotated[int | None, "in it"] = None
    pictures: Annotated[int | None, "in it"] = None
    size: Annotated[int | None, "bytes of all its files"] = None
    damage: Annotated[Sequence[str], "what of it is lost"] = ()

    @classmethod
    def of(cls, path: Path, seen: Overview) -> "RecordingFound":
        """Return a summary of a recording."""
        began = None if seen.began is None else datetime.datetime.fromtimestamp(seen.began / 1e9)
        facts = (seen.what, seen.version, began, seen.seconds, seen.calls, seen.actions, seen.pictures, seen.size)
        return cls(path, *facts, seen.damage)


@dataclass(frozen=True)
class RecordingList:
    """What ``recordings list`` prints."""

    folder: Annotated[Path, "where they are kept"]
    recordings: Annotated[Sequence[RecordingFound], "for each, the fields of recordings verify"]


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
@prints(RecordingFound)
def verify(recording: RecordingArgument, as_json: JsonOption = False) -> None:
    """Read a recording as a whole, and say whether anything of it is lost: exit code 0 if all is there, 1 if not."""
    path = recording_path(recording)
    seen = overview_of(path)
    Output(as_json=as_json).result(
        RecordingFound.of(path, seen),
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
        float | None, typer.Option("--to", min=0, help="seconds from its beginning", show_default="its end")
    ] = None,
    no_pictures: Annotated[bool, typer.Option("--no-pictures", help="leave the window's pictures out")] = False,
) -> None:
    """Write a part of a recording as one file, without names, from a reset on; in tests/recordings/ it is a test."""
    path = recording_path(recording)
    if out.exists():
        raise RecordingError(f"{out}: is there already: name a new file")
    seen = overview_of(path)
    if seen.began is None or seen.ended is None:
        raise RecordingError(f"{path}: holds nothing that could be cut out")
    end = seen.ended if last is None else seen.began + round(last * 1e9)
    begin, clean = seen.began + round(first * 1e9), names_here().removed_from
    calls = cut(path, out, begin, end, clean, with_pictures=not no_pictures)
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
    with whole_folder(out, RecordingError) as folder:
        try:
            if form == "minari":
                from mc_nested.report.minari_dataset import write_minari as write
            else:
                from mc_nested.report.lerobot_dataset import write_lerobot

                write = partial(write_lerobot, fps=fps)
        except ImportError as error:
            install = "pip install -c constraints.txt -e '.[share]'"
            raise RecordingError(f"--format {form} needs {error.name}: {install}") from None
        what = write(folder, found)
    for played in found:
        actions = [f"{played.left_out} actions"] if played.left_out else []
        if missing := [*actions, *played.damage]:
            typer.echo(f"{played.path}: left out: {'; '.join(missing)}", err=True)
    episodes = [each for played in found for each in played.episodes]
    typer.echo(f"{out}: {what}, {len(episodes):,} episodes, {sum(len(each.steps) for each in episodes):,} actions")


def _found(path: Path) -> RecordingFound:
    """Return a summary of a recording; of one that can't be read, only what is wrong with it."""
    try:
        return RecordingFound.of(path, overview_of(path))
    except RecordingError as error:
        return RecordingFound(path, damage=(str(error).split(": ", 1)[-1],))


def _row(found: RecordingFound) -> tuple[str, ...]:
    if found.what is None or found.size is None:
        return "", "", "", "", ""
    began = "" if found.began is None else f"{found.began:%Y-%m-%d %H:%M:%S}"
    return found.what, began, f"{found.seconds:.0f} s", str(found.actions), f"{found.size / 1e6:.1f} MB"


def _state(seen: Overview) -> str:
    return f"{seen.seconds:.0f} s, {seen.size / 1e6:.1f} MB, {'; '.join(seen.damage) or WHOLE}"


def recording_path(named: Path) -> Path:
    """Return the recording of that name, or at that path; raise RecordingError if there is none."""
    for path in (named, recordings_folder() / named):
        if path.exists():
            return path
    known = ", ".join(path.name for path in kept_recordings()[-3:]) or "none yet"
    raise RecordingError(f"no recording {str(named)!r}: the last ones kept are: {known}")


def last_recording() -> Path:
    """Return the newest recording that is kept; raise RecordingError if there is none."""
    kept = [path for path in kept_recordings() if is_recording(path)]
    if not kept:
        raise RecordingError("no recording is kept yet: play, train or calibrate in a running game first")
    return kept[-1]
