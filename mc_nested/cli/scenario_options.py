"""Naming scenarios on the command line: the option for a file's layer, and loading what was named."""

from collections.abc import Sequence
from typing import Annotated

import typer

from mc_nested.arena.scenario import Scenario
from mc_nested.design_files.load import Loaded, load_any_scenario

NAME_OR_FILE = "NAME|FILE"

FILES = "a shipped one, a TOML file, .schem, .schematic, .litematic, .nbt or .png"
"""What a scenario can be, for help texts."""

ScenariosOption = Annotated[
    list[str] | None,
    typer.Option(
        "--scenario", metavar=NAME_OR_FILE, help=f"a design, as often as you like: {FILES} [the paper's three]"
    ),
]
LayerOption = Annotated[
    int | None,
    typer.Option(
        min=0, metavar="N", help="the layer of a schematic, 0 the lowest [the lowest with blocks; build needs it]"
    ),
]


def named_scenario(name: str, layer: int | None, *, must_choose: bool = False) -> Scenario:
    """The scenario of that name or file; what a person should know about it is printed, a line each.

    ``must_choose``: a file with several layers needs ``layer``. ScenarioError, one line, if it can't be used.
    """
    loaded = load_any_scenario(name, layer, must_choose=must_choose)
    print_notes(loaded)
    return loaded.scenario


def print_notes(loaded: Loaded) -> None:
    """Print what a person should know about a scenario, on standard error."""
    for note in loaded.notes:
        typer.echo(note, err=True)


def named_scenarios(names: Sequence[str], layer: int | None) -> list[Scenario]:
    """The scenarios of several names and files, each as ``named_scenario``."""
    return [named_scenario(name, layer) for name in names]
