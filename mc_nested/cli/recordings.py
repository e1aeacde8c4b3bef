"""``mc-nested recordings``: the recordings of live runs: list, verify, trim and cut them."""

import datetime
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from calibration.report.privacy import names_here
from mc_nested.cli.json_fields import epilog_of
from mc_nested.cli.output import JsonOption, Output
from mc_nested.cli.recording_options import RecordingArgument, recording_path
from mc_nested.errors import RecordingError, UserError
from mc_nested.live.recording.cut import cut, trim
from mc_nested.live.recording.recording_file import Overview, overview_of
from mc_nested.live.recording.run_recorder import kept_recordings, recordings_folder

app = typer.Typer(help="The recordings of live runs: list, verify, trim and cut them.")

WHOLE = "whole"
"""The state of a recording of which nothing is lost."""

DAMAGED = 1
"""The exit code of verify where something of it is lost."""


@app.callback(invoke_without_command=True)
def recordings(context: typer.Context, as_json: JsonOption = False) -> None:
    """List the recordings that are kept; verify, trim and cut them."""
    if context.invoked_subcommand is None:
        list_recordings(as_json)
    elif as_json:
        raise UserError("write --json at the end, behind list or verify: the others have none")


@app.command("list", epilog=epilog_of("recordings list"))
def list_recordings(as_json: JsonOption = False) -> None:
    """List the recordings that are kept, the newest last."""
    found = [(path, *_seen(path)) for path in kept_recordings()]
    table = Table(show_edge=False, pad_edge=False)
    for name in ("recording", "of", "began", "lasts", "actions", "size", "state"):
        table.add_column(name, overflow="fold")
    for path, seen, damage in found:
        table.add_row(path.name, *_row(seen), "; ".join(damage) or WHOLE)
    Output(as_json=as_json).result(
        {
            "folder": recordings_folder(),
            "recordings": [{"recording": path, **_fields(seen), "damage": damage} for path, seen, damage in found],
        },
        *([table] if found else []),
        f"{'1 recording' if len(found) == 1 else f'{len(found)} recordings'} in {recordings_folder()}",
    )


@app.command(epilog=epilog_of("recordings verify"))
def verify(recording: RecordingArgument, as_json: JsonOption = False) -> None:
    """Read a recording as a whole, and say whether anything of it is lost: exit code 0 if all is there, 1 if not."""
    path = recording_path(recording)
    seen = overview_of(path)
    Output(as_json=as_json).result(
        {"recording": path, **_fields(seen), "damage": seen.damage},
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
    last: Annotated[float | None, typer.Option("--to", min=0, help="seconds from its beginning [its end]")] = None,
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


def _seen(path: Path) -> tuple[Overview | None, tuple[str, ...]]:
    """A recording at a glance, and what is wrong with it; None where it can't be read."""
    try:
        seen = overview_of(path)
    except RecordingError as error:
        return None, (str(error).split(": ", 1)[-1],)
    return seen, seen.damage


def _row(seen: Overview | None) -> tuple[str, ...]:
    if seen is None:
        return "", "", "", "", ""
    began = "" if seen.began is None else f"{_local(seen.began):%Y-%m-%d %H:%M:%S}"
    return seen.what, began, f"{seen.seconds:.0f} s", str(seen.actions), f"{seen.size / 1e6:.1f} MB"


def _fields(seen: Overview | None) -> dict[str, Any]:
    if seen is None:
        return dict.fromkeys(("what", "version", "began", "seconds", "calls", "actions", "pictures", "size"))
    return {
        "what": seen.what,
        "version": seen.version,
        "began": None if seen.began is None else _local(seen.began).isoformat(timespec="seconds"),
        "seconds": seen.seconds,
        "calls": seen.calls,
        "actions": seen.actions,
        "pictures": seen.pictures,
        "size": seen.size,
    }


def _local(time_ns: int) -> datetime.datetime:
    return datetime.datetime.fromtimestamp(time_ns / 1e9)


def _state(seen: Overview) -> str:
    return f"{seen.seconds:.0f} s, {seen.size / 1e6:.1f} MB, {'; '.join(seen.damage) or WHOLE}"
