"""The loop over an experiment's jobs, with an executor whose futures the test sets."""

from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.studies.job import Job
from mc_nested.workers.executor import JobEnded, JobReport, train_jobs
from tests.learn.made_experiments import DOT, one_job

JOB = one_job("nested", [DOT], 1)
JOBS = [(JOB, Path("a")), (JOB, Path("b"))]


class MadeExecutor:
    """Calls ``act``, which ends jobs, at every look."""

    def __init__(self, act: Callable[["MadeExecutor"], None]) -> None:
        self.futures: list[Future[JobEnded]] = []
        self.stopped = 0
        self.looks = 0
        self._act = act

    def submit(self, _job: Job, _folder: Path) -> Future[JobEnded]:
        self.futures.append(Future())
        return self.futures[-1]

    def reports(self) -> list[JobReport]:
        self.looks += 1
        self._act(self)
        return [JobReport("a", (), (), self.looks)]

    def stop(self) -> None:
        self.stopped += 1

    def in_words(self) -> str:
        return ""


def finished(executor: MadeExecutor) -> None:
    for future in executor.futures:
        if not future.done():
            future.set_result(JobEnded("a", finished=True))


def never() -> bool:
    return False


def test_every_report_and_every_job_end_is_passed_on() -> None:
    heard: list[JobReport | JobEnded | None] = []
    executor = MadeExecutor(finished)
    train_jobs(executor, JOBS, never, heard.append)
    assert heard.count(JobEnded("a", finished=True)) == 2
    assert JobReport("a", (), (), 1) in heard
    assert None in heard
    assert executor.stopped == 0


def test_train_jobs_without_jobs_returns() -> None:
    train_jobs(MadeExecutor(finished), [], never, lambda _: None)


def test_failed_job_stops_the_others_once_and_is_reported_after_they_are_saved() -> None:
    def act(executor: MadeExecutor) -> None:
        if executor.looks == 1:
            executor.futures[0].set_result(JobEnded("a", finished=False, failed="the disk is full"))
        elif executor.looks == 3:
            executor.futures[1].set_result(JobEnded("b", finished=False))

    executor = MadeExecutor(act)
    with pytest.raises(RunError, match=r"^the disk is full$"):
        train_jobs(executor, JOBS, never, lambda _: None)
    assert executor.stopped == 1


def test_failed_job_is_reported_rather_than_a_lost_process() -> None:
    def act(executor: MadeExecutor) -> None:
        if executor.looks == 1:
            executor.futures[0].set_exception(RunError("a process was killed"))
        elif executor.looks == 2:
            executor.futures[1].set_result(JobEnded("b", finished=False, failed="the disk is full"))

    with pytest.raises(RunError, match=r"^the disk is full$"):
        train_jobs(MadeExecutor(act), JOBS, never, lambda _: None)


def test_process_lost_after_a_stop_request_is_not_an_error() -> None:
    def act(executor: MadeExecutor) -> None:
        if executor.looks == 4:
            executor.futures[0].set_exception(RunError("a process was killed"))
            executor.futures[1].cancel()

    executor = MadeExecutor(act)
    train_jobs(executor, JOBS, lambda: executor.looks > 1, lambda _: None)
    assert executor.stopped == 1


def test_an_unexpected_error_passes_through() -> None:
    def act(executor: MadeExecutor) -> None:
        if executor.looks == 1:
            executor.futures[0].set_exception(ZeroDivisionError())

    with pytest.raises(ZeroDivisionError):
        train_jobs(MadeExecutor(act), JOBS, never, lambda _: None)
