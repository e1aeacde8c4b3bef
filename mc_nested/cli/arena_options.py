"""Options of the verbs that mark or build an arena: how large it is, and where in it the player stands."""

from typing import Annotated

import typer

from mc_nested.arena.scenario import DEFAULT_SIZE
from mc_nested.cli.scenario_options import NAME_OR_FILE, named_scenario
from mc_nested.errors import UserError
from mc_nested.live.profile.arena import size_for

SizeOption = Annotated[
    int | None, typer.Option(metavar="CELLS", help=f"cells along each side, up to 32 [{DEFAULT_SIZE}]")
]
ForScenarioOption = Annotated[
    str | None, typer.Option("--scenario", metavar=NAME_OR_FILE, help="as large as this scenario needs")
]
StandingOption = Annotated[
    tuple[int, int] | None,
    typer.Option(metavar="X Y", help="the cell you stand on [the middle of the near edge: 7 0 of 15 cells]"),
]


def arena_size(size: int | None, scenario: str | None, layer: int | None = None) -> int:
    """Cells along each side of the arena to calibrate; ``layer`` is the scenario file's.

    UserError if a size and a scenario are given, or a layer alone; ScenarioError if the scenario can't be used.
    """
    if size is not None and scenario is not None:
        raise UserError("--size and --scenario both say how large the arena is: give one of them")
    if scenario is not None:
        return size_for(named_scenario(scenario, layer))
    if layer is not None:
        raise UserError("--layer is a layer of a schematic: name its file with --scenario")
    return DEFAULT_SIZE if size is None else size
