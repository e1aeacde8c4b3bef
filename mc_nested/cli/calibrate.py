"""``mc-nested calibrate``: its verbs, and undoing what the last one wrote."""

import typer

from mc_nested.cli import calibrate_all
from mc_nested.cli.calibrate_arena import arena
from mc_nested.cli.calibrate_clicks import clicks
from mc_nested.cli.calibrate_font import font
from mc_nested.cli.calibrate_report import report
from mc_nested.cli.calibrate_walk import walk
from mc_nested.cli.json_fields import epilog_of
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite
from mc_nested.live.profile.store import profile_path, undo_profile

app = typer.Typer(help="Tell the agent where your arena and your buttons are.")
app.command("all", epilog=epilog_of("calibrate all"))(calibrate_all.calibrate)
app.command()(font)
app.command()(arena)
app.command()(walk)
app.command()(clicks)
app.command()(report)


@app.command()
def undo(profile: ProfileToWrite = DEFAULT_PROFILE) -> None:
    """Put the profile back as it was before the last calibration; a second time undoes that."""
    path = profile_path(profile)
    broken = undo_profile(path)
    typer.echo(f"{path} is as it was before")
    if broken:
        typer.echo(f"what stood there is no profile that can be read: it is kept in {broken}")
