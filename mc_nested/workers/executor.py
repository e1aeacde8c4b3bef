"""JobExecutor: the seam between a study and whoever trains its jobs, its messages, and the loop that waits for jobs.

Whoever trains one does so here, too, in the job's folder, until it is finished or nobody wants it to go on.
"""

import re
import time
from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError, Future
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Protocol, TypeVar

from mc_nested.atomic_file import refused_as
from mc_nested.errors import RunError, UserError
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.report.tensorboard import FOLDER, TensorBoard, is_installed
from mc_nested.studies.job import Job
from mc_nested.studies.job_training import JobTraining, agents_trainer, team_of_job
from mc_nested.studies.sb3 import Sb3Training
from sim.grid import GridVectorEnv
from sim.team_grid import team_arenas


@dataclass(frozen=True)
class JobReport:
    """How far a job has got: training episodes and last greedy score of each run, None before the first; updates."""

    job: str
    episodes: Sequence[int]
    scores: Sequence[float | None]
    updates: int


@dataclass(frozen=True)
class JobEnded:
    """A job is finished, or was saved unfinished because it had to stop, or ``failed`` says why it failed."""

    job: str
    finished: bool
    failed: str = ""


LOOK_EVERY_S = 0.2
"""Seconds that a Ctrl+C may go unnoticed while no job ends."""

Watch = Callable[[JobReport | JobEnded | None], None]
"""Called with each message of a job, and with None now and then."""


class JobExecutor(Protocol):
    """Whoever trains jobs: processes here (processes.py), or a cluster's workers (cluster/dask_jobs.py)."""

    def submit(self, job: Job, folder: Path) -> Future[JobEnded]:
        """Let the job be trained, from where its folder has it; as ``concurrent.futures.Executor.submit``.

        By the time the future is done, the folder holds the outcome, or what a stopped job goes on from. Its exception
        is a UserError where the job was lost with its worker.
        """

    def reports(self) -> list[JobReport]:
        """Return what was reported since the last call, oldest first."""

    def stop(self) -> None:
        """Let what trains be saved; what hasn't begun is cancelled."""

    def in_words(self) -> str:
        """Return how many workers there are, what they do and which were lost; empty where there is nothing to say."""


def train_jobs(
    executor: JobExecutor, jobs: Sequence[tuple[Job, Path]], is_stopped: Callable[[], bool], watch: Watch
) -> None:
    """Train the jobs, each in its folder, until all are finished, or somebody asks to stop and all are saved.

    RunError if a job fails, or is lost with what trained it and doesn't go elsewhere; the others are saved.
    """
    done: SimpleQueue[Future[JobEnded]] = SimpleQueue()
    for job, folder in jobs:
        executor.submit(job, folder).add_done_callback(done.put)
    waiting = len(jobs)
    failed = lost = ""
    stopping = False
    while waiting:
        if not stopping and (is_stopped() or failed or lost):
            stopping = True
            executor.stop()
        arrived = come_to(done, LOOK_EVERY_S)
        waiting -= len(arrived)
        for report in executor.reports():
            watch(report)
        for end in map(_end_of, arrived):
            if isinstance(end, JobEnded):
                failed = failed or end.failed
                if not (end.finished or end.failed or stopping):
                    lost = lost or "a training process was asked to stop"
                watch(end)
            elif end:
                lost = lost or str(end)
        watch(None)
    if failed or (lost and not is_stopped()):  # stopping everything may stop the processes, too
        raise RunError(failed or lost)


def _end_of(future: Future[JobEnded]) -> JobEnded | RunError | None:
    """Return how that future's job ended: why it was lost, None if it was cancelled. Any other error is a bug."""
    try:
        return future.result()
    except CancelledError:
        return None
    except RunError as error:
        return error


Item = TypeVar("Item")


def come_to(queue: "SimpleQueue[Item]", timeout_s: float) -> list[Item]:
    """Return what has come to the queue since the last call; wait so long for the first.

    It takes no longer for ten thousand than for one.
    """
    with suppress(Empty):
        first = queue.get(timeout=timeout_s)
        return [first, *(queue.get() for _ in range(queue.qsize()))]
    return []


PATIENCE_S = 10.0
"""Seconds that a process whose parent was killed may take to save the job that another goes on with."""

TrainedJob = JobTraining | Sb3Training
"""A job that is trained in its folder, by whatever algorithm."""

Report = Callable[[JobReport], bool]
"""Is told how far a job has got; returns whether the job shall go on."""


def train_job(job: Job, folder: Path, report: Report, report_every_s: float) -> JobEnded:
    """Train the job from where its folder has it, until it is finished, or saved because ``report`` returned False.

    It is reported at its beginning, at its end, and every ``report_every_s`` seconds. What a user can mend, a full disk
    or too little memory, is said in what is returned.
    """
    try:
        with folder_lock(folder, PATIENCE_S):
            training = _training_of(job, folder)
            _tick_until_done(training, folder, report, report_every_s)
            if training.finished:
                training.finish()
            else:
                training.save()
    except UserError as error:
        return JobEnded(job.name, finished=False, failed=str(error))
    except MemoryError:
        return JobEnded(job.name, finished=False, failed="not enough memory: fewer --trials, or a smaller preset")
    return JobEnded(job.name, finished=training.finished)


def _training_of(job: Job, folder: Path) -> TrainedJob:
    if team := team_of_job(job):
        return JobTraining(job, folder, agents_trainer(job, team_arenas(team, len(job.trials))))
    arenas = GridVectorEnv(job.scenarios)
    if job.arm.library is None:
        return JobTraining(job, folder, agents_trainer(job, arenas))
    return Sb3Training(job, folder, arenas, GridVectorEnv(job.scenarios))


def _events(training: TrainedJob, folder: Path) -> TensorBoard | None:
    if not (isinstance(training, JobTraining) and is_installed()):
        return None
    job = training.job
    names = (re.sub(r"[^\w.-]+", "-", f"{run.arm.name}-{run.scenario.name}-{run.trial}") for run in job.runs)
    with refused_as(RunError, folder, "make room"):
        return TensorBoard([folder.parent.parent / FOLDER / name for name in names], training.trainer)


def _tick_until_done(training: TrainedJob, folder: Path, report: Report, report_every_s: float) -> None:
    report_at = time.monotonic()
    events = _events(training, folder)
    scores: list[float | None] = [None] * len(training.job.trials)
    seen = 0
    while True:
        # Reported before the first tick and after the last, too: a job may be over before a report is due.
        if training.finished or time.monotonic() >= report_at:
            report_at = time.monotonic() + report_every_s
            rows = training.evaluation_rows
            for row in rows[seen:]:
                scores[row.trial] = row.score
            seen = len(rows)
            now = JobReport(training.job.name, training.episodes_done.tolist(), tuple(scores), training.updates)
            if not report(now) or training.finished:
                return
        training.tick()
        if events:
            with refused_as(RunError, folder, "make room"):
                events.write()
