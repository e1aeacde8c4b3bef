"""An experiment's jobs, trained by several processes; each takes the next job as soon as it is free."""

import multiprocessing
import os
import signal
import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection, wait
from pathlib import Path

from mc_nested.cli.interrupt import Interrupt
from mc_nested.cli.job_process import JobEnded, JobReport, train_jobs
from mc_nested.errors import RunError
from mc_nested.learn.experiments.jobs import Job

LOOK_EVERY_S = 0.2
"""Seconds that a Ctrl+C may go unnoticed while no process sends anything."""

PATIENCE_S = 10.0
"""Seconds that a process may take to save its job."""

ONE_THREAD_EACH = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""For networks this small, a second thread only waits for the first."""

Watch = Callable[[JobReport | JobEnded | None], None]
"""Called with each message of a process, and with None now and then."""


class JobProcesses:
    """The processes, as a context manager: none outlives the block.

    Args:
        count: how many.
    """

    def __init__(self, count: int) -> None:
        self._count = count
        self._idle: list[_Process] = []
        self._busy: dict[Connection, _Process] = {}
        self._failed = ""
        self._lost = ""

    def __enter__(self) -> "JobProcesses":
        with _not_interrupted(), _environment(ONE_THREAD_EACH):
            self._idle = [_Process() for _ in range(self._count)]
        return self

    def __exit__(self, *_: object) -> None:
        processes = (*self._idle, *self._busy.values())
        for process in processes:
            process.pipe.close()
        for process in processes:
            process.end()

    def train(self, jobs: Sequence[tuple[Job, Path]], interrupt: Interrupt, watch: Watch) -> None:
        """Train the jobs, each in its folder, until all are finished, or somebody asks to stop and all are saved.

        RunError if a job fails or a process is lost; the others are saved.
        """
        waiting = deque(jobs)
        self._give(waiting)
        while self._busy:
            if interrupt.requested or self._failed or self._lost:
                waiting.clear()
                self._stop_all()
            ready = wait(list(self._busy), LOOK_EVERY_S)
            for process in [process for pipe, process in self._busy.items() if pipe in ready]:
                watch(self._hear(process))
            watch(None)
            self._give(waiting)
        if self._failed:
            raise RunError(self._failed)
        if self._lost and not interrupt.requested:  # stopping everything may stop the processes, too
            raise RunError(self._lost)

    def _give(self, waiting: deque[tuple[Job, Path]]) -> None:
        while waiting and self._idle:
            process = self._idle.pop()
            process.say(waiting.popleft())
            self._busy[process.pipe] = process

    def _stop_all(self) -> None:
        for process in self._busy.values():
            if not process.asked_to_stop:
                process.asked_to_stop = True
                process.say(None)

    def _hear(self, process: "_Process") -> JobReport | JobEnded | None:
        heard = process.hear()
        if isinstance(heard, JobReport):
            return heard
        del self._busy[process.pipe]
        if heard is None:
            self._lost = self._lost or process.how_it_was_lost()
        elif heard.failed:
            self._failed = self._failed or heard.failed
        elif not (heard.finished or process.asked_to_stop):
            self._lost = self._lost or "a training process was asked to stop"
        if isinstance(heard, JobEnded) and heard.finished and not process.asked_to_stop:
            self._idle.append(process)
        else:
            process.end()
        return heard


class _Process:
    """One process and the pipe to it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.asked_to_stop = False
        self._process = context.Process(target=train_jobs, args=(theirs,), daemon=True)
        self._process.start()
        theirs.close()  # so that the pipe ends when the process does

    def say(self, message: tuple[Job, Path] | None) -> None:
        with suppress(ConnectionError):  # it is gone, which ``hear`` will notice
            self.pipe.send(message)

    def hear(self) -> JobReport | JobEnded | None:
        """Its next message; None if it is gone."""
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
        """Let it save and end by itself; kill it if it doesn't."""
        self.pipe.close()
        self._process.join(PATIENCE_S)
        if self._process.exitcode is None:
            self._process.kill()
            self._process.join()


@contextmanager
def _not_interrupted() -> Iterator[None]:
    """Processes started inside never get Ctrl+C, not even before their first line; here it comes after the block."""
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
