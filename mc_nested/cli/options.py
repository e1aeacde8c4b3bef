"""Options that several verbs share: the design, where it is built, the profile, and whether a recording is kept."""

from pathlib import Path
from typing import Annotated

import typer

from mc_nested.arena.scenario import DEFAULT_SIZE, Scenario
from mc_nested.arena.scenario_file import shipped_scenarios
from mc_nested.cli.completion import complete_of, complete_profiles, complete_runs
from mc_nested.cli.output import say_aside
from mc_nested.design_files.load import Loaded, load_any_scenario
from mc_nested.errors import UserError
from mc_nested.learn.preset import shipped_presets
from mc_nested.live.profile.arena import size_for
from mc_nested.live.session import OFF, Opening
from sim.worlds import Backend

DEFAULT_PROFILE = "default"
NAME_OR_FILE = "NAME|FILE"

FILES = "a shipped one, a TOML file, .schem, .schematic, .litematic, .nbt or .png"
"""What a scenario can be, for help texts."""

PRESETS = "the preset's"
"""The default of what a preset says."""

RunArgument = Annotated[
    Path, typer.Argument(metavar="RUN", help="the folder of a training (its --out)", autocompletion=complete_runs)
]
BackendOption = Annotated[
    Backend, typer.Option(help="the headless simulator, the virtual client, or a running game's window")
]
ProfileOption = Annotated[
    str,
    typer.Option(metavar=NAME_OR_FILE, help="the profile of your game and screen", autocompletion=complete_profiles),
]
ProfileToWrite = Annotated[
    str,
    typer.Option(
        metavar=NAME_OR_FILE, help="the profile to write; new if there is none", autocompletion=complete_profiles
    ),
]
ServerOption = Annotated[
    bool, typer.Option("--server-allowed", help="play even where the window's title says Multiplayer")
]
RecordOption = Annotated[
    str | None,
    typer.Option(
        metavar="DIR|off",
        help="a new folder for the recording of a running game, or none",
        show_default="one among mc-nested recordings",
    ),
]

MOST_TRIALS = 1000
"""More would only run out of memory."""

PresetOption = Annotated[
    str,
    typer.Option(metavar=NAME_OR_FILE, help="hyper-parameters", autocompletion=complete_of(shipped_presets)),
]
EngineOption = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="what computes: compiled, or torch", show_default=PRESETS),
]
DeviceOption = Annotated[
    str | None, typer.Option(metavar="NAME", help="where torch computes: cpu, cuda or mps", show_default=PRESETS)
]
StatesOption = Annotated[
    str | None,
    typer.Option(metavar="NAME", help="what the agent sees: numbers, an image, or the screen", show_default=PRESETS),
]

ScenariosOption = Annotated[
    list[str] | None,
    typer.Option(
        "--scenario",
        metavar=NAME_OR_FILE,
        help=f"a design, as often as you like: {FILES}",
        show_default="the paper's three",
        autocompletion=complete_of(shipped_scenarios),
    ),
]
LayerOption = Annotated[
    int | None,
    typer.Option(
        min=0,
        metavar="N",
        help="the layer of a schematic, 0 the lowest",
        show_default="the lowest with blocks; build needs it",
    ),
]
SizeOption = Annotated[
    int | None,
    typer.Option(metavar="CELLS", help="cells along each side, up to 32", show_default=f"{DEFAULT_SIZE}"),
]
ForScenarioOption = Annotated[
    str | None,
    typer.Option(
        "--scenario",
        metavar=NAME_OR_FILE,
        help="as large as this scenario needs",
        autocompletion=complete_of(shipped_scenarios),
    ),
]
StandingOption = Annotated[
    tuple[int, int] | None,
    typer.Option(
        metavar="X Y",
        help="the cell you stand on",
        show_default="the middle of the near edge: 7 0 of 15 cells",
    ),
]


def given(context: typer.Context) -> list[str]:
    """List the options that were given, as ``--out``."""
    return [each.opts[0] for each in context.command.params if each.name and is_given(context, each.name)]


def is_given(context: typer.Context, name: str) -> bool:
    """Say whether the parameter of that name was given on the command line."""
    source = context.get_parameter_source(name)
    return source is not None and source.name == "COMMANDLINE"


def is_alone(context: typer.Context) -> bool:
    """Return whether a verb is alone, with no verb of its own behind it.

    Raise UserError if an option stands before such a one, where it would be ignored.
    """
    if context.invoked_subcommand is None:
        return True
    verb = f"{context.command_path} {context.invoked_subcommand}"
    below = getattr(context.command, "commands", {})[context.invoked_subcommand]
    for option in given(context):
        if any(option in each.opts for each in below.params):
            raise UserError(f"write {option} at the end: {verb} {option}")
        raise UserError(f"{verb} takes no {option}: leave it out")
    return False


def opening_of(
    profile: str, what: str, record: str | None, *, server_allowed: bool = False, backend: Backend = Backend.LIVE
) -> Opening:
    """Return how a live run is opened, by its options; ``what``, a word or two about the run, names its recording.

    Raise RecordingError if the recording's folder holds something already, UserError if there is nothing to record.
    """
    if record not in (None, OFF) and backend is not Backend.LIVE:
        raise UserError("only what is played in a window is recorded: add --backend live, or leave out --record")
    return Opening(profile, say_aside, what, record, is_server_allowed=server_allowed)


def named_scenario(name: str, layer: int | None, *, must_choose: bool = False, must_reach: bool = True) -> Scenario:
    """Return the scenario of that name or file; what a person should know about it is printed, a line each.

    ``must_choose``: a file with several layers needs ``layer``. ``must_reach``: every cell drawn can be built. Raise
    ScenarioError, one line, if it can't be used.
    """
    loaded = load_any_scenario(name, layer, must_choose=must_choose, must_reach=must_reach)
    print_notes(loaded)
    return loaded.scenario


def print_notes(loaded: Loaded) -> None:
    """Print what a person should know about a scenario, on standard error."""
    for note in loaded.notes:
        typer.echo(note, err=True)


def arena_size(size: int | None, scenario: str | None, layer: int | None = None) -> int:
    """Return how many cells each side of the arena to calibrate has; ``layer`` is the scenario file's.

    Raise UserError if a size and a scenario are given, or a layer alone; raise ScenarioError if the scenario can't be
    used.
    """
    if size is not None and scenario is not None:
        raise UserError("--size and --scenario both say how large the arena is: give one of them")
    if scenario is not None:
        return size_for(named_scenario(scenario, layer))
    if layer is not None:
        raise UserError("--layer is a layer of a schematic: name its file with --scenario")
    return DEFAULT_SIZE if size is None else size
