"""A real Dask scheduler with a real worker, in separate processes."""

from collections.abc import Iterator

import pytest

from mc_nested.workers.cluster.address import SchedulerAddress
from tests.workers.cluster.dask_programs import scheduler, worker


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SchedulerAddress]:
    """Run a scheduler on loopback with one worker."""
    folder = tmp_path_factory.mktemp("cluster")
    with scheduler(folder) as url:
        running = worker(folder, url)
        try:
            yield SchedulerAddress(url, None)
        finally:
            running.kill()
            running.wait()
