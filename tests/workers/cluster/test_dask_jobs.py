"""Jobs on a real Dask worker: their outcome is the same as here, even if workers are lost."""

import dataclasses
import time
from collections.abc import Iterator
from concurrent.futures import Future
from contextlib import ExitStack
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from distributed import Client, KilledWorker

from mc_nested.errors import RunError
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import outcome_of
from mc_nested.workers.cluster import connection as connection_module
from mc_nested.workers.cluster import dask_jobs
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.cluster.dask_jobs import MOST_TRIES, DaskJobs
from mc_nested.workers.cluster.job_task import own_versions
from mc_nested.workers.executor import JobEnded, JobReport, train_job, train_jobs
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.learn.made_experiments import DOT, one_job
from tests.workers.cluster.dask_programs import scheduler, worker

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


JOB = one_job("nested", [DOT], 2)
LONG = one_job("nested", [DOT], 2, episodes=1_000_000)


@pytest.fixture
def client(cluster: SchedulerAddress) -> Iterator[Client]:
    with connected(cluster) as connection:
        connection.wait_for_workers(1)
        yield connection


class Heard:
    """Collects the messages of the jobs; stops them once ``until`` says so."""

    def __init__(self) -> None:
        self.messages: list[JobReport | JobEnded] = []

    def __call__(self, message: JobReport | JobEnded | None) -> None:
        if message:
            self.messages.append(message)

    @property
    def ended(self) -> list[JobEnded]:
        return [message for message in self.messages if isinstance(message, JobEnded)]

    @property
    def reports(self) -> list[JobReport]:
        return [message for message in self.messages if isinstance(message, JobReport)]


def never() -> bool:
    return False


def goes_on(_: JobReport) -> bool:
    return True


def named(job: Job, name: str) -> Job:
    return dataclasses.replace(job, name=name)


def test_job_on_a_worker_has_the_same_outcome_as_on_this_computer(client: Client, tmp_path: Path) -> None:
    here, there = tmp_path / "here" / "jobs" / JOB.name, tmp_path / "there" / "jobs" / JOB.name
    train_job(JOB, here, goes_on, 1.0)
    heard = Heard()
    train_jobs(DaskJobs(client), [(JOB, there)], never, heard)
    assert heard.ended == [JobEnded(JOB.name, finished=True)]
    assert list(heard.reports[-1].episodes) == [20, 20]
    ours, its = outcome_of(JOB, here), outcome_of(JOB, there)
    assert ours
    assert its
    assert ours.runs == its.runs
    assert [path.name for path in there.iterdir()] == ["outcome.json"]
    events = [path.name for path in (tmp_path / "there" / "tensorboard").iterdir()]
    assert sorted(events) == sorted(path.name for path in (tmp_path / "here" / "tensorboard").iterdir())


def test_job_on_a_worker_goes_on_from_a_checkpoint_of_this_computer(client: Client, tmp_path: Path) -> None:
    whole, cut = tmp_path / "whole" / "jobs" / JOB.name, tmp_path / "cut" / "jobs" / JOB.name
    train_job(JOB, whole, goes_on, 1.0)
    ticks = iter([True] * 30)
    assert not train_job(JOB, cut, lambda _: next(ticks, False), 0.0).finished
    heard = Heard()
    train_jobs(DaskJobs(client), [(JOB, cut)], never, heard)
    assert heard.reports[0].updates > 0
    one, other = outcome_of(JOB, whole), outcome_of(JOB, cut)
    assert one
    assert other
    assert one.runs == other.runs


def test_stop_brings_back_jobs_in_training_and_waiting_jobs_do_not_begin(client: Client, tmp_path: Path) -> None:
    jobs = [(named(LONG, name), tmp_path / "jobs" / name) for name in ("one", "two", "three")]
    heard = Heard()
    train_jobs(DaskJobs(client), jobs, lambda: bool(heard.reports), heard)
    assert heard.ended == [JobEnded("one", finished=False)]
    assert (tmp_path / "jobs" / "one" / "checkpoint").is_dir()
    assert not (tmp_path / "jobs" / "two").exists()
    # The worker is free again: what waited is gone from the scheduler.
    after = Heard()
    train_jobs(DaskJobs(client), [(JOB, tmp_path / "jobs" / JOB.name)], never, after)
    assert after.ended == [JobEnded(JOB.name, finished=True)]


def test_a_job_that_fails_is_not_tried_again(client: Client, tmp_path: Path) -> None:
    folder = tmp_path / "jobs" / JOB.name
    train_job(one_job("nested", [DOT], 3), folder, lambda _: False, 0.0)
    heard = Heard()
    with pytest.raises(RunError, match="belongs to another scenario, agent or preset"):
        train_jobs(DaskJobs(client), [(JOB, folder)], never, heard)
    assert len(heard.ended) == 1
    assert (folder / "checkpoint").is_dir()


def test_a_worker_with_other_versions_refuses_and_says_what_differs(
    client: Client, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dask_jobs, "own_versions", lambda _: {**own_versions(), "numpy": "0.1"})
    with pytest.raises(
        RunError, match=r"^the worker at tcp://.* has numpy .* instead of 0\.1: install the same on both$"
    ):
        train_jobs(DaskJobs(client), [(JOB, tmp_path / "jobs" / JOB.name)], never, Heard())


def test_a_client_that_is_gone_leaves_no_job_training(
    cluster: SchedulerAddress, client: Client, tmp_path: Path
) -> None:
    with connected(cluster) as other:
        executor = DaskJobs(other)
        executor.submit(LONG, tmp_path / "jobs" / LONG.name)
        end = time.monotonic() + 20
        while not executor.reports() and time.monotonic() < end:
            time.sleep(0.05)
    heard = Heard()
    train_jobs(DaskJobs(client), [(JOB, tmp_path / "jobs" / JOB.name)], never, heard)
    assert heard.ended == [JobEnded(JOB.name, finished=True)]


@pytest.mark.slow
def test_job_of_a_killed_worker_is_begun_again_and_counted_once(tmp_path: Path) -> None:
    with scheduler(tmp_path) as url, connected(SchedulerAddress(url, None)) as client:
        workers = [worker(tmp_path, url)]
        killed = False
        executor = DaskJobs(client)
        heard = Heard()

        def watch(message: JobReport | JobEnded | None) -> None:
            nonlocal killed
            heard(message)
            if heard.reports and not killed:
                killed = True
                workers[0].kill()
                workers.append(worker(tmp_path, url))

        try:
            jobs = [(named(one_job("nested", [DOT], 2, 500), name), tmp_path / "jobs" / name) for name in ("a", "b")]
            train_jobs(executor, jobs, never, watch)
            said = executor.in_words()
        finally:
            for each in workers:
                each.kill()
                each.wait()
        assert sorted(ended.job for ended in heard.ended) == ["a", "b"]
        assert all(outcome_of(job, folder) for job, folder in jobs)
        assert said == "1 worker, 0 jobs training, 0 waiting; lost 1 worker, 1 job begun again"


def test_scheduler_that_shuts_down_ends_the_jobs_with_an_error(tmp_path: Path) -> None:
    with scheduler(tmp_path) as url, connected(SchedulerAddress(url, None)) as client:
        running = worker(tmp_path, url)
        executor = DaskJobs(client)

        def watch(message: JobReport | JobEnded | None) -> None:
            if isinstance(message, JobReport):
                client.shutdown()

        try:
            with pytest.raises(RunError, match=r"^the scheduler was lost"):
                train_jobs(executor, [(LONG, tmp_path / "jobs" / LONG.name)], never, watch)
        finally:
            running.kill()
            running.wait()


@pytest.mark.slow
def test_scheduler_that_is_killed_ends_the_jobs_with_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection_module, "CONNECT_S", 1.0)
    with ExitStack() as stack:
        killed = ExitStack()
        url = killed.enter_context(scheduler(tmp_path))
        client = stack.enter_context(connected(SchedulerAddress(url, None)))
        running = worker(tmp_path, url)
        stack.callback(running.wait)
        stack.callback(running.kill)

        def watch(message: JobReport | JobEnded | None) -> None:
            if isinstance(message, JobReport):
                killed.close()

        with pytest.raises(RunError, match=r"^the scheduler was lost"):
            train_jobs(DaskJobs(client), [(LONG, tmp_path / "jobs" / LONG.name)], never, watch)


class LosingExecutor:
    """Loses each job with its workers, as a scheduler reports it."""

    def __init__(self) -> None:
        self.tried = 0

    def submit(self, *_: Any, **__: Any) -> Future[Any]:
        self.tried += 1
        lost: Future[Any] = Future()
        last: Any = SimpleNamespace(address="tcp://127.0.0.1:1")
        lost.set_exception(KilledWorker("job", last, 3))
        return lost


def test_job_that_is_lost_with_every_worker_is_given_up(tmp_path: Path) -> None:
    executor = LosingExecutor()
    client = SimpleNamespace(
        get_executor=lambda **_: executor,
        scheduler_info=lambda: {"workers": {}},
        subscribe_topic=lambda *_: None,
        run=lambda *_, **__: None,
    )
    with pytest.raises(
        RunError, match="was lost with each of 48 workers: if nobody stopped them, it needs more memory"
    ):
        train_jobs(DaskJobs(client), [(JOB, tmp_path / "jobs" / JOB.name)], never, Heard())  # type: ignore[arg-type]
    assert executor.tried == MOST_TRIES
