"""The options of a cluster: mistakes are one line, before anything is written."""

from pathlib import Path

import pytest

from mc_nested.cli import cluster_options
from mc_nested.cli.cluster_options import cluster_of, workers_of
from mc_nested.cli.output import Output
from mc_nested.errors import ClusterError
from mc_nested.workers.cluster.address import SchedulerAddress
from tests.cli.running import check_mistake
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.workers.cluster.dask_programs import scheduler

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


def test_keys_or_insecure_without_a_cluster_address_is_refused(tmp_path: Path) -> None:
    assert cluster_of(None, None, insecure=False) is None
    for keys, insecure in ((tmp_path, False), (None, True)):
        with pytest.raises(ClusterError, match="name one with --cluster"):
            cluster_of(None, keys, insecure=insecure)


def test_scheduler_that_gets_no_worker_in_time_is_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cluster_options, "FIRST_WORKER_S", 0.5)
    with scheduler(tmp_path) as url, pytest.raises(ClusterError, match="has no worker: start some"):
        workers_of(SchedulerAddress(url, None), Output(quiet=True))


@pytest.mark.parametrize("verb", ["reproduce", "study sweep", "study benchmark"])
@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["--cluster", "10.0.0.1"], "needs this machine's keys"),
        (["--cluster", "tcp://10.0.0.1"], "is not encrypted"),
        (["--cluster", "nowhere://x"], "is not spoken here"),
        (["--cluster", "127.0.0.1:PORT"], "no scheduler answered at tcp://127.0.0.1:PORT: start one there"),
        (["--insecure"], "name one with --cluster"),
    ],
)
def test_mistake_is_refused_in_one_line_and_nothing_is_written(
    verb: str,
    words: list[str],
    says: str,
    nobodys_port: str,
    trained: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = [word.replace("PORT", nobodys_port) for word in (*verb.split(), *words, "--out", "NEW")]
    check_mistake(words, says.replace("PORT", nobodys_port), trained, tmp_path, capsys)
