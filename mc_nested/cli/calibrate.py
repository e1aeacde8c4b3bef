"""``mc-nested calibrate``: tell the agent where your arena and your buttons are."""

from typing import Annotated

import typer

from calibration.clicks import calibrate_clicks
from mc_nested.cli.calibrate_arena import arena
from mc_nested.cli.calibrate_walk import walk
from mc_nested.cli.options import DEFAULT_PROFILE

app = typer.Typer(help="Tell the agent where your arena and your buttons are.")

app.command()(arena)
app.command()(walk)

ProfileToWrite = Annotated[str, typer.Option(metavar="NAME|FILE", help="the profile to write; new if there is none")]


@app.command()
def clicks(
    points: Annotated[
        list[str] | None, typer.Argument(metavar="[POINT]...", help="which (default: the menus')")
    ] = None,
    profile: ProfileToWrite = DEFAULT_PROFILE,
    hotkey: Annotated[str, typer.Option(help="records the place under the mouse")] = "f8",
    skip: Annotated[str, typer.Option(help="leaves a point as it is")] = "f9",
) -> None:
    """Record the places to click by hand: hover and press the hotkey."""
    written = calibrate_clicks(profile, say=typer.echo, names=points or (), hotkey=hotkey, skip=skip)
    if written is None:
        typer.echo("nothing was written")
        return
    typer.echo(f"points written to {written[0]}; look at them in {written[1]}")
