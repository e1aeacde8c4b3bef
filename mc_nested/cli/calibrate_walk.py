"""``mc-nested calibrate walk``: measure how far a held key walks, and the latencies of input and screen."""

from typing import Annotated

import typer

from calibration.open_context import context_opener
from calibration.walk.measure import calibrate_walk
from mc_nested.cli.options import DEFAULT_PROFILE, ServerOption
from mc_nested.cli.recording_options import RecordOption, live_recorder


def walk(
    profile: Annotated[
        str, typer.Option(metavar="NAME|FILE", help="the profile to write; it must name the font")
    ] = DEFAULT_PROFILE,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
) -> None:
    """Measure how you walk, for a minute, in the marked arena or around where you stand."""
    found, picture = calibrate_walk(
        profile,
        context_opener(
            typer.echo,
            typer.confirm,
            is_server_allowed=server_allowed,
            open_recorder=live_recorder(record, "calibrate-walk", server_allowed=server_allowed),
        ),
    )
    for line in found.lines:
        typer.echo(line)
    typer.echo(f"written to {profile}; look at the curve in {picture}")
