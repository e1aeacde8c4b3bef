"""A job's task on a cluster's worker: its files there and back, and the words of its errors.

A Dask worker runs in this process, so that its folder can be looked at.
"""

from collections.abc import Iterator
from concurrent.futures import Future, wait
from pathlib import Path

import pytest
from distributed import Client, LocalCluster
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.studies.job import Job
from mc_nested.studies.outcome import OUTCOME
from mc_nested.workers.cluster.job_task import (
    Trained,
    cancel,
    files_below,
    in_words,
    land,
    landed_from,
    own_versions,
    packed,
    stop_training,
    train_on_worker,
    write_below,
)
from mc_nested.workers.executor import JobEnded
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.learn.made_experiments import DOT, one_job

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


JOB = one_job("nested", [DOT], 2)
LONG = one_job("nested", [DOT], 2, episodes=1_000_000)


@pytest.fixture(scope="module")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Client]:
    with (
        LocalCluster(
            n_workers=1,
            threads_per_worker=1,
            processes=False,
            dashboard_address=":0",
            local_directory=str(tmp_path_factory.mktemp("dask")),
        ) as cluster,
        Client(cluster, set_as_default=False) as connection,
    ):
        yield connection


def left(client: Client) -> list[str]:
    """Return what jobs have left on the worker's disk."""
    (folder,) = client.run(lambda dask_worker: dask_worker.local_directory).values()
    return [path.name for path in Path(folder).iterdir() if path.name.startswith("mc-nested")]


def train(client: Client, folder: Path, topic: str, job: Job = JOB) -> Trained:
    done: Trained = client.submit(
        train_on_worker,
        own_versions(),
        None,
        packed(job, folder),
        topic,
        pure=False,
    ).result()
    return done


def test_finished_job_sends_its_outcome_back_and_leaves_no_file_on_the_worker(client: Client, tmp_path: Path) -> None:
    done = train(client, tmp_path, "one")
    assert done.ended == JobEnded(JOB.name, finished=True)
    assert list(done.files) == [OUTCOME]
    assert len(done.events) == 2
    assert left(client) == []


def test_a_job_of_a_stopped_experiment_sends_its_checkpoint_back(client: Client, tmp_path: Path) -> None:
    client.run(stop_training, "stopped")
    done = train(client, tmp_path, "stopped", LONG)
    assert done.ended == JobEnded(LONG.name, finished=False)
    assert any(name.startswith("checkpoint/") for name in done.files)
    assert OUTCOME not in done.files
    assert left(client) == []


def test_reports_of_a_job_are_published_with_job_and_worker(client: Client, tmp_path: Path) -> None:
    train(client, tmp_path, "heard")
    reports = [event for _, event in client.get_events("heard")]
    assert [report["episodes"] for report in reports][-1] == [20, 20]
    assert {report["job"] for report in reports} == {JOB.name}
    assert {report["worker"] for report in reports} == set(client.scheduler_info()["workers"])


def test_a_job_whose_task_is_cancelled_ends(client: Client, tmp_path: Path) -> None:
    future = client.submit(train_on_worker, own_versions(), None, packed(LONG, tmp_path), "cancelled", pure=False)
    while not client.get_events("cancelled"):
        pass
    future.cancel()
    assert train(client, tmp_path, "after").ended.finished


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


def test_cancelled_job_wakes_whoever_waits_for_it() -> None:
    future: Future[JobEnded] = Future()
    cancel(future)
    assert wait([future], 0).done == {future}
    assert future.cancelled()


def test_users_mistake_is_reported_unchanged_and_any_other_error_with_job_and_type() -> None:
    assert str(in_words(JOB, RunError("make room"))) == "make room"
    assert str(in_words(JOB, ValueError("odd"))) == f"job {JOB.name} failed on a worker: ValueError: odd"


NAMES = st.sampled_from(["a", "b", "checkpoint/a", "checkpoint/deep/b"])


@given(files=st.dictionaries(NAMES, st.binary(max_size=20)))
def test_written_files_are_read_back(files: dict[str, bytes], tmp_path_factory: object) -> None:
    folder = tmp_path_factory.mktemp("files")  # type: ignore[attr-defined]  # pytest's
    write_below(folder, files)
    assert files_below(folder) == files


def test_missing_folder_has_no_files_to_send_and_a_lock_is_not_sent(tmp_path: Path) -> None:
    assert files_below(tmp_path / "none") == {}
    (tmp_path / LOCK).touch()
    assert files_below(tmp_path) == {}


def test_outcome_replaces_the_checkpoint(tmp_path: Path) -> None:
    write_below(tmp_path, {"checkpoint/old": b"1", LOCK: b""})
    land(tmp_path, {OUTCOME: b"{}"})
    assert files_below(tmp_path) == {OUTCOME: b"{}"}


def test_checkpoint_replaces_the_last_one_as_a_whole(tmp_path: Path) -> None:
    write_below(tmp_path, {"checkpoint/old": b"1", "checkpoint/both": b"1", "checkpoint.new/half": b"1"})
    land(tmp_path, {"checkpoint/new": b"2", "checkpoint/both": b"2"})
    assert files_below(tmp_path) == {"checkpoint/new": b"2", "checkpoint/both": b"2"}
