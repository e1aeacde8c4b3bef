"""``mc-nested train``: begin a training, or resume one."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.arena.action import Cell
from mc_nested.arena.cooperative.team import MOST_BUILDERS, Team, spread_starts
from mc_nested.arena.demonstration import Demonstration
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import shipped_scenarios, table_of
from mc_nested.cli.cluster_options import InsecureOption, KeysOption
from mc_nested.cli.completion import complete_of, complete_runs
from mc_nested.cli.games_at_play import games_of
from mc_nested.cli.options import (
    DEFAULT_PROFILE,
    FILES,
    MOST_TRIALS,
    NAME_OR_FILE,
    PRESETS,
    DeviceOption,
    EngineOption,
    LayerOption,
    PresetOption,
    ProfileOption,
    RecordOption,
    ServerOption,
    StatesOption,
    given,
    is_alone,
    is_given,
    named_scenario,
    opening_of,
)
from mc_nested.cli.output import JsonOption, Output, QuietOption, prints
from mc_nested.cli.output_folder import output_folder
from mc_nested.cli.recordings import recording_path
from mc_nested.cli.serve import keys as make_keys
from mc_nested.cli.serve import serve
from mc_nested.cli.training_end import TrainingResult
from mc_nested.cli.training_loop import HowToRun, run_training
from mc_nested.cli.view import ViewOption
from mc_nested.errors import UserError
from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.learn.builders import NETWORKS, Networks
from mc_nested.learn.dqn.engines import OBJECTIVES, SCREEN
from mc_nested.learn.objectives.weights import agent_of, shipped_weights
from mc_nested.learn.preset import MOST, Preset, load_preset
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.learn.runs.run_config import RunConfig, TeamTable
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.unknown_design import ANY_DESIGN, playing
from mc_nested.live.recording.demonstrations import demonstrations_in
from sim.worlds import Backend, check_window

BESIDE_RESUME = (
    "--resume",
    "--device",
    "--profile",
    "--server-allowed",
    "--record",
    "--view",
    "--games",
    "--keys",
    "--insecure",
    "--quiet",
    "--json",
)
"""The options that a run can be resumed with; all others are in its config.toml."""

NOT_UNKNOWN = (
    "--builders",
    "--start",
    "--networks",
    "--games",
    "--from",
    "--from-recording",
    "--engine",
    "--device",
    "--states",
)
"""The options that don't go with --design-unknown."""

BUILDERS = 2
"""Builders in one arena, unless their number is given."""

app = typer.Typer()


@app.callback(invoke_without_command=True)
@prints(TrainingResult)
def train(  # noqa: PLR0913 - a Typer verb: a parameter for each option
    context: typer.Context,
    scenario: Annotated[
        str,
        typer.Option(
            metavar=NAME_OR_FILE,
            help=f"the design to build: {FILES}",
            autocompletion=complete_of(shipped_scenarios),
        ),
    ] = "line",
    layer: LayerOption = None,
    agent: Annotated[
        str,
        typer.Option(help=f"the agent: {', '.join(AGENT_SPECS)}", autocompletion=complete_of(lambda: AGENT_SPECS)),
    ] = "nested",
    builders: Annotated[
        int | None, typer.Option(help=f"let so many builders, 1 to {MOST_BUILDERS}, learn in one simulated arena")
    ] = None,
    start: Annotated[
        list[str] | None,
        typer.Option(
            metavar="X,Y",
            help="a builder's start cell, once for each",
            show_default="spread along the scenario's start",
        ),
    ] = None,
    networks: Annotated[
        str | None,
        typer.Option(
            help="how several builders learn; shared: one nested agent plays all; own: each has a nested agent; "
            "single: independent single agents",
            show_default=NETWORKS[0],
            autocompletion=complete_of(lambda: NETWORKS),
        ),
    ] = None,
    design_unknown: Annotated[
        bool,
        typer.Option("--design-unknown", help=f"don't tell the agent of the preset {ANY_DESIGN} what it is to build"),
    ] = False,
    backend: Annotated[Backend, typer.Option(help="where it is played")] = Backend.SIM,
    preset: PresetOption = "paper",
    engine: EngineOption = None,
    device: DeviceOption = None,
    states: StatesOption = None,
    episodes: Annotated[
        int | None, typer.Option(min=1, max=MOST, help="episodes a trial", show_default=PRESETS)
    ] = None,
    trials: Annotated[int, typer.Option(min=1, max=MOST_TRIALS, help="independent trials, trained as one batch")] = 1,
    seed: Annotated[int, typer.Option(min=0, help="the same seed gives the same training")] = 0,
    stop_at_optimum: Annotated[
        bool, typer.Option("--stop-at-optimum", help="end a trial at its first greedy evaluation at the optimum")
    ] = False,
    profile: ProfileOption = DEFAULT_PROFILE,
    server_allowed: ServerOption = False,
    record: RecordOption = None,
    games: Annotated[
        str | None,
        typer.Option(metavar="ADDRESS", help="let the games of a Dask scheduler play (mc-nested train serve)"),
    ] = None,
    keys: KeysOption = None,
    insecure: InsecureOption = False,
    begin_from: Annotated[
        Path | None,
        typer.Option(
            "--from",
            metavar="RUN",
            help="begin with the best policy of an earlier training, and its learnt game",
            autocompletion=complete_runs,
        ),
    ] = None,
    from_recording: Annotated[
        list[Path] | None,
        typer.Option(metavar="REC", help="learn from a recording's episodes first, of a person's build; repeatable"),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="a new or empty folder for the run", show_default="runs/DESIGN-AGENT-DATE"),
    ] = None,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="DIR", help="go on from a run's last checkpoint", autocompletion=complete_runs),
    ] = None,
    view: ViewOption = False,
    quiet: QuietOption = False,
    as_json: JsonOption = False,
) -> None:
    """Train an agent; Ctrl+C saves, and --resume goes on from there."""
    if not is_alone(context):
        return
    served = games_of(games, keys, insecure, given(context))
    where = Backend.LIVE if resume else backend  # it is in the run's config.toml
    opening = opening_of(profile, "train", record, server_allowed=server_allowed, backend=where)
    how = HowToRun(Output(quiet, as_json), opening, view, served)
    if resume is not None:
        _resume(resume, given(context), device, how)
        return
    if agent not in AGENT_SPECS:
        raise UserError(f"no agent {agent!r}: choose one of {', '.join(AGENT_SPECS)}")
    chosen = load_preset(preset).changed(engine=engine, device=device, states=states)
    _check_arenas(preset, chosen, backend, games=bool(games), design_unknown=design_unknown)
    design = named_scenario(scenario, layer)
    team = _team(design, builders, start, networks)
    if design_unknown:
        _check_unknown(context, preset, agent, design)
        chosen = playing(chosen)
    names_agent = is_given(context, "agent")
    if team and (names_agent or backend is not Backend.SIM):
        option = "--agent" if names_agent else "--backend"
        raise UserError(f"{option} doesn't go with --builders, --start and --networks: leave it out")
    config = RunConfig(
        agent=team.builders.agent if team else agent,
        backend=backend.value,
        profile=profile if backend is Backend.LIVE and not games else None,
        trials=trials,
        seed=seed,
        stop_at_optimum=stop_at_optimum,
        preset_name=preset,
        preset=chosen.model_copy(update={"episodes": episodes or chosen.episodes}),
        scenario=table_of(design),
        team=team,
        design_unknown=design_unknown,
    )
    shown = _shown(from_recording or [], config, design)
    who = f"{len(team.starts)}-builders" if team else config.agent
    with output_folder(out, f"{design.name}-{who}") as path:
        run_training(RunFolder.new(path, config), False, how, begin_from, shown)


def _resume(path: Path, options: Sequence[str], device: str | None, how: HowToRun) -> None:
    """Go on with a run from its last checkpoint."""
    for option in options:
        if option not in BESIDE_RESUME:
            raise UserError(f"--resume goes on with the run's own config.toml: leave out {option}")
    folder = RunFolder.open(path)
    if folder.checkpoint.weights.is_file():
        raise UserError(f"{path}: an exported model isn't resumed: begin from it with --from {path}")
    if device:
        there = folder.config.preset.changed(device=device)
        folder = RunFolder(path, folder.config.model_copy(update={"preset": there}))
    if "--profile" not in options and folder.config.profile:
        how = replace(how, opening=replace(how.opening, profile=folder.config.profile))
    with folder_lock(path):
        run_training(folder, not folder.only_begun, how)


app.command()(serve)
app.command("keys")(make_keys)


def _check_arenas(name: str, preset: Preset, backend: Backend, *, games: bool, design_unknown: bool) -> None:
    """Raise UserError, one line, if the preset can't train where it is asked to."""
    check_window(preset.states, backend is not Backend.SIM)
    if preset.objectives and not design_unknown and (games or backend is not Backend.SIM):
        mend = "--games" if games else "--backend, or add --design-unknown"
        raise UserError(f"--preset {name} trains in the simulator: leave out {mend}")


def _check_unknown(context: typer.Context, preset: str, agent: str, scenario: Scenario) -> None:
    """Raise UserError, one line, if a design can't be unknown in such a training."""
    if preset != ANY_DESIGN:
        raise UserError(f"--design-unknown is for the agent with objectives: add --preset {ANY_DESIGN}")
    if agent != "nested":
        raise UserError(f"--design-unknown is for the nested agent: leave out --agent {agent}")
    for option in NOT_UNKNOWN:
        if option in given(context):
            raise UserError(f"{option} doesn't go with --design-unknown: leave it out")
    if scenario.parts:  # what a cell pays would depend on the part
        raise UserError(f"--design-unknown knows no parts, and {scenario.name} has some: take another design")
    agent_of(shipped_weights(), scenario)  # what can't be used is said before there is a folder


def _shown(recordings: Sequence[Path], config: RunConfig, scenario: Scenario) -> list[Demonstration]:
    """Return the episodes of recordings, and print a line about each; raise UserError if they can't be learnt from."""
    if recordings and config.team:
        raise UserError("--from-recording is for one builder: leave out --builders, --start and --networks")
    if recordings and config.preset.states in (SCREEN, OBJECTIVES):
        raise UserError(f"--from-recording doesn't go with states {config.preset.states!r}: take others, with --states")
    shown = list[Demonstration]()
    for recording in recordings:
        found, said = demonstrations_in(recording_path(recording), scenario)
        typer.echo(said, err=True)
        shown += found
    return shown


def _team(scenario: Scenario, builders: int | None, starts: list[str] | None, networks: str | None) -> TeamTable | None:
    """Return the builders that were asked for, None for one agent.

    Raise UserError or ScenarioError if there can't be such.
    """
    if builders is None and not starts and networks is None:
        return None
    if not starts:
        cells = spread_starts(scenario, BUILDERS if builders is None else builders)
    elif builders in (None, len(starts)):
        cells = tuple(_cell(text) for text in starts)
    else:
        raise UserError(f"--builders {builders} and {len(starts)} times --start: give each builder one start, or none")
    team = Team(scenario, cells)
    return TeamTable(networks=_networks(networks), starts=[list(cell) for cell in team.starts])


def _cell(text: str) -> Cell:
    x, _, y = text.partition(",")
    try:
        return int(x), int(y)
    except ValueError:
        raise UserError(f"--start {text!r} is no cell: name it as X,Y, like 7,14") from None


def _networks(name: str | None) -> Networks:
    for networks in NETWORKS:
        if name in (networks, None):
            return networks
    raise UserError(f"no networks {name!r}: choose one of {', '.join(NETWORKS)}")
