"""``mc-nested calibrate``: tell the agent where your arena and your buttons are."""

from pathlib import Path
from typing import Annotated

import typer

from calibration.arena import NEAR_MIDDLE, calibrate_arena
from mc_nested.cli.calibrate_clicks import clicks
from mc_nested.cli.calibrate_font import font
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite
from mc_nested.live.profile import profile_path, undo_profile

app = typer.Typer(help="Tell the agent where your arena and your buttons are.")
app.command()(font)
app.command()(clicks)


@app.command()
def arena(
    profile: ProfileToWrite = DEFAULT_PROFILE,
    font: Annotated[
        Path | None, typer.Option(metavar="PNG|JAR", help="the game's client jar, needed the first time")
    ] = None,
    standing: Annotated[
        tuple[int, int], typer.Option(metavar="X Y", help="the cell you stand on; 7 0 is the middle of the near edge")
    ] = NEAR_MIDDLE,
    yes: Annotated[bool, typer.Option("--yes", help="mark the region without asking")] = False,
) -> None:
    """Mark the arena where you stand and look; only what is marked is ever cleared."""
    path = calibrate_arena(profile, ask=typer.confirm, say=typer.echo, standing=standing, font=font, yes=yes)
    typer.echo(f"arena written to {path}" if path else "nothing was written")


@app.command()
def undo(profile: ProfileToWrite = DEFAULT_PROFILE) -> None:
    """Put the profile back as it was before the last calibration; a second time undoes that."""
    path = profile_path(profile)
    undo_profile(path)
    typer.echo(f"{path} is as it was before")
