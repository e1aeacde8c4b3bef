"""A real scheduler lets in who has its authority's certificate, and nobody else."""

import socket
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster import connection
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import check_installed, connected
from mc_nested.workers.cluster.keys import AUTHORITY, CERTIFICATE, KEY, make_keys
from scripts.dask_programs import scheduler, tls_words
from tests.dask_fixture import LEFTOVERS, leftovers

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


@pytest.fixture(autouse=True)
def less_patient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 3.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("tls")
    make_keys(made / "own", ["learner", "pc"])
    make_keys(made / "other", ["pc"])
    return made


@pytest.fixture(scope="module")
def secured(folder: Path) -> Iterator[str]:
    with scheduler(folder, *tls_words(folder / "own" / "learner")) as url:
        yield url


def test_a_machine_of_the_authority_is_let_in(secured: str, folder: Path) -> None:
    assert secured.startswith("tls://")
    with connected(SchedulerAddress(secured, folder / "own" / "pc")) as client:
        assert client.nthreads() == {}


def test_a_wrong_certificate_is_refused(secured: str, folder: Path) -> None:
    address = SchedulerAddress(secured, folder / "other" / "pc")
    with pytest.raises(ClusterError, match="with keys of the same authority as"), connected(address):
        pytest.fail("let in")


def test_a_certificate_of_another_authority_is_refused_even_if_it_trusts_the_schedulers(
    secured: str, folder: Path, tmp_path: Path
) -> None:
    for name in (CERTIFICATE, KEY):
        (tmp_path / name).write_bytes((folder / "other" / "pc" / name).read_bytes())
    (tmp_path / AUTHORITY).write_bytes((folder / "own" / "pc" / AUTHORITY).read_bytes())
    address = SchedulerAddress(secured, tmp_path)
    with pytest.raises(ClusterError, match="with keys of the same authority as"), connected(address):
        pytest.fail("let in")


def test_without_a_certificate_nobody_is_let_in(secured: str) -> None:
    address = SchedulerAddress(secured.replace("tls://", "tcp://"), None)
    with pytest.raises(ClusterError, match="one with keys is written tls://"), connected(address):
        pytest.fail("let in")


def test_a_scheduler_without_tls_is_refused_by_who_has_keys(cluster: SchedulerAddress, folder: Path) -> None:
    address = SchedulerAddress(cluster.url.replace("tcp://", "tls://"), folder / "own" / "pc")
    with pytest.raises(ClusterError, match="with keys of the same authority as"), connected(address):
        pytest.fail("let in")


def test_a_client_listens_on_no_port(cluster: SchedulerAddress) -> None:
    psutil = pytest.importorskip("psutil")
    before = {each.laddr.port for each in psutil.Process().net_connections() if each.status == "LISTEN"}
    with connected(cluster):
        assert {each.laddr.port for each in psutil.Process().net_connections() if each.status == "LISTEN"} == before


def test_a_scheduler_that_is_not_there_is_said_in_one_line() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = SchedulerAddress(f"tcp://127.0.0.1:{port}", None)
    with pytest.raises(ClusterError, match=r"^no scheduler answered at .*: start one there"), connected(address):
        pytest.fail("there is none")


def test_a_scheduler_that_hangs_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 0.5)
    monkeypatch.setattr(connection, "LONGER_S", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as hangs:
        address = SchedulerAddress(f"tcp://127.0.0.1:{hangs.getsockname()[1]}", None)
        with pytest.raises(ClusterError, match=r"^no scheduler answered at"), connected(address):
            pytest.fail("it doesn't answer")


def test_without_dask_it_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ClusterError, match=r"pip install 'mc-nested\[cluster\]'"):
        check_installed()
