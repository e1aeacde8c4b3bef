"""``mc-nested calibrate font``: finds the game's own font, and shows what it reads beside the screen."""

from pathlib import Path
from typing import Annotated

import typer

from calibration.font.find import calibrate_font
from calibration.open_context import context_opener
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite
from mc_nested.cli.recording_options import RecordOption, live_recorder


def font(
    profile: ProfileToWrite = DEFAULT_PROFILE,
    font: Annotated[
        Path | None, typer.Option(metavar="JAR|PNG", help="take this client jar, resource pack or ascii.png")
    ] = None,
    record: RecordOption = None,
) -> None:
    """Find the font that your game is written in, and see what is read with it."""
    context_of = context_opener(typer.echo, typer.confirm, open_recorder=live_recorder(record, "calibrate-font"))
    found, picture = calibrate_font(profile, context_of, font)
    for line in found.lines:
        typer.echo(line)
    typer.echo(f"compare what is seen with what is read: {picture}")
