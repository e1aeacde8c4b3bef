"""JobExecutor: the seam between a study and whoever trains its jobs, its messages, and the loop that waits for jobs."""

from collections.abc import Callable, Sequence
from concurrent.futures import CancelledError, Future
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Protocol, TypeVar

from mc_nested.errors import RunError
from mc_nested.studies.job import Job


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
    found = _Found()
    stopping = False
    while waiting:
        if not stopping and (is_stopped() or found.failed or found.lost):
            stopping = True
            executor.stop()
        arrived = come_to(done, LOOK_EVERY_S)
        waiting -= len(arrived)
        for report in executor.reports():
            watch(report)
        for future in arrived:
            if ended := found.of(future, stopping):
                watch(ended)
        watch(None)
    if found.failed:
        raise RunError(found.failed)
    if found.lost and not is_stopped():  # stopping everything may stop the processes, too
        raise RunError(found.lost)


Item = TypeVar("Item")


def come_to(queue: "SimpleQueue[Item]", timeout_s: float) -> list[Item]:
    """Return what has come to the queue since the last call; wait so long for the first.

    It takes no longer for ten thousand than for one.
    """
    with suppress(Empty):
        first = queue.get(timeout=timeout_s)
        return [first, *(queue.get() for _ in range(queue.qsize()))]
    return []


class _Found:
    """Why the first job failed, and why the first was lost, in words; empty as long as none was."""

    def __init__(self) -> None:
        self.failed = ""
        self.lost = ""

    def of(self, future: Future[JobEnded], stopping: bool) -> JobEnded | None:
        """Return how that future's job ended.

        It is None if it was cancelled or lost. An error that isn't a RunError is a bug.
        """
        try:
            ended = future.result()
        except CancelledError:
            return None
        except RunError as error:
            self.lost = self.lost or str(error)
            return None
        self.failed = self.failed or ended.failed
        if not (ended.finished or ended.failed or stopping):
            self.lost = self.lost or "a training process was asked to stop"
        return ended
