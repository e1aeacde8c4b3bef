"""``mc-nested runs``: list the runs and experiments in a folder, look at one, rename it, delete it."""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.filesize import decimal
from rich.text import Text

from mc_nested.cli.fitting_table import FittingTable, facts_table
from mc_nested.cli.json_fields import epilog_of
from mc_nested.cli.output import JsonOption, Output
from mc_nested.cli.runs_folder import RUNS
from mc_nested.errors import RunError, UserError
from mc_nested.learn.runs.folder_changes import delete_folder, rename_folder
from mc_nested.studies.run_facts import RunFacts, facts_of, runs_in

MOST_NAMED = 3
"""Designs, agents or presets that a row names; of more it says how many."""

STYLES = {"finished": "green", "can be resumed": "yellow", "in use": "cyan", "damaged": "bold red"}

app = typer.Typer(help="List your runs, look at one, rename it, delete it.")

NameArgument = Annotated[str, typer.Argument(metavar="RUN", help=f"a folder, or its name in {RUNS}")]


@app.callback(invoke_without_command=True)
def runs(context: typer.Context, as_json: JsonOption = False) -> None:
    """List your runs, look at one, rename it, delete it; alone it lists those in runs/."""
    if context.invoked_subcommand is None:
        list_runs(RUNS, as_json)
    elif as_json:
        raise UserError(f"write --json at the end: mc-nested runs {context.invoked_subcommand} --json")


@app.command("list", epilog=epilog_of("runs list"))
def list_runs(
    folder: Annotated[Path, typer.Argument(metavar="[FOLDER]", help="where they are", show_default=False)] = RUNS,
    as_json: JsonOption = False,
) -> None:
    """List the runs in a folder [runs], with what they train, how far they are, and their scores."""
    found = runs_in(folder)
    lines = [f"{each.folder}: {each.why}" for each in found if each.state == "damaged"]
    shown = [_table(found), *lines] if found else [f"no runs in {folder}: mc-nested train makes one"]
    Output(as_json=as_json).result({"folder": folder, "runs": [_fields(each) for each in found]}, *shown)


@app.command(epilog=epilog_of("runs show"))
def show(run: NameArgument, as_json: JsonOption = False) -> None:
    """Show one run: what it trains, how far it is, its files."""
    facts = _known(run)
    files = sorted(entry.name + ("/" if entry.is_dir() else "") for entry in facts.folder.iterdir())
    rows = (*_facts(facts), ("why", facts.why), ("folder", str(facts.folder)), ("files", ", ".join(files)))
    Output(as_json=as_json).result({**_fields(facts), "files": files}, facts_table(rows))


@app.command()
def rename(
    run: NameArgument, name: Annotated[str, typer.Argument(metavar="NAME", help="its new name, in the same folder")]
) -> None:
    """Give a run another name."""
    typer.echo(f"renamed to {rename_folder(_known(run).folder, name)}")


@app.command()
def delete(
    runs: Annotated[list[str], typer.Argument(metavar="RUN...", help=f"folders, or their names in {RUNS}")],
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
    """The facts of the run of that name in runs/, or in that folder; RunError if there is none."""
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
    """The facts in words, by what they are."""
    done, most = facts.episodes_done, facts.episodes
    return [
        ("run", facts.folder.name),
        ("what", facts.verb),
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


def _fields(facts: RunFacts) -> dict[str, Any]:
    """The facts for a program."""
    return {
        "folder": facts.folder,
        "verb": facts.verb or None,
        "state": facts.state,
        "why": facts.why or None,
        "designs": facts.designs,
        "agents": facts.agents,
        "presets": facts.presets,
        "trials": facts.trials,
        "episodes_done": facts.episodes_done,
        "episodes": facts.episodes,
        "score": facts.score,
        "optimum": facts.optimum,
        "size": facts.size,
        "begun": facts.begun.isoformat(timespec="seconds") if facts.begun else None,
    }
