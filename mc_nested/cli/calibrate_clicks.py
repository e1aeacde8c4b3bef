"""``mc-nested calibrate clicks``: the menus' buttons, found by their labels, and by hand where that fails."""

from typing import Annotated

import typer

from calibration.clicks.find import calibrate_clicks
from calibration.clicks.points import show_clicks, try_clicks
from mc_nested.cli.calibrating import calibrating
from mc_nested.cli.options import DEFAULT_PROFILE, ProfileToWrite
from mc_nested.cli.recording_options import RecordOption
from mc_nested.cli.viewing import StepViewOption
from mc_nested.errors import UserError


def clicks(  # noqa: PLR0913 - a Typer verb: a parameter for each option
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
    view: StepViewOption = False,
) -> None:
    """Find the places to click in the menus; name points to record those by hand: hover and press the hotkey."""
    if show and dry_run:
        raise UserError("--show and --dry-run do different things: choose one of them")
    with calibrating("clicks", profile, is_viewed=view, record=record, yes=yes) as opened:
        if show:
            lines = [f"look at the points in {show_clicks(profile, opened.context_of)}"]
        elif dry_run:
            lines = try_clicks(profile, opened.context_of)
        else:
            written = calibrate_clicks(
                profile, opened.context_of, names=points or (), is_by_hand=not yes, hotkey=hotkey, skip=skip
            )
            lines = [*written[0].lines, f"look at the points in {written[1]}"] if written else ["nothing was written"]
    for line in lines:
        typer.echo(line)
