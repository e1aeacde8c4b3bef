"""What one of an experiment's processes does with what comes through its pipe; here in this process."""

import os
import signal
from collections.abc import Iterator
from contextlib import ExitStack
from multiprocessing import Pipe
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Thread, Timer

import pytest

from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import OUTCOME, outcome_of
from mc_nested.workers.messages import JobEnded, JobReport
from mc_nested.workers.process import serve_jobs
from tests.learn.made_experiments import DOT, one_job

JOB = one_job("nested", [DOT], 2)


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


def asked_to_stop(pipe: tuple[Connection, Connection], folder: Path, job: Job = JOB) -> list[JobReport | JobEnded]:
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
            ours.send((JOB, tmp_path / name))
            while not said or not isinstance(said[-1], JobEnded):
                said.append(ours.recv())
            said.append(JobReport("", (), (), 0))
        ours.send(None)

    thread = Thread(target=parent)
    thread.start()
    serve_jobs(theirs)
    thread.join()
    assert said.count(JobEnded(JOB.name, finished=True)) == 2
    one, two = (outcome_of(JOB, tmp_path / name) for name in ("one", "two"))
    assert one
    assert two
    assert one.runs == two.runs


def test_asked_to_stop_it_saves_and_ends(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    report, ended = asked_to_stop(pipe, tmp_path)
    assert isinstance(report, JobReport)
    assert ended == JobEnded(JOB.name, finished=False)
    assert (tmp_path / "checkpoint").exists()


def test_without_its_parent_it_saves_and_ends(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    ours.send((JOB, tmp_path))
    ours.close()
    serve_jobs(theirs)
    assert (tmp_path / "checkpoint").exists()
    assert not (tmp_path / OUTCOME).exists()


def test_a_job_waits_until_a_process_without_its_parent_has_saved_it(
    pipe: tuple[Connection, Connection], tmp_path: Path
) -> None:
    with ExitStack() as other:
        other.enter_context(folder_lock(tmp_path))
        saved = Timer(0.2, other.close)
        saved.start()
        said = asked_to_stop(pipe, tmp_path)
        saved.join()
    assert said[-1] == JobEnded(JOB.name, finished=False)


def test_a_job_whose_folder_another_process_holds_is_reported(
    pipe: tuple[Connection, Connection], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mc_nested.workers.training.PATIENCE_S", 0.1)
    with folder_lock(tmp_path):
        (ended,) = asked_to_stop(pipe, tmp_path)
    assert isinstance(ended, JobEnded)
    assert ended.failed.startswith(f"{tmp_path}: process {os.getpid()} is writing there")


def test_ctrl_c_is_left_to_the_parent(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    ours, theirs = pipe
    ours.send(None)
    serve_jobs(theirs)
    signal.raise_signal(signal.SIGINT)
    assert list(tmp_path.iterdir()) == []


def test_a_checkpoint_of_something_else_is_reported(pipe: tuple[Connection, Connection], tmp_path: Path) -> None:
    asked_to_stop(pipe, tmp_path, one_job("nested", [DOT], 3))
    saved = {path.name: path.read_bytes() for path in (tmp_path / "checkpoint").iterdir()}
    (ended,) = asked_to_stop(pipe, tmp_path)
    assert isinstance(ended, JobEnded)
    assert "belongs to another scenario, agent or preset" in ended.failed
    assert {path.name: path.read_bytes() for path in (tmp_path / "checkpoint").iterdir()} == saved


def test_a_job_that_is_soon_over_is_reported_at_its_beginning_and_at_its_end(
    pipe: tuple[Connection, Connection], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("mc_nested.workers.process.REPORT_EVERY_S", 1e9)
    ours, theirs = pipe
    said: list[JobReport | JobEnded] = []

    def parent() -> None:
        ours.send((JOB, tmp_path))
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
    outcome = outcome_of(JOB, tmp_path)
    assert outcome
    assert list(last.scores) == [run.evaluations[-1].score for run in outcome.runs]
    assert last.updates == sum(run.updates for run in outcome.runs)
    assert ended == JobEnded(JOB.name, finished=True)
