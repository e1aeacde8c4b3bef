"""An authority and the pairs that it signs; OpenSSL, through Python's ssl, decides whether they are good."""

import socket
import ssl
import stat
import sys
import threading
from pathlib import Path

import pytest
from cryptography import x509

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster.keys import AUTHORITY, AUTHORITY_KEY, CERTIFICATE, KEY, make_keys


def context(folder: Path, purpose: ssl.Purpose) -> ssl.SSLContext:
    """Return a context as Dask makes it: each end shows its certificate, whose host isn't looked at."""
    made = ssl.create_default_context(purpose, cafile=str(folder / AUTHORITY))
    made.verify_flags |= ssl.VERIFY_X509_STRICT
    made.check_hostname = False
    made.verify_mode = ssl.CERT_REQUIRED
    made.load_cert_chain(folder / CERTIFICATE, folder / KEY)
    return made


def say_hello(server: Path, client: Path) -> bytes:
    """Return what the server's end hears of a client with these keys; SSLError or OSError if either refuses."""
    ours, theirs = socket.socketpair()

    def hello() -> None:
        try:
            with context(client, ssl.Purpose.SERVER_AUTH).wrap_socket(theirs) as secured:
                secured.sendall(b"hello")
        except OSError:
            theirs.close()

    thread = threading.Thread(target=hello)
    thread.start()
    try:
        with context(server, ssl.Purpose.CLIENT_AUTH).wrap_socket(ours, server_side=True) as secured:
            return secured.recv(5)
    finally:
        ours.close()
        thread.join()


def test_machines_of_one_authority_speak_with_each_other(tmp_path: Path) -> None:
    one, two = make_keys(tmp_path / "keys", ["one", "two"])
    assert say_hello(one, two) == b"hello"
    (three,) = make_keys(tmp_path / "keys", ["three"])
    assert say_hello(three, one) == b"hello"


def test_a_machine_of_another_authority_is_refused(tmp_path: Path) -> None:
    (own,) = make_keys(tmp_path / "own", ["one"])
    (other,) = make_keys(tmp_path / "other", ["one"])
    with pytest.raises(ssl.SSLError):
        say_hello(own, other)


def test_a_folder_holds_only_the_files_that_its_machine_needs(tmp_path: Path) -> None:
    (own,) = make_keys(tmp_path / "keys", ["pc"])
    assert {path.name for path in own.iterdir()} == {AUTHORITY, CERTIFICATE, KEY}
    assert {path.name for path in (tmp_path / "keys").iterdir()} == {AUTHORITY, AUTHORITY_KEY, "pc"}
    certificate = x509.load_pem_x509_certificate((own / CERTIFICATE).read_bytes())
    assert certificate.subject.rfc4514_string() == "CN=pc"


@pytest.mark.skipif(sys.platform == "win32", reason="Windows knows no such owner's rights")
def test_a_key_can_be_read_by_its_owner_alone(tmp_path: Path) -> None:
    (own,) = make_keys(tmp_path / "keys", ["pc"])
    for key in (own / KEY, tmp_path / "keys" / AUTHORITY_KEY):
        assert stat.S_IMODE(key.stat().st_mode) == 0o600


def test_a_machines_keys_are_never_replaced(tmp_path: Path) -> None:
    (own,) = make_keys(tmp_path, ["pc"])
    before = (own / KEY).read_bytes()
    with pytest.raises(ClusterError, match="is there already"):
        make_keys(tmp_path, ["other", "pc"])
    assert (own / KEY).read_bytes() == before
    assert not (tmp_path / "other").exists()


@pytest.mark.parametrize("name", ["", "a/b", "..", ".", AUTHORITY, "x" * 65])
def test_machine_name_that_no_folder_can_have_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(ClusterError, match="can't be a machine's name"):
        make_keys(tmp_path / "keys", [name])
    assert not (tmp_path / "keys").exists()


def test_a_machine_that_is_named_twice_is_refused_before_anything_is_made(tmp_path: Path) -> None:
    with pytest.raises(ClusterError, match="pc is named twice"):
        make_keys(tmp_path / "keys", ["pc", "other", "pc"])
    assert not (tmp_path / "keys").exists()


def test_authority_with_a_wrong_or_missing_key_is_refused(tmp_path: Path) -> None:
    make_keys(tmp_path / "a", ["pc"])
    make_keys(tmp_path / "b", ["pc"])
    (tmp_path / "a" / AUTHORITY_KEY).write_bytes((tmp_path / "b" / AUTHORITY_KEY).read_bytes())
    with pytest.raises(ClusterError, match="is another authority's"):
        make_keys(tmp_path / "a", ["new"])
    (tmp_path / "a" / AUTHORITY_KEY).unlink()
    with pytest.raises(ClusterError, match="are no whole authority"):
        make_keys(tmp_path / "a", ["new"])
