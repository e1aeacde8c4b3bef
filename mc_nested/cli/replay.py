"""``mc-nested replay``: today's reader and body on a recording, and where they would do otherwise."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer
from rich.console import RenderableType
from rich.table import Column, Table

from calibration.font.sources import font_of_recording
from calibration.installation.folders import System
from mc_nested.atomic_file import atomic_write
from mc_nested.cli.output import JsonOption, Output, prints
from mc_nested.cli.recordings import RecordingArgument, recording_path
from mc_nested.live.menus.click_points import picture_bytes
from mc_nested.live.recording.replayed_run import Replayed
from mc_nested.live.recording.replayed_run import replay as replayed
from mc_nested.live.vision.font import load_font

DIFFERENT = 1
"""The exit code if anything is read or decided otherwise."""

MOST_ROWS, MOST_PICTURES = 40, 40


@dataclass(frozen=True)
class ReplayFound:
    """What ``replay`` prints."""

    actions: Annotated[int, "in the recording"]
    followed: Annotated[int, "to their end"]
    readings: Annotated[int, "in the recording"]
    read_anew: Annotated[int, "whose picture was kept"]
    damaged: Annotated[Sequence[str], "what of the recording is lost"]
    differences: Annotated[Sequence[object], "of each: the action, what differs, then and now"]
    font: Annotated[Path, "what it was read with"]


@prints(ReplayFound)
def replay(
    recording: RecordingArgument,
    font: Annotated[
        Path | None,
        typer.Option(
            metavar="JAR|PNG",
            help="the game's font",
            show_default="its profile's, or that of a game on this computer",
        ),
    ] = None,
    pictures: Annotated[
        Path | None, typer.Option(metavar="DIR", help="write what is read otherwise as pictures")
    ] = None,
    as_json: JsonOption = False,
) -> None:
    """Read and decide again what a recording holds: exit code 0 if all is as it was, 1 if anything differs."""
    path = recording_path(recording)
    used = font or font_of_recording(path, System.here())
    seen = replayed(path, load_font(used))
    if pictures is not None:
        _write_pictures(seen, pictures)
    differences = [
        {"action": each.action, "what": each.kind, "then": each.then, "now": each.now} for each in seen.differences
    ]
    found = ReplayFound(seen.actions, seen.followed, seen.readings, seen.read_anew, seen.damaged, differences, used)
    Output(as_json=as_json).result(found, *_lines(seen, used, pictures))
    if seen.differences:
        raise typer.Exit(DIFFERENT)


def _lines(seen: Replayed, font: Path, pictures: Path | None) -> Iterator[RenderableType]:
    if seen.differences:
        heads = (Column(head, overflow="fold") for head in ("action", "what", "then", "now"))
        table = Table(*heads, show_edge=False, pad_edge=False)
        for each in seen.differences[:MOST_ROWS]:
            table.add_row(str(each.action), each.kind, each.then, each.now)
        yield table
        if len(seen.differences) > MOST_ROWS:
            yield f"and {len(seen.differences) - MOST_ROWS} more"
    yield from seen.damaged
    not_kept = seen.readings - seen.read_anew
    parts = [
        f"{seen.followed} of {seen.actions} actions followed to their end",
        f"{seen.read_anew} readings taken anew" + (f", {not_kept} of pictures that were not kept" if not_kept else ""),
        f"{len(seen.differences)} differences",
        *([f"pictures in {pictures}"] if pictures else []),
    ]
    yield "; ".join(parts)
    yield f"read with the font {font}"


def _write_pictures(seen: Replayed, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    shown = [(each.action, each.picture) for each in seen.differences if each.picture is not None][:MOST_PICTURES]
    for number, (action, picture) in enumerate(shown, 1):
        file = folder / f"{number:03d}-action-{action}.png"
        with atomic_write(file) as unfinished:
            unfinished.write_bytes(picture_bytes(picture))
