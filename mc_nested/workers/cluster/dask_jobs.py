"""A JobExecutor whose jobs a cluster's workers train.

A worker that dies costs the jobs that it was training: they go to others, MOST_TRIES times at most. Each job's result
is taken once, whoever came to it.
"""

import uuid
import warnings
from collections import deque
from collections.abc import Iterable
from concurrent.futures import CancelledError, Future, wait
from contextlib import suppress
from pathlib import Path
from queue import SimpleQueue
from threading import RLock, Thread
from typing import TYPE_CHECKING, Any

from mc_nested.errors import RunError
from mc_nested.studies.job import Job
from mc_nested.workers.cluster.job_task import (
    GAME,
    Trained,
    cancel,
    in_words,
    landed_from,
    own_versions,
    packed,
    stop_training,
    train_on_worker,
)
from mc_nested.workers.executor import JobEnded, JobReport

if TYPE_CHECKING:  # the cluster extra's
    from distributed import Client

HELD_BACK = 4
"""Jobs for each worker that are held back at the end, until one is free."""

MOST_TRIES = 12
"""Times that a job is handed to the scheduler, which gives up after four workers that were lost with it. Nobody can
tell a job that takes more memory than there is from one whose workers were killed."""

SAVE_S = 60.0
"""Seconds that a worker may take to save its job."""

ALL = "all"
"""The topic under which a scheduler tells who comes and goes."""


class DaskJobs:
    """The workers of a cluster, for one study.

    Args:
        client: a connection to its scheduler.
    """

    def __init__(self, client: "Client") -> None:
        self._client = client
        self._executor = client.get_executor(pure=False)
        self._topic = f"mc-nested-{uuid.uuid4().hex}"
        self._held: deque[tuple[Job, Path, Future[JobEnded]]] = deque()
        self._handed_over = 0
        """Jobs that the scheduler has, and that haven't ended."""
        self._reported: SimpleQueue[JobReport] = SimpleQueue()
        self._futures: dict[str, Future[Trained]] = {}
        self._seen = ClusterWorkers(workers_that_train(client))
        self._lock = RLock()  # Dask tells what happens from threads of its own
        self._stopping = False
        client.subscribe_topic(self._topic, self._hear)
        client.subscribe_topic(ALL, self._hear_of_workers)

    def submit(self, job: Job, folder: Path) -> Future[JobEnded]:
        landed: Future[JobEnded] = Future()
        with self._lock:
            self._held.append((job, folder, landed))
        self._hand_over_more()
        return landed

    def reports(self) -> list[JobReport]:
        return [self._reported.get() for _ in range(self._reported.qsize())]

    def stop(self) -> None:
        with self._lock:
            self._stopping = True
            held, self._held = self._held, deque()
        for _, _, landed in held:
            landed.cancel()
        with self._lock:
            waiting = [future for name, future in self._futures.items() if not self._seen.trains(name)]
        for future in waiting:
            future.cancel()
        # In threads: one waits for every worker's answer, and one may be gone, or hang.
        for work in (self._stop_all, self._give_up):
            Thread(target=work, daemon=True).start()

    def _stop_all(self) -> None:
        with suppress(Exception):  # of a worker that is gone: its job is cancelled with it
            self._client.run(stop_training, self._topic, on_error="ignore")

    def _give_up(self) -> None:
        """Wait no longer for what doesn't come back."""
        wait(list(self._futures.values()), SAVE_S)
        for future in self._futures.values():
            future.cancel()

    def in_words(self) -> str:
        with self._lock:
            unfinished = len(self._held) + sum(not future.done() for future in self._futures.values())
            return self._seen.in_words(unfinished)

    def _hand_over_more(self) -> None:
        """Hand jobs to the scheduler, but hold the last of them back until a worker is free.

        Dask gives each worker a second job in advance, which another might begin sooner: with few and long ones left,
        that costs time. With many, waiting for a worker to be free would.
        """
        while True:
            with self._lock:
                workers = max(self._seen.count, 1)
                if not self._held or (len(self._held) <= HELD_BACK * workers and self._handed_over >= workers):
                    return
                self._handed_over += 1
                job, folder, landed = self._held.popleft()
            self._try_again(job, folder, landed, MOST_TRIES)

    def _hand_over(self, job: Job, folder: Path, landed: Future[JobEnded], tries: int) -> None:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of large tasks: a checkpoint has to get there
            # One group of tasks for Dask: its bookkeeping of groups takes longer with each group.
            key = (f"train-{self._topic}", job.name, tries)
            package = packed(job, folder)
            with self._lock:  # until it is known, nothing is heard of it
                # In the jobs' own order, the longest first: unless told, Dask would order them by name.
                asked = own_versions(job.arm.library), job.arm.library, package, self._topic
                trained = self._executor.submit(train_on_worker, *asked, key=key, priority=-len(self._futures))
                self._futures[job.name] = trained
        trained.add_done_callback(lambda done: self._land(job, folder, done, landed, tries - 1))

    def _hear(self, event: tuple[float, dict[str, Any]]) -> None:
        said = dict(event[1])
        worker, report = said.pop("worker"), JobReport(**said)
        with self._lock:
            if not self._futures[report.job].done():
                self._seen.begins(report.job, worker)
                self._reported.put(report)

    def _hear_of_workers(self, event: tuple[float, dict[str, Any]]) -> None:
        with self._lock:
            self._seen.note(event[1])
        self._hand_over_more()

    def _land(self, job: Job, folder: Path, done: Future[Trained], landed: Future[JobEnded], tries: int) -> None:
        """Put what came back into the job's folder; ``landed`` says how it ended. A lost job has so many tries left."""
        self._settle(job, folder, done, landed, tries)
        if landed.done():
            with self._lock:
                self._handed_over -= 1
            self._hand_over_more()

    def _settle(self, job: Job, folder: Path, done: Future[Trained], landed: Future[JobEnded], tries: int) -> None:
        from distributed import KilledWorker

        with self._lock:
            self._seen.ends(job.name)
        try:
            landed.set_result(landed_from(done.result(), folder))
        except CancelledError:
            if self._stopping:
                cancel(landed)
            else:
                landed.set_exception(RunError("the scheduler was lost, or dropped the jobs"))
        except KilledWorker as error:
            if tries and not self._stopping:
                self._try_again(job, folder, landed, tries)
            else:
                workers = (MOST_TRIES - tries) * (error.allowed_failures + 1)
                why = "if nobody stopped them, it needs more memory than they have"
                landed.set_exception(RunError(f"job {job.name} was lost with each of {workers} workers: {why}"))
        except Exception as error:
            landed.set_exception(in_words(job, error))

    def _try_again(self, job: Job, folder: Path, landed: Future[JobEnded], tries: int) -> None:
        try:
            self._hand_over(job, folder, landed, tries)
        except Exception as error:  # whatever it is, somebody waits for the job
            landed.set_exception(in_words(job, error))


def workers_that_train(client: "Client") -> list[str]:
    """Return the addresses of a scheduler's workers, but for games."""
    workers = client.scheduler_info()["workers"]
    return [address for address, each in workers.items() if GAME not in each["resources"]]


class ClusterWorkers:
    """Which workers of one study train which job, and which were lost, by their scheduler's events.

    Args:
        workers: the addresses of those that are there at the beginning.
    """

    def __init__(self, workers: Iterable[str]) -> None:
        self._workers = set(workers)
        self._trained_by: dict[str, str] = {}
        self._lost_workers = self._lost_jobs = 0

    @property
    def count(self) -> int:
        """How many workers there are."""
        return len(self._workers)

    def trains(self, job: str) -> bool:
        """Return whether one of them trains the job now."""
        return job in self._trained_by

    def begins(self, job: str, worker: str) -> None:
        """Note that the worker trains the job, since it has told of it."""
        self._trained_by[job] = worker

    def ends(self, job: str) -> None:
        """Note that nobody trains the job any more."""
        self._trained_by.pop(job, None)

    def note(self, said: dict[str, Any]) -> None:
        """Note an event of the scheduler's topic ``all``: a worker came, or went."""
        if said.get("action") == "add-worker":
            # A game is a worker, too. It isn't told apart here, and has no jobs to lose.
            self._workers.add(said["worker"])
        elif said.get("action") == "remove-worker":
            self._workers.discard(said["worker"])
            its_jobs = [name for name, worker in self._trained_by.items() if worker == said["worker"]]
            for name in its_jobs:
                del self._trained_by[name]
            if its_jobs or not said["expected"]:
                self._lost_workers += 1
                self._lost_jobs += len(its_jobs)

    def in_words(self, unfinished: int) -> str:
        """Say in a line how many workers there are, how many ``unfinished`` jobs train or wait, and what was lost."""
        training = len(self._trained_by)
        words = f"{counted(self.count, 'worker')}, {counted(training, 'job')} training, {unfinished - training} waiting"
        if self._lost_workers:
            words += f"; lost {counted(self._lost_workers, 'worker')}, {counted(self._lost_jobs, 'job')} begun again"
        return words


def counted(count: int, what: str) -> str:
    """Return ``1 worker``, ``2 workers``."""
    return f"{count:,} {what}" if count == 1 else f"{count:,} {what}s"
