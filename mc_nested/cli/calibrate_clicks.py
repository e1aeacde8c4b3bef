"""``mc-nested calibrate clicks``: the menus' buttons, found by their labels, and by hand where that fails."""

from typing import Annotated

import typer

from calibration.clicks.find import calibrate_clicks
from calibration.clicks.show import show_clicks, try_clicks
from calibration.open_context import context_opener
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite
from mc_nested.cli.recording_options import RecordOption, live_recorder
from mc_nested.errors import UserError


def clicks(
    points: Annotated[
        list[str] | None, typer.Argument(metavar="[POINT]...", help="record these by hand (default: find the menus')")
    ] = None,
    profile: ProfileToWrite = DEFAULT_PROFILE,
    hotkey: Annotated[str, typer.Option(help="records the place under the mouse")] = "f8",
    skip: Annotated[str, typer.Option(help="leaves a point as it is")] = "f9",
    yes: Annotated[bool, typer.Option("--yes", help="visit the title without asking; nothing by hand")] = False,
    show: Annotated[bool, typer.Option("--show", help="only mark the points on a picture of the screen")] = False,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="only move the mouse there, and press nothing")] = False,
    record: RecordOption = None,
) -> None:
    """Find the places to click in the menus; name points to record those by hand: hover and press the hotkey."""
    ask = (lambda _: True) if yes else typer.confirm
    context_of = context_opener(typer.echo, ask, open_recorder=live_recorder(record, "calibrate-clicks"))
    if show and dry_run:
        raise UserError("--show and --dry-run do different things: choose one of them")
    if show:
        typer.echo(f"look at the points in {show_clicks(profile, context_of)}")
    elif dry_run:
        for line in try_clicks(profile, context_of):
            typer.echo(line)
    else:
        names = points or ()
        written = calibrate_clicks(profile, context_of, names=names, is_by_hand=not yes, hotkey=hotkey, skip=skip)
        for line in written[0].lines if written else ("nothing was written",):
            typer.echo(line)
        if written:
            typer.echo(f"look at the points in {written[1]}")
