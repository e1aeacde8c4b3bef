"""How a job ended that a worker trained, and what is said of one that went wrong."""

from concurrent.futures import Future, wait
from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.workers.cluster.job_end import cancel, in_words, landed_from
from mc_nested.workers.cluster.job_task import Trained
from mc_nested.workers.messages import JobEnded
from tests.learn.made_experiments import DOT, one_job

JOB = one_job("nested", [DOT], 2)


def test_a_job_that_failed_changes_nothing_in_its_folder(tmp_path: Path) -> None:
    ended = JobEnded(JOB.name, finished=False, failed="too small a disk")
    folder = tmp_path / "jobs" / JOB.name
    assert landed_from(Trained(ended, {}, {}), folder) == ended
    assert not folder.exists()


def test_a_disk_error_is_reported_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "jobs").write_text("a file where the folder would be")
    folder = tmp_path / "jobs" / JOB.name
    with pytest.raises(RunError, match=r"can't be written .*: make room$"):
        landed_from(Trained(JobEnded(JOB.name, finished=True), {"outcome.json": b"{}"}, {}), folder)


def test_whoever_waits_for_a_cancelled_job_is_told() -> None:
    future: Future[JobEnded] = Future()
    cancel(future)
    assert wait([future], 0).done == {future}
    assert future.cancelled()


def test_a_users_mistake_is_reported_as_it_is_and_any_other_error_with_its_name() -> None:
    assert str(in_words(JOB, RunError("make room"))) == "make room"
    assert str(in_words(JOB, ValueError("odd"))) == f"job {JOB.name} failed on a worker: ValueError: odd"
