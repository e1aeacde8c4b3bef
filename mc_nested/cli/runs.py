"""``mc-nested runs``: list the runs and experiments in a folder, look at one, evaluate it, rename it, delete it."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import typer
from rich.filesize import decimal
from rich.table import Table
from rich.text import Text

from calibration.report.privacy import names_here
from mc_nested.arena.env import ArenaEnv
from mc_nested.atomic_file import whole_folder
from mc_nested.cli.completion import RUNS, complete_runs
from mc_nested.cli.options import RunArgument, is_alone
from mc_nested.cli.output import FittingTable, JsonOption, Output, facts_table, prints
from mc_nested.errors import RunError
from mc_nested.learn.agents import Agent
from mc_nested.learn.evaluation import GreedyEpisode, build_greedily, play_greedily
from mc_nested.learn.runs.exported_run import export_run
from mc_nested.learn.runs.folder_lock import delete_folder, rename_folder
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.studies.run_facts import RunFacts, facts_of, runs_in
from sim.grid import GridGame, GridVectorEnv
from sim.team_grid import team_arenas
from sim.worlds import check_window

MOST_NAMED = 3
"""Designs, agents or presets that a row names; of more it says how many."""

STYLES = {"finished": "green", "can be resumed": "yellow", "in use": "cyan", "damaged": "bold red"}

app = typer.Typer()

NameArgument = Annotated[
    str, typer.Argument(metavar="RUN", help=f"a folder, or its name in {RUNS}", autocompletion=complete_runs)
]


@dataclass(frozen=True)
class RunList:
    """What ``runs list`` prints."""

    folder: Annotated[Path, "that was looked at"]
    runs: Annotated[Sequence[RunFacts], "as of runs show, without files"]


@dataclass(frozen=True)
class RunShown(RunFacts):
    """What ``runs show`` prints."""

    files: Annotated[Sequence[str], "names of its files"] = ()


@dataclass(frozen=True)
class EvaluationResult:
    """What ``runs evaluate`` prints."""

    folder: Annotated[Path, "the run's folder"]
    scenario: Annotated[str, "the design's name"]
    optimum: Annotated[float, "the highest score possible"]
    scores: Annotated[Sequence[float], "of each trial"]
    materials: Annotated[Sequence[str], "that each trial chose"]
    steps: Annotated[Sequence[int], "that each trial took"]


@app.callback(invoke_without_command=True)
def runs(context: typer.Context, as_json: JsonOption = False) -> None:
    """List your runs, look at one, evaluate it, rename it, delete it; alone it lists those in runs/."""
    if is_alone(context):
        list_runs(RUNS, as_json)


@app.command("list")
@prints(RunList)
def list_runs(
    folder: Annotated[Path, typer.Argument(metavar="[FOLDER]", help="where they are", show_default=False)] = RUNS,
    as_json: JsonOption = False,
) -> None:
    """List the runs in a folder [runs], with what they train, how far they are, and their scores."""
    found = runs_in(folder)
    lines = [f"{each.folder}: {each.why}" for each in found if each.state == "damaged"]
    shown = [_table(found), *lines] if found else [f"no runs in {folder}: mc-nested train makes one"]
    Output(as_json=as_json).result(RunList(folder, found), *shown)


@app.command()
@prints(RunShown)
def show(run: NameArgument, as_json: JsonOption = False) -> None:
    """Show one run: what it trains, how far it is, its files."""
    facts = _known(run)
    files = sorted(entry.name + ("/" if entry.is_dir() else "") for entry in facts.folder.iterdir())
    rows = (*_facts(facts), ("why", facts.why or ""), ("folder", str(facts.folder)), ("files", ", ".join(files)))
    Output(as_json=as_json).result(RunShown(**vars(facts), files=files), facts_table(rows))


@app.command()
@prints(EvaluationResult)
def evaluate(run: RunArgument, as_json: JsonOption = False) -> None:
    """Replay the greedy policy of every trial in the simulator and print the scores."""
    folder = RunFolder.open(run)
    episodes = greedy_episodes(folder, folder.trained_agent())
    scenario = folder.scenario
    materials = [episode.material_name(scenario) for episode in episodes]
    found = EvaluationResult(
        folder=folder.path,
        scenario=scenario.name,
        optimum=scenario.optimum,
        scores=[episode.score for episode in episodes],
        materials=materials,
        steps=[len(episode.actions) for episode in episodes],
    )
    table = Table("trial", "score", "optimum", "material", "steps", title=Text(f"{scenario.name}, greedy"))
    for trial, (score, material, steps) in enumerate(zip(found.scores, materials, found.steps, strict=True)):
        table.add_row(f"{trial}", f"{score:g}", f"{scenario.optimum:g}", Text(material), f"{steps}")
    Output(as_json=as_json).result(found, table)


def greedy_episodes(folder: RunFolder, agent: Agent) -> list[GreedyEpisode]:
    """Play a greedy episode of every trial in the simulator.

    Raise UserError if it sees what the simulator can't show.
    """
    check_window(folder.config.preset.states, has_window=False)
    trials = folder.config.trials
    if folder.config.trains_objectives:
        return [build_greedily(ArenaEnv(GridGame(folder.scenario), folder.scenario), agent)]
    arenas = team_arenas(folder.team, trials) if folder.team else GridVectorEnv(folder.scenarios)
    env = agent.view_of(arenas, folder.scenarios)
    return play_greedily(env, folder.scenarios, agent)


@app.command()
def export(
    run: RunArgument, out: Annotated[Path, typer.Option(metavar="FOLDER", help="a new folder, for a hub's models")]
) -> None:
    """Write a run as a model to share: its networks, a card with its figures, no names; play takes it as a run."""
    with whole_folder(out, RunError) as folder:
        export_run(RunFolder.open(run), folder, out.name, names_here().removed_from)
    typer.echo(f"{out}: {', '.join(sorted(each.name for each in out.iterdir()))}")


@app.command()
def rename(
    run: NameArgument, name: Annotated[str, typer.Argument(metavar="NAME", help="its new name, in the same folder")]
) -> None:
    """Give a run another name."""
    typer.echo(f"renamed to {rename_folder(_known(run).folder, name)}")


@app.command()
def delete(
    runs: Annotated[
        list[str],
        typer.Argument(metavar="RUN...", help=f"folders, or their names in {RUNS}", autocompletion=complete_runs),
    ],
    yes: Annotated[bool, typer.Option("--yes", help="delete without asking")] = False,
) -> None:
    """Delete runs, after a question for each."""
    for facts in [_known(run) for run in runs]:
        what = ", ".join(filter(None, (facts.verb, _named(facts.designs, "designs"), facts.state, decimal(facts.size))))
        if yes or typer.confirm(f"Delete {facts.folder} ({what})?"):
            delete_folder(facts.folder)
            typer.echo(f"deleted {facts.folder}")
        else:
            typer.echo(f"kept {facts.folder}")


def _known(run: str) -> RunFacts:
    """Return the facts of the run of that name in runs/, or in that folder; raise RunError if there is none."""
    if not run.strip():
        raise RunError("'' names no run: mc-nested runs lists them")
    path = Path(run)
    if path.name in ("", ".."):  # the folder that one is in: it is changed by its own name
        path = path.resolve()
    for folder in (RUNS / path, path):
        if facts := facts_of(folder):
            return facts
    raise RunError(f"no run {run!r}, neither in {RUNS} nor as a folder: mc-nested runs lists them")


def _table(found: Sequence[RunFacts]) -> FittingTable:
    rows = [
        {name: Text(value, STYLES[facts.state] if name == "state" else "") for name, value in _facts(facts)}
        for facts in found
    ]
    return FittingTable(rows, ("size", "what", "begun", "trials", "episodes"), ("trials", "episodes", "score", "size"))


def _facts(facts: RunFacts) -> list[tuple[str, str]]:
    """Return the facts in words, by their names."""
    done, most = facts.episodes_done, facts.episodes
    return [
        ("run", facts.folder.name),
        ("what", facts.verb or ""),
        ("design", _named(facts.designs, "designs")),
        ("agent", _named(facts.agents, "agents")),
        ("preset", _named(facts.presets, "presets")),
        ("trials", "" if facts.trials is None else f"{facts.trials}"),
        ("episodes", "" if done is None or most is None else f"{done:,} of {most:,}"),
        ("score", "" if facts.score is None else f"{facts.score:.4g} of {facts.optimum:g}"),
        ("state", f"{facts.state}, {facts.why}" if facts.state == "in use" else facts.state),
        ("size", decimal(facts.size)),
        ("begun", f"{facts.begun:%Y-%m-%d}" if facts.begun else ""),
    ]


def _named(names: Sequence[str], what: str) -> str:
    return ", ".join(names) if len(names) <= MOST_NAMED else f"{len(names)} {what}"
