"""Processes of this computer that train a study's jobs; each takes the next job as soon as it is free.

Each talks to its parent through a pipe. The parent sends jobs; any message while a job trains, and the pipe's end,
mean: save and stop. The process sends JobReports, and one JobEnded for each job.
"""

import multiprocessing
import os
import signal
import sys
from collections.abc import Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from pathlib import Path
from queue import SimpleQueue
from threading import Lock

from mc_nested.errors import RunError
from mc_nested.studies.job import Job
from mc_nested.workers.executor import JobEnded, JobReport, train_job

REPORT_EVERY_S = 0.25
"""Seconds between two reports, and between two looks whether to stop."""


def serve_jobs(pipe: Connection) -> None:
    """Receive jobs and their folders, one by one, until None or the pipe's end: the process's main function."""
    stops: list[int] = []
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C reaches every process of a terminal: it is the parent's
    signal.signal(signal.SIGTERM, lambda number, _: stops.append(number))

    def report(now: JobReport) -> bool:
        try:
            pipe.send(now)
            return not (pipe.poll() or stops)
        except (EOFError, ConnectionError):
            return False

    try:
        while (task := pipe.recv()) is not None and not stops:
            job, folder = task
            pipe.send(train_job(job, folder, report, REPORT_EVERY_S))
    except (EOFError, ConnectionError):
        return  # the parent was killed; the job is saved


PATIENCE_S = 10.0
"""Seconds that a process may take to save its job."""

ONE_THREAD_EACH = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""For networks this small, a second thread only waits for the first."""


class JobProcesses:
    """The processes, as a context manager: none outlives the block. A JobExecutor: a thread waits for each process.

    Args:
        count: how many.
    """

    def __init__(self, count: int) -> None:
        self._processes: list[_Process] = []
        self._idle: SimpleQueue[_Process] = SimpleQueue()
        self._reported: SimpleQueue[JobReport] = SimpleQueue()
        self._threads = ThreadPoolExecutor(count, "job")
        self._count = count

    def __enter__(self) -> "JobProcesses":
        with _not_interrupted(), _environment(ONE_THREAD_EACH):
            self._processes = [_Process() for _ in range(self._count)]
        for process in self._processes:
            self._idle.put(process)
        return self

    def __exit__(self, *_: object) -> None:
        self.stop()
        for process in self._processes:
            process.end()
        self._threads.shutdown()
        for process in self._processes:
            process.pipe.close()

    def submit(self, job: Job, folder: Path) -> Future[JobEnded]:
        try:
            return self._threads.submit(self._train, job, folder)
        except RuntimeError:  # it has been shut down, since a job that was submitted before has failed
            cancelled: Future[JobEnded] = Future()
            cancelled.cancel()
            return cancelled

    def reports(self) -> list[JobReport]:
        return [self._reported.get() for _ in range(self._reported.qsize())]

    def stop(self) -> None:
        self._cancel_waiting()
        for process in self._processes:
            process.ask_to_stop()

    def in_words(self) -> str:
        return ""

    def _train(self, job: Job, folder: Path) -> JobEnded:
        """Have an idle process train the job; RunError if the process is lost."""
        process = self._idle.get()
        try:
            if not process.say((job, folder)):
                return JobEnded(job.name, finished=False)
            while isinstance(heard := process.hear(), JobReport):
                self._reported.put(heard)
        finally:
            self._idle.put(process)  # a lost one, too: no thread may wait for it
        if heard is None or not heard.finished:
            self._cancel_waiting()  # before this thread takes the next
        if heard is None:
            raise RunError(process.how_it_was_lost())
        return heard

    def _cancel_waiting(self) -> None:
        self._threads.shutdown(wait=False, cancel_futures=True)


class _Process:
    """One process and the pipe to it; a thread hears what it says, and another may ask it to stop."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self._speaking = Lock()
        self._asked_to_stop = False
        self._process = context.Process(target=serve_jobs, args=(theirs,), daemon=True)
        self._process.start()
        theirs.close()  # so that the pipe ends when the process does

    def say(self, message: tuple[Job, Path]) -> bool:
        """Give it a job, unless it was asked to stop; return whether it was given."""
        with self._speaking, suppress(ConnectionError):  # it is gone, which ``hear`` will notice
            if not self._asked_to_stop:
                self.pipe.send(message)
        return not self._asked_to_stop

    def ask_to_stop(self) -> None:
        """Let it save what it trains, and end."""
        with self._speaking, suppress(ConnectionError):
            if not self._asked_to_stop:
                self._asked_to_stop = True
                self.pipe.send(None)

    def hear(self) -> JobReport | JobEnded | None:
        """Return its next message; None if it is gone."""
        try:
            heard: JobReport | JobEnded = self.pipe.recv()
        except (EOFError, ConnectionError):
            return None
        return heard

    def how_it_was_lost(self) -> str:
        self._process.join()
        code = self._process.exitcode or 0
        if code < 0:
            return f"a training process was killed ({signal.Signals(-code).name}): if nobody did, memory ran out"
        return f"a training process ended before its work was done (exit code {code})"

    def end(self) -> None:
        """Wait until it has saved and ended; kill it if it doesn't."""
        self._process.join(PATIENCE_S)
        if self._process.exitcode is None:
            self._process.kill()
            self._process.join()


@contextmanager
def _not_interrupted() -> Iterator[None]:
    """Keep Ctrl+C from processes started inside, even before their first line; here it comes after the block."""
    if sys.platform == "win32":
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


@contextmanager
def _environment(variables: dict[str, str]) -> Iterator[None]:
    before = {name: os.environ.get(name) for name in variables}
    os.environ.update(variables)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
