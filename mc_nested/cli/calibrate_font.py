"""``mc-nested calibrate font``: finds the game's own font, and shows what it reads beside the screen."""

from pathlib import Path
from typing import Annotated

import typer

from calibration.font.find import calibrate_font
from mc_nested.cli.calibrating import calibrating
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite
from mc_nested.cli.recording_options import RecordOption
from mc_nested.cli.viewing import StepViewOption


def font(
    profile: ProfileToWrite = DEFAULT_PROFILE,
    font: Annotated[
        Path | None, typer.Option(metavar="JAR|PNG", help="take this client jar, resource pack or ascii.png")
    ] = None,
    record: RecordOption = None,
    view: StepViewOption = False,
) -> None:
    """Find the font that your game is written in, and see what is read with it."""
    with calibrating("font", profile, is_viewed=view, record=record) as opened:
        found, picture = calibrate_font(profile, opened.context_of, font)
    for line in found.lines:
        typer.echo(line)
    typer.echo(f"compare what is seen with what is read: {picture}")
