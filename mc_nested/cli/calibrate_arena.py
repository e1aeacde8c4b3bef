"""``mc-nested calibrate arena``: build the arena where you stand, or put back what stood there."""

from pathlib import Path
from typing import Annotated

import typer

from calibration.arena.build import calibrate_built_arena
from calibration.arena.mark import mark_arena
from calibration.arena.undo import undo_built_arena
from mc_nested.cli.arena_options import ForScenarioOption, SizeOption, StandingOption, arena_size
from mc_nested.cli.calibrating import calibrating
from mc_nested.cli.options import DEFAULT_PROFILE, ServerOption
from mc_nested.cli.recording_options import RecordOption
from mc_nested.cli.scenario_options import LayerOption
from mc_nested.cli.viewing import StepViewOption
from mc_nested.errors import UserError


def arena(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    profile: Annotated[
        str, typer.Option(metavar="NAME|FILE", help="the profile to write; new if there is none")
    ] = DEFAULT_PROFILE,
    font: Annotated[
        Path | None, typer.Option(metavar="PNG|JAR", help="the game's client jar, needed the first time")
    ] = None,
    size: SizeOption = None,
    scenario: ForScenarioOption = None,
    layer: LayerOption = None,
    standing: StandingOption = None,
    yes: Annotated[bool, typer.Option("--yes", help="build, or mark, without asking")] = False,
    mark_only: Annotated[bool, typer.Option("--mark-only", help="type no commands, write only where it is")] = False,
    undo: Annotated[bool, typer.Option("--undo", help="put back what stood there before it was built")] = False,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
    view: StepViewOption = False,
) -> None:
    """Build the arena where you stand and look, with commands; what stood there is shown, asked about and copied."""
    if mark_only and undo:
        raise UserError("--mark-only and --undo do different things: choose one of them")
    cells = arena_size(size, scenario, layer)
    with calibrating("arena", profile, is_viewed=view, record=record, server_allowed=server_allowed) as opened:
        if mark_only:
            path = mark_arena(
                profile,
                opened.context_of,
                ask=opened.ask,
                say=typer.echo,
                size=cells,
                standing=standing,
                font=font,
                yes=yes,
            )
            lines = [f"arena written to {path}" if path else "nothing was written"]
        else:
            if undo:
                found, file = undo_built_arena(profile, opened.context_of)
            else:
                found, file = calibrate_built_arena(
                    profile, opened.context_of, size=cells, standing=standing, font=font, yes=yes
                )
            lines = [*found.lines, *([f"written to {file}"] if file.is_file() else [])]
    for line in lines:
        typer.echo(line)
