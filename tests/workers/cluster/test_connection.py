"""A real scheduler lets in machines with a certificate of its authority, and no others."""

import re
import socket
import ssl
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from mc_nested.errors import ClusterError, with_extra
from mc_nested.workers.cluster import connection
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import check_installed, connected
from mc_nested.workers.cluster.keys import AUTHORITY, CERTIFICATE, KEY, make_keys
from mc_nested.workers.games.game_worker import GameWorker
from scripts.programs import ROOT
from tests.dask_fixture import LEFTOVERS, leftovers
from tests.workers.cluster.dask_programs import scheduler, tls_words

__all__ = ["leftovers"]

pytestmark = LEFTOVERS


@pytest.fixture
def less_patient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wait shorter for an answer that doesn't come. One that comes may take seconds on a busy machine."""
    monkeypatch.setattr(connection, "CONNECT_S", 3.0)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("tls")
    make_keys(made / "own", ["learner", "pc"])
    make_keys(made / "other", ["pc"])
    return made


@pytest.fixture(scope="module")
def open_to_all(tmp_path_factory: pytest.TempPathFactory) -> Iterator[SchedulerAddress]:
    """Run a scheduler without TLS, and without a worker, which would take longer to start than all else here."""
    with scheduler(tmp_path_factory.mktemp("open")) as url:
        yield SchedulerAddress(url, None)


@pytest.fixture(scope="module")
def secured(folder: Path) -> Iterator[str]:
    with scheduler(folder, *tls_words(folder / "own" / "learner")) as url:
        yield url


def test_machine_with_a_certificate_of_the_authority_is_let_in(secured: str, folder: Path) -> None:
    assert secured.startswith("tls://")
    with connected(SchedulerAddress(secured, folder / "own" / "pc")) as client:
        assert client.nthreads() == {}


@pytest.mark.usefixtures("less_patient")
def test_machine_with_keys_of_another_authority_is_refused(secured: str, folder: Path) -> None:
    address = SchedulerAddress(secured, folder / "other" / "pc")
    with pytest.raises(ClusterError, match="with keys of the same authority as"), connected(address):
        pytest.fail("let in")


@pytest.mark.usefixtures("less_patient")
def test_a_certificate_of_another_authority_is_refused_even_if_it_trusts_the_schedulers(
    secured: str, folder: Path, tmp_path: Path
) -> None:
    for name in (CERTIFICATE, KEY):
        (tmp_path / name).write_bytes((folder / "other" / "pc" / name).read_bytes())
    (tmp_path / AUTHORITY).write_bytes((folder / "own" / "pc" / AUTHORITY).read_bytes())
    address = SchedulerAddress(secured, tmp_path)
    with pytest.raises(ClusterError, match="with keys of the same authority as"), connected(address):
        pytest.fail("let in")


@pytest.mark.usefixtures("less_patient")
def test_client_without_tls_is_refused_by_a_tls_scheduler(secured: str) -> None:
    address = SchedulerAddress(secured.replace("tls://", "tcp://"), None)
    with pytest.raises(ClusterError, match="one with keys is written tls://"), connected(address):
        pytest.fail("let in")


def is_let_in(address: str, keys: Path, *, certificate: bool) -> bool:
    """Return whether the listener there answers a peer that trusts it and speaks TLS, with or without a certificate."""
    context = ssl.create_default_context(cafile=str(keys / AUTHORITY))
    context.check_hostname = False
    if certificate:
        context.load_cert_chain(keys / CERTIFICATE, keys / KEY)
    host, port = address.removeprefix("tls://").rsplit(":", 1)
    with socket.create_connection((host, int(port)), 5) as plain:
        try:
            with context.wrap_socket(plain) as connection:
                return len(connection.recv(1)) == 1  # Dask's greeting
        except ConnectionError:
            return False
        except ssl.SSLError:  # with TLS 1.3 it is heard only now that the other end wants one
            return False


def test_the_scheduler_lets_nobody_in_without_a_certificate(secured: str, folder: Path) -> None:
    assert is_let_in(secured, folder / "own" / "pc", certificate=True)
    assert not is_let_in(secured, folder / "own" / "pc", certificate=False)


def test_game_refuses_a_peer_without_a_certificate_of_its_authority(secured: str, folder: Path) -> None:
    with GameWorker(SchedulerAddress(secured, folder / "own" / "pc"), "pc", lambda _: None) as game:
        address = str(game._worker.address)
        assert is_let_in(address, folder / "own" / "learner", certificate=True)
        assert not is_let_in(address, folder / "own" / "learner", certificate=False)
        assert not is_let_in(address, folder / "other" / "pc", certificate=True)


LISTENING = """
import psutil, sys
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.connection import connected

with connected(SchedulerAddress(sys.argv[1], None)):
    print([each.laddr.port for each in psutil.Process().net_connections() if each.status == "LISTEN"])
"""
"""A program that connects, and prints the ports on which it listens then."""


def test_a_client_listens_on_no_port(open_to_all: SchedulerAddress) -> None:
    pytest.importorskip("psutil")
    # A program of its own: in this one, clients of other tests may still be closing.
    program = [sys.executable, "-c", LISTENING, open_to_all.url]
    done = subprocess.run(program, cwd=ROOT, capture_output=True, text=True, check=False)
    assert (done.stdout, done.returncode) == ("[]\n", 0), done.stderr


@pytest.mark.usefixtures("less_patient")
def test_a_client_with_keys_refuses_a_scheduler_without_tls(open_to_all: SchedulerAddress, folder: Path) -> None:
    address = SchedulerAddress(open_to_all.url.replace("tcp://", "tls://"), folder / "own" / "pc")
    with pytest.raises(ClusterError, match="with keys of the same authority as"), connected(address):
        pytest.fail("let in")


def test_a_missing_scheduler_is_reported_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 0.5)
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


def test_a_connection_that_comes_too_late_is_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(connection, "CONNECT_S", 0.1)
    monkeypatch.setattr(connection, "LONGER_S", 0.0)
    may_come, is_closed = threading.Event(), threading.Event()

    class LateClient:
        def close(self, timeout: float) -> None:
            assert timeout == connection.CONNECT_S
            is_closed.set()

    def late(_: SchedulerAddress) -> LateClient:
        assert may_come.wait(10)
        return LateClient()

    monkeypatch.setattr(connection, "_new_client", late)
    with (
        pytest.raises(ClusterError, match=r"^no scheduler answered at"),
        connected(SchedulerAddress("tcp://a:1", None)),
    ):
        pytest.fail("it came in time")
    may_come.set()
    assert is_closed.wait(10)


def test_error_without_dask_says_how_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ClusterError, match=re.escape(with_extra("cluster"))):
        check_installed()
