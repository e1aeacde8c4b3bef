"""Processes of a study: each gets jobs, and all save theirs if one fails, is lost or is stopped.

The processes are threads here, at the ends of real pipes, and train nothing.
"""

import dataclasses
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Thread, Timer
from types import SimpleNamespace

import pytest

from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import OUTCOME, outcome_of
from mc_nested.workers import processes as job_processes
from mc_nested.workers.executor import JobEnded, JobReport, train_jobs
from mc_nested.workers.processes import ONE_THREAD_EACH, JobProcesses, serve_jobs
from tests.learn.made_experiments import DOT, one_job

JOB = one_job("nested", [DOT], 1)

Ending = JobEnded | int
"""How a job ends: with a message, or with the process, of which this is the exit code."""

Act = Callable[[Connection], Ending]


class KeptEnd:
    """A pipe's end that stays open when the parent closes its copy, as in another process."""

    def __init__(self, pipe: Connection) -> None:
        self.pipe = pipe

    def close(self) -> None:
        pass


class ThreadProcess:
    """A process that is a thread; it keeps what it saw of its surroundings at its start."""

    def __init__(self, target: Callable[[Connection], int], args: tuple[KeptEnd], daemon: bool) -> None:
        assert daemon
        self.exitcode: int | None = None
        self.was_killed = False
        self._pipe = args[0].pipe
        self._target = target
        self._thread = threading.Thread(target=self._run, daemon=True)

    def start(self) -> None:
        self.threads = {name: os.environ.get(name) for name in ONE_THREAD_EACH}
        self.blocked = signal.pthread_sigmask(signal.SIG_BLOCK, []) if sys.platform != "win32" else {signal.SIGINT}
        self._thread.start()

    def _run(self) -> None:
        try:
            code = self._target(self._pipe)
            if not self.was_killed:
                self.exitcode = code
        finally:
            self._pipe.close()

    def join(self, timeout: float | None = None) -> None:
        if not self.was_killed:
            self._thread.join(timeout)

    def kill(self) -> None:
        self.was_killed = True
        self.exitcode = -9
        self._pipe.close()


class Workers:
    """The acts of the processes on each job, by its name; a job without an act is finished at once."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.acts: dict[str, Act] = {}
        self.trained: list[tuple[str, Path]] = []
        self.processes: list[ThreadProcess] = []
        context = SimpleNamespace(Pipe=self._pipe, Process=self._process)
        made = SimpleNamespace(get_context=lambda kind: {"spawn": context}[kind])
        monkeypatch.setattr(job_processes, "multiprocessing", made)
        monkeypatch.setattr(job_processes, "serve_jobs", self._work)

    def _pipe(self) -> tuple[Connection, KeptEnd]:
        ours, theirs = Pipe()
        return ours, KeptEnd(theirs)

    def _process(self, **arguments: object) -> ThreadProcess:
        self.processes.append(ThreadProcess(**arguments))  # type: ignore[arg-type]  # as they come
        return self.processes[-1]

    def _work(self, pipe: Connection) -> int:
        try:
            while (task := pipe.recv()) is not None:
                job, folder = task
                self.trained.append((job.name, folder))
                ending = self.acts[job.name](pipe) if job.name in self.acts else JobEnded(job.name, finished=True)
                if isinstance(ending, int):
                    return ending
                pipe.send(ending)
        except (EOFError, ConnectionError):
            pass
        return 0


@pytest.fixture
def workers(monkeypatch: pytest.MonkeyPatch) -> Workers:
    return Workers(monkeypatch)


def jobs_of(*names: str) -> list[tuple[Job, Path]]:
    return [(dataclasses.replace(JOB, name=name), Path(name)) for name in names]


def train(count: int, *names: str, stopped: threading.Event | None = None) -> list[JobReport | JobEnded]:
    """Train these jobs, and return what is heard of them until all is over."""
    heard: list[JobReport | JobEnded] = []
    is_stopped = (stopped or threading.Event()).is_set
    with JobProcesses(count) as processes:
        train_jobs(processes, jobs_of(*names), is_stopped, lambda message: heard.append(message) if message else None)
    return heard


def never() -> bool:
    return False


def until_asked(name: str) -> Act:
    """Train until it is asked to stop, and save."""

    def act(pipe: Connection) -> Ending:
        assert pipe.poll(10)
        return JobEnded(name, finished=False)

    return act


def once_it_trains(workers: Workers, other: str, ending: Ending) -> Act:
    """Return an act that ends so as soon as the other job is being trained."""

    def act(_: Connection) -> Ending:
        deadline = time.monotonic() + 10
        while other not in (name for name, _ in workers.trained):
            assert time.monotonic() < deadline
            time.sleep(0.001)
        return ending

    return act


def test_each_job_is_trained_once_in_its_folder_and_in_order(workers: Workers) -> None:
    heard = train(1, "a", "b", "c")
    assert workers.trained == [("a", Path("a")), ("b", Path("b")), ("c", Path("c"))]
    assert heard == [JobEnded(name, finished=True) for name in "abc"]
    assert len(workers.processes) == 1


def test_a_process_that_is_free_takes_the_next_job_while_another_trains(workers: Workers) -> None:
    others_done = threading.Event()

    def wait_for_others(_: Connection) -> Ending:
        assert others_done.wait(10)
        return JobEnded("long", finished=True)

    def last(_: Connection) -> Ending:
        others_done.set()
        return JobEnded("c", finished=True)

    workers.acts = {"long": wait_for_others, "c": last}
    heard = train(2, "long", "a", "b", "c")
    assert [message.job for message in heard[:2]] == ["a", "b"]
    assert sorted(name for name, _ in workers.trained) == ["a", "b", "c", "long"]


def test_every_message_of_a_process_is_passed_on_and_now_and_then_none(workers: Workers) -> None:
    report = JobReport("a", (3,), (None,), 7)

    def act(pipe: Connection) -> Ending:
        pipe.send(report)
        return JobEnded("a", finished=True)

    workers.acts["a"] = act
    heard: list[JobReport | JobEnded | None] = []
    with JobProcesses(1) as processes:
        train_jobs(processes, jobs_of("a"), never, heard.append)
    assert [message for message in heard if message] == [report, JobEnded("a", finished=True)]
    assert None in heard


def test_failed_job_ends_the_training_and_the_other_jobs_are_saved(workers: Workers) -> None:
    failed = JobEnded("a", finished=False, failed="the disk is full")
    workers.acts = {"a": once_it_trains(workers, "b", failed), "b": until_asked("b")}
    with pytest.raises(RunError, match=r"^the disk is full$"):
        train(2, "a", "b", "c")
    assert {name for name, _ in workers.trained} == {"a", "b"}
    assert [process.exitcode for process in workers.processes] == [0, 0]


@pytest.mark.parametrize(
    ("ending", "says"),
    [
        (-9, r"a training process was killed \(SIGKILL\): if nobody did, memory ran out"),
        (-15, r"a training process was killed \(SIGTERM\)"),
        (3, r"a training process ended before its work was done \(exit code 3\)"),
        (0, r"a training process ended before its work was done \(exit code 0\)"),
        (JobEnded("a", finished=False), "a training process was asked to stop"),
    ],
)
def test_lost_process_ends_the_training_with_its_reason_and_no_further_job_is_begun(
    ending: Ending, says: str, workers: Workers
) -> None:
    if sys.platform == "win32" and isinstance(ending, int) and ending < 0:
        pytest.skip("Windows has no signals for other processes")
    workers.acts = {"a": once_it_trains(workers, "b", ending), "b": until_asked("b")}
    with pytest.raises(RunError, match=f"^{says}"):
        train(2, "a", "b", "c")
    assert {name for name, _ in workers.trained} == {"a", "b"}


def test_failed_job_is_reported_rather_than_a_lost_process(workers: Workers) -> None:
    def fail_when_asked(pipe: Connection) -> Ending:
        pipe.poll(10)
        return JobEnded("b", finished=False, failed="the disk is full")

    workers.acts = {"a": once_it_trains(workers, "b", 3), "b": fail_when_asked}
    with pytest.raises(RunError, match="the disk is full"):
        train(2, "a", "b")


def test_stop_request_saves_the_jobs_in_training_and_is_not_an_error(workers: Workers) -> None:
    stopped = threading.Event()

    def interrupted(pipe: Connection) -> Ending:
        stopped.set()
        return until_asked("a")(pipe)

    workers.acts = {"a": interrupted, "b": until_asked("b")}
    heard = train(2, "a", "b", "c", stopped=stopped)
    assert sorted(heard, key=lambda ended: ended.job) == [JobEnded(name, finished=False) for name in "ab"]


def test_process_lost_during_a_stop_is_not_an_error(workers: Workers) -> None:
    stopped = threading.Event()

    def stopped_with_its_parent(_: Connection) -> Ending:
        stopped.set()
        return -2

    workers.acts["a"] = stopped_with_its_parent
    assert train(1, "a", "b", stopped=stopped) == []
    assert workers.trained == [("a", Path("a"))]


def test_a_process_that_does_not_end_is_killed(workers: Workers, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(job_processes, "PATIENCE_S", 0.05)
    end = threading.Event()

    def never_saves(pipe: Connection) -> Ending:
        pipe.send(JobReport("a", (), (), 0))
        end.wait(10)
        return 0

    def give_up(_: object) -> None:
        raise KeyboardInterrupt

    workers.acts["a"] = never_saves
    with pytest.raises(KeyboardInterrupt), JobProcesses(2) as processes:
        train_jobs(processes, jobs_of("a"), never, give_up)
    end.set()
    assert sorted(process.was_killed for process in workers.processes) == [False, True]
    assert all(process.exitcode is not None for process in workers.processes)


def test_processes_start_with_one_thread_each_and_with_ctrl_c_blocked(
    workers: Workers, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second, _ = ONE_THREAD_EACH
    monkeypatch.setenv(first, "5")
    monkeypatch.delenv(second, raising=False)
    train(2, "a")
    for process in workers.processes:
        assert set(process.threads.values()) == {"1"}
        assert signal.SIGINT in process.blocked
    assert (os.environ[first], second in os.environ) == ("5", False)
    if sys.platform != "win32":
        assert signal.SIGINT not in signal.pthread_sigmask(signal.SIG_BLOCK, [])


SHORT_JOB = one_job("nested", [DOT], 2)


@pytest.fixture
def pipe() -> Iterator[tuple[Connection, Connection]]:
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}
    ours, theirs = Pipe()
    yield ours, theirs
    ours.close()
    theirs.close()
    for number, handler in before.items():
        signal.signal(number, handler)


def heard(pipe: Connection) -> list[JobReport | JobEnded]:
    messages = []
    while pipe.poll():
        messages.append(pipe.recv())
    return messages


def asked_to_stop(
    pipe: tuple[Connection, Connection], folder: Path, job: Job = SHORT_JOB
) -> list[JobReport | JobEnded]:
    """Return what is said where a job is to be trained, and to be saved at once."""
    ours, theirs = pipe
    ours.send((job, folder))
    ours.send(None)
    serve_jobs(theirs)
    return heard(ours)


def test_jobs_are_trained_one_after_the_other(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    said: list[JobReport | JobEnded] = []

    def parent() -> None:
        for name in ("one", "two"):
            ours.send((SHORT_JOB, tmp_path / name))
            while not said or not isinstance(said[-1], JobEnded):
                said.append(ours.recv())
            said.append(JobReport("", (), (), 0))
        ours.send(None)

    thread = Thread(target=parent)
    thread.start()
    serve_jobs(theirs)
    thread.join()
    assert said.count(JobEnded(SHORT_JOB.name, finished=True)) == 2
    one, two = (outcome_of(SHORT_JOB, tmp_path / name) for name in ("one", "two"))
    assert one
    assert two
    assert one.runs == two.runs


def test_process_that_is_asked_to_stop_saves_a_checkpoint_and_ends(
    pipe: tuple[Connection, Connection], tmp_path: Path
) -> None:
    report, ended = asked_to_stop(pipe, tmp_path)
    assert isinstance(report, JobReport)
    assert ended == JobEnded(SHORT_JOB.name, finished=False)
    assert (tmp_path / "checkpoint").exists()


def test_process_whose_parent_is_gone_saves_a_checkpoint_and_ends(
    pipe: tuple[Connection, Connection], tmp_path: Path
) -> None:
    ours, theirs = pipe
    ours.send((SHORT_JOB, tmp_path))
    ours.close()
    serve_jobs(theirs)
    assert (tmp_path / "checkpoint").exists()
    assert not (tmp_path / OUTCOME).exists()


def test_job_waits_until_another_process_has_released_its_folder(
    pipe: tuple[Connection, Connection], tmp_path: Path
) -> None:
    with ExitStack() as other:
        other.enter_context(folder_lock(tmp_path))
        saved = Timer(0.2, other.close)
        saved.start()
        said = asked_to_stop(pipe, tmp_path)
        saved.join()
    assert said[-1] == JobEnded(SHORT_JOB.name, finished=False)


def test_a_job_whose_folder_another_process_holds_is_reported(
    pipe: tuple[Connection, Connection], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mc_nested.workers.executor.PATIENCE_S", 0.1)
    with folder_lock(tmp_path):
        (ended,) = asked_to_stop(pipe, tmp_path)
    assert isinstance(ended, JobEnded)
    assert ended.failed.startswith(f"{tmp_path}: process {os.getpid()} is writing there")


def test_process_ignores_ctrl_c(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    ours.send(None)
    serve_jobs(theirs)
    signal.raise_signal(signal.SIGINT)
    assert list(tmp_path.iterdir()) == []


def test_checkpoint_of_another_scenario_is_reported_and_kept(
    pipe: tuple[Connection, Connection], tmp_path: Path
) -> None:
    asked_to_stop(pipe, tmp_path, one_job("nested", [DOT], 3))
    saved = {path.name: path.read_bytes() for path in (tmp_path / "checkpoint").iterdir()}
    (ended,) = asked_to_stop(pipe, tmp_path)
    assert isinstance(ended, JobEnded)
    assert "belongs to another scenario, agent or preset" in ended.failed
    assert {path.name: path.read_bytes() for path in (tmp_path / "checkpoint").iterdir()} == saved


def test_short_job_is_reported_at_its_beginning_and_at_its_end(
    pipe: tuple[Connection, Connection], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mc_nested.workers.processes.REPORT_EVERY_S", 1e9)
    ours, theirs = pipe
    said: list[JobReport | JobEnded] = []

    def parent() -> None:
        ours.send((SHORT_JOB, tmp_path))
        while not (said and isinstance(said[-1], JobEnded)):
            said.append(ours.recv())
        ours.send(None)

    thread = Thread(target=parent)
    thread.start()
    serve_jobs(theirs)
    thread.join()
    first, last, ended = said
    assert isinstance(first, JobReport)
    assert isinstance(last, JobReport)
    assert (list(first.episodes), tuple(first.scores), first.updates) == ([0, 0], (None, None), 0)
    outcome = outcome_of(SHORT_JOB, tmp_path)
    assert outcome
    assert list(last.scores) == [run.evaluations[-1].score for run in outcome.runs]
    assert last.updates == sum(run.updates for run in outcome.runs)
    assert ended == JobEnded(SHORT_JOB.name, finished=True)
