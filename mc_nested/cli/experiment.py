"""What the verbs that train many runs share: options, --resume, and training all of it with one view."""

import os
from pathlib import Path
from typing import Annotated, Any

import typer

from mc_nested.cli.experiment_progress import ExperimentProgress
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.standing import Standing
from mc_nested.cli.unit_processes import UnitProcesses
from mc_nested.errors import RunError, UserError
from mc_nested.learn.experiment_folder import Config, ExperimentFolder
from mc_nested.learn.unit_training import UnitOutcome
from mc_nested.learn.units import Unit

MOST_JOBS, MOST_TRIALS = 256, 1000
"""More would only wait for memory."""

Outcomes = list[tuple[Unit, UnitOutcome]]
"""What came out of every unit of a finished experiment."""

SeedOption = Annotated[int | None, typer.Option(min=0, help="the same seed gives the same results [0]")]
JobsOption = Annotated[
    int | None, typer.Option(min=1, max=MOST_JOBS, help="processes to share it out to [as many as there are cores]")
]
OutOption = Annotated[Path | None, typer.Option(metavar="DIR", help="a new or empty folder for all of it")]
ResumeOption = Annotated[Path | None, typer.Option(metavar="DIR", help="go on where it was stopped or killed")]


def cores() -> int:
    """Cores that this process may use."""
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(usable, MOST_JOBS)


def refuse_beside_resume(options: dict[str, Any]) -> None:
    """UserError where anything but --resume was given: what is resumed goes on with its own config."""
    for name, value in options.items():
        if name != "resume" and value not in (None, [], ()):
            raise UserError(f"--resume goes on with its own config.toml: leave out --{name.replace('_', '-')}")


def new_folder_needed(out: Path | None) -> Path:
    """The folder that was named; UserError where none was."""
    if out is None:
        raise UserError("name a new folder with --out DIR, or one to go on with, --resume DIR")
    return out


def trained(folder: ExperimentFolder[Config]) -> Outcomes:
    """What came out of all units, trained so far as they aren't yet.

    Stopped where somebody asked to stop, RunError where a unit failed: all are saved, and the message says how to go
    on.
    """
    before = folder.outcomes()
    folder.begin()
    missing = [(unit, folder.of_unit(unit)) for unit, outcome in before if outcome is None]
    if missing:
        progress = ExperimentProgress(folder.verb, Standing(before))
        with catch_interrupts() as interrupt, UnitProcesses(min(folder.config.jobs, len(missing))) as processes:
            try:
                with progress:
                    processes.train(missing, interrupt, progress.watch)
            except RunError as error:
                raise RunError(f"{error}; {folder.how_to_go_on} goes on from what was saved") from error
        if interrupt.requested:
            raise Stopped(f"stopped and saved: go on with {folder.how_to_go_on}")
    return [(unit, outcome) for unit, outcome in folder.outcomes() if outcome]
