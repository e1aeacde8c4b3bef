"""Train all jobs of a study that aren't finished, in processes here or on a cluster, and show how far they are."""

import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager

from mc_nested.cli.cluster_options import workers_of
from mc_nested.cli.interrupt import Stopped, catch_interrupts
from mc_nested.cli.output import Output
from mc_nested.cli.study_progress import StudyProgress, StudyStatus
from mc_nested.errors import RunError
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.trial import Outcomes
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.executor import JobExecutor, train_jobs
from mc_nested.workers.processes import JobProcesses

MOST_JOBS = 256
"""More would only run out of memory."""


def cores() -> int:
    """Count the cores that this process may use."""
    usable = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    return min(usable, MOST_JOBS)


def jobs_at_once(cluster: SchedulerAddress | None, output: Output) -> int:
    """Return into how many jobs the work is cut, about, unless asked for: as many as train at a time."""
    return min(workers_of(cluster, output), MOST_JOBS) if cluster else cores()


def train_all(folder: StudyFolder, output: Output, cluster: SchedulerAddress | None) -> Outcomes:
    """Train all jobs that aren't finished, here or on a cluster; return the outcomes of all.

    Raise Stopped if somebody asked to stop, or RunError if a job failed. All jobs are saved then, and the message says
    how to resume.
    """
    before = folder.outcomes()
    missing = [(job, folder.folder_of(job)) for job, outcome in before if outcome is None]
    with catch_interrupts() as interrupt, ExitStack() as stack:
        executor = stack.enter_context(_executor(cluster, min(folder.config.jobs, len(missing)))) if missing else None
        folder.begin()
        output.note(f"folder: {folder.path}")
        if executor:
            status = StudyStatus(before)
            view = StudyProgress(folder.config.study, status, output.progress, executor.in_words)
            progress = stack.enter_context(view)
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
