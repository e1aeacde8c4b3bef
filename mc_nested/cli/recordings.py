"""``mc-nested recordings``: the recordings of live runs: list, verify, trim and cut them."""

import datetime
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console
from rich.table import Table

from calibration.report.privacy import names_here
from mc_nested.cli.recording_options import RecordingArgument, recording_path
from mc_nested.errors import RecordingError
from mc_nested.live.recording.cut import cut, trim
from mc_nested.live.recording.opened import kept_recordings, recordings_folder
from mc_nested.live.recording.overview import Overview, overview_of

app = typer.Typer(help="The recordings of live runs: list, verify, trim and cut them.")

LINE_WIDTH = 120


@app.callback(invoke_without_command=True)
def listed(context: typer.Context) -> None:
    """List the recordings that are kept, the newest last."""
    if context.invoked_subcommand is not None:
        return
    table = Table(show_edge=False, pad_edge=False)
    for name in ("recording", "of", "began", "lasts", "actions", "size", "state"):
        table.add_column(name, overflow="fold")
    for path in kept_recordings():
        table.add_row(path.name, *_row(path))
    console = Console()
    console = Console(width=console.width if console.is_terminal else LINE_WIDTH)
    if table.row_count:
        console.print(table)
    console.print(f"{table.row_count} recordings in {recordings_folder()}", soft_wrap=True)


@app.command()
def verify(recording: RecordingArgument) -> None:
    """Read a recording as a whole, and say whether anything of it is lost."""
    path = recording_path(recording)
    seen = overview_of(path)
    typer.echo(f"{path}: {seen.calls:,} calls, {seen.actions:,} actions, {seen.pictures:,} pictures, {_state(seen)}")


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


def _row(path: Path) -> tuple[str, ...]:
    try:
        seen = overview_of(path)
    except RecordingError as error:
        return "", "", "", "", "", str(error).split(": ", 1)[-1]
    began = "" if seen.began is None else f"{datetime.datetime.fromtimestamp(seen.began / 1e9):%Y-%m-%d %H:%M:%S}"
    return (
        seen.what,
        began,
        f"{seen.seconds:.0f} s",
        str(seen.actions),
        f"{seen.size / 1e6:.1f} MB",
        "; ".join(seen.damage) or "whole",
    )


def _state(seen: Overview) -> str:
    whole = "; ".join(seen.damage) or "whole"
    return f"{seen.seconds:.0f} s, {seen.size / 1e6:.1f} MB, {whole}"
