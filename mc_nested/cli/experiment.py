"""What the verbs that train many runs share: options, --resume, and training all jobs under one progress view."""

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer

from mc_nested.cli.cluster_options import workers_of
from mc_nested.cli.completion import complete_runs
from mc_nested.cli.experiment_progress import ExperimentProgress
from mc_nested.cli.experiment_status import ExperimentStatus
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.output import Output
from mc_nested.errors import RunError, UserError
from mc_nested.learn.experiments.experiment_folder import Config, ExperimentFolder
from mc_nested.learn.experiments.job_training import JobOutcome
from mc_nested.learn.experiments.jobs import Job
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.executor import JobExecutor, train_jobs
from mc_nested.workers.processes import JobProcesses

MOST_JOBS, MOST_TRIALS = 256, 1000
"""More would only run out of memory."""

BESIDE_RESUME = ("resume", "cluster", "keys", "insecure", "quiet", "as_json")
"""The options that an experiment can be resumed with."""

Outcomes = list[tuple[Job, JobOutcome]]
"""Every job of a finished experiment with its outcome."""

SeedOption = Annotated[int | None, typer.Option(min=0, help="the same seed gives the same results [0]")]
JobsOption = Annotated[
    int | None,
    typer.Option(
        min=1,
        max=MOST_JOBS,
        help="processes to train in; for a cluster, jobs [its cores]",
    ),
]
OutOption = Annotated[
    Path | None, typer.Option(metavar="DIR", help="a new or empty folder for all of it [one under runs, with the date]")
]
ResumeOption = Annotated[
    Path | None, typer.Option(metavar="DIR", help="go on where it was stopped or killed", autocompletion=complete_runs)
]


def cores() -> int:
    """Cores that this process may use."""
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(usable, MOST_JOBS)


def check_nothing_beside_resume(options: dict[str, Any]) -> None:
    """UserError if anything but --resume, or how to print, was given: a resumed experiment keeps its own config."""
    check_nothing_beside(options, BESIDE_RESUME, "--resume goes on with its own config.toml")


def check_nothing_beside(options: dict[str, Any], beside: Sequence[str], why: str) -> None:
    """UserError, which says why, if an option was given that isn't one of those."""
    for name, value in options.items():
        if name not in beside and value is not False and value not in (None, [], ()):
            raise UserError(f"{why}: leave out --{name.replace('_', '-')}")


def jobs_at_once(cluster: SchedulerAddress | None, output: Output) -> int:
    """Into how many jobs the work is cut, about, unless asked for: as many as are trained at a time."""
    return min(workers_of(cluster, output), MOST_JOBS) if cluster else cores()


def train_all(folder: ExperimentFolder[Config], output: Output, cluster: SchedulerAddress | None) -> Outcomes:
    """Train all jobs that aren't finished, here or on a cluster; return the outcomes of all.

    Stopped if somebody asked to stop, RunError if a job failed: all are saved, and the message says how to resume.
    """
    before = folder.outcomes()
    missing = [(job, folder.folder_of(job)) for job, outcome in before if outcome is None]
    with catch_interrupts() as interrupt, ExitStack() as stack:
        executor = stack.enter_context(_executor(cluster, min(folder.config.jobs, len(missing)))) if missing else None
        folder.begin()
        output.note(f"folder: {folder.path}")
        if executor:
            status = ExperimentStatus(before)
            progress = stack.enter_context(ExperimentProgress(folder.verb, status, output.progress, executor.in_words))
            try:
                train_jobs(executor, missing, lambda: interrupt.requested, progress.watch)
            except RunError as error:
                raise RunError(f"{error}; {folder.resume_command} goes on from what was saved") from error
        if interrupt.requested:
            raise Stopped(f"stopped and saved: go on with {folder.resume_command}")
    return [(job, outcome) for job, outcome in folder.outcomes() if outcome]


@contextmanager
def _executor(cluster: SchedulerAddress | None, processes: int) -> Iterator[JobExecutor]:
    if cluster is None:
        with JobProcesses(processes) as here:
            yield here
        return
    # Imported here: it is Dask's, which only a cluster needs.
    from mc_nested.workers.cluster.dask_jobs import DaskJobs

    with connected(cluster) as client:
        yield DaskJobs(client)
