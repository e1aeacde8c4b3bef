"""An experiment's units trained by as many processes as it has jobs, each taking the next unit whenever it is free."""

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
from mc_nested.cli.unit_process import Ended, Report, train_units
from mc_nested.errors import RunError
from mc_nested.learn.units import Unit

LOOK_EVERY_S = 0.2
"""How long a Ctrl+C may go unnoticed while no process has anything to say."""

PATIENCE_S = 10.0
"""How long a process may take to save where it stands."""

ONE_THREAD_EACH = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
"""For networks this small, a second thread only waits for the first."""

Watch = Callable[[Report | Ended | None], None]
"""Is told what the processes say as they say it, and None now and then."""


class UnitProcesses:
    """The processes, from their start to their end; none outlives the block.

    Args:
        jobs: how many.
    """

    def __init__(self, jobs: int) -> None:
        self._jobs = jobs
        self._idle: list[_Process] = []
        self._busy: dict[Connection, _Process] = {}
        self._failed = ""
        self._lost = ""

    def __enter__(self) -> "UnitProcesses":
        with _not_interrupted(), _environment(ONE_THREAD_EACH):
            self._idle = [_Process() for _ in range(self._jobs)]
        return self

    def __exit__(self, *_: object) -> None:
        processes = (*self._idle, *self._busy.values())
        for process in processes:
            process.pipe.close()
        for process in processes:
            process.end()

    def train(self, units: Sequence[tuple[Unit, Path]], interrupt: Interrupt, watch: Watch) -> None:
        """Train them, each in its folder, until all are finished or somebody asks to stop, all of them saved then.

        RunError where a unit fails or a process is lost; the others are saved, too.
        """
        waiting = deque(units)
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
        if self._lost and not interrupt.requested:  # who stops everything may well stop the processes, too
            raise RunError(self._lost)

    def _give(self, waiting: deque[tuple[Unit, Path]]) -> None:
        while waiting and self._idle:
            process = self._idle.pop()
            process.say(waiting.popleft())
            self._busy[process.pipe] = process

    def _stop_all(self) -> None:
        for process in self._busy.values():
            if not process.told_to_stop:
                process.told_to_stop = True
                process.say(None)

    def _hear(self, process: "_Process") -> Report | Ended | None:
        heard = process.hear()
        if isinstance(heard, Report):
            return heard
        del self._busy[process.pipe]
        if heard is None:
            self._lost = self._lost or process.how_it_was_lost()
        elif heard.failed:
            self._failed = self._failed or heard.failed
        elif not (heard.finished or process.told_to_stop):
            self._lost = self._lost or "a training process was told to stop"
        if isinstance(heard, Ended) and heard.finished and not process.told_to_stop:
            self._idle.append(process)
        else:
            process.end()
        return heard


class _Process:
    """One process and the pipe to it."""

    def __init__(self) -> None:
        context = multiprocessing.get_context("spawn")
        self.pipe, theirs = context.Pipe()
        self.told_to_stop = False
        self._process = context.Process(target=train_units, args=(theirs,), daemon=True)
        self._process.start()
        theirs.close()  # so that the pipe ends when the process does

    def say(self, message: tuple[Unit, Path] | None) -> None:
        with suppress(ConnectionError):  # it is gone, which ``hear`` finds out
            self.pipe.send(message)

    def hear(self) -> Report | Ended | None:
        """What it says; None where it is gone."""
        try:
            heard: Report | Ended = self.pipe.recv()
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
        """Let it end by itself, in the middle of something after saving it; kill it where it doesn't."""
        self.pipe.close()
        self._process.join(PATIENCE_S)
        if self._process.exitcode is None:
            self._process.kill()
            self._process.join()


@contextmanager
def _not_interrupted() -> Iterator[None]:
    """What is started inside never sees Ctrl+C, not even before its first line; here it comes when the block ends."""
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
