"""What a worker does with a job; a Dask worker in this process, so that its folder can be looked at."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from distributed import Client, LocalCluster

from mc_nested.studies.job import Job
from mc_nested.studies.outcome import OUTCOME
from mc_nested.workers.cluster.job_task import Trained, packed, stop_training, train_on_worker
from mc_nested.workers.cluster.versions import own_versions
from mc_nested.workers.messages import JobEnded
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


def test_a_finished_job_sends_its_outcome_back_and_leaves_nothing(client: Client, tmp_path: Path) -> None:
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


def test_what_it_reports_can_be_heard(client: Client, tmp_path: Path) -> None:
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
