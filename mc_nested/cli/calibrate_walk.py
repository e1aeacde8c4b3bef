"""``mc-nested calibrate walk``: measure how far a held key walks, and the latencies of input and screen."""

from typing import Annotated

import typer

from calibration.walk.measure import calibrate_walk
from mc_nested.cli.calibrating import calibrating
from mc_nested.cli.options import DEFAULT_PROFILE, ServerOption
from mc_nested.cli.recording_options import RecordOption
from mc_nested.cli.viewing import StepViewOption


def walk(
    profile: Annotated[
        str, typer.Option(metavar="NAME|FILE", help="the profile to write; it must name the font")
    ] = DEFAULT_PROFILE,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
    view: StepViewOption = False,
) -> None:
    """Measure how you walk, for a minute, in the marked arena or around where you stand."""
    with calibrating("walk", profile, is_viewed=view, record=record, server_allowed=server_allowed) as opened:
        found, picture = calibrate_walk(profile, opened.context_of)
    for line in found.lines:
        typer.echo(line)
    typer.echo(f"written to {profile}; look at the curve in {picture}")
