"""The scheme of an address: TLS wherever others could listen, unless plain TCP is asked for."""

from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster.address import SchedulerAddress, scheduler_address
from mc_nested.workers.cluster.keys import AUTHORITY, CERTIFICATE, KEY, make_keys


@pytest.fixture
def keys(tmp_path: Path) -> Path:
    (made,) = make_keys(tmp_path, ["pc"])
    return made


@pytest.mark.parametrize(
    ("text", "url"),
    [
        ("tcp://127.0.0.1:8786", "tcp://127.0.0.1:8786"),
        ("127.0.0.1:9", "tcp://127.0.0.1:9"),
        ("localhost", "tcp://localhost:8786"),
        ("[::1]:77", "tcp://[::1]:77"),
        ("127.3.2.1", "tcp://127.3.2.1:8786"),
    ],
)
def test_an_address_on_this_computer_is_plain_tcp(text: str, url: str) -> None:
    assert scheduler_address(text) == SchedulerAddress(url, None)


@pytest.mark.parametrize("text", ["192.168.0.7:8786", "tls://192.168.0.7:8786", "tls://127.0.0.1:8786", "learner"])
def test_an_address_with_keys_is_tls(text: str, keys: Path) -> None:
    address = scheduler_address(text, keys)
    assert address.url.startswith("tls://")
    assert address.url.endswith(":8786")
    assert address.keys == keys


@pytest.mark.parametrize("text", ["192.168.0.7:8786", "learner:8786", "tls://127.0.0.1:8786"])
def test_tls_without_keys_is_refused(text: str) -> None:
    with pytest.raises(ClusterError, match=r"needs this machine's keys: .*--keys"):
        scheduler_address(text)


@pytest.mark.parametrize("text", ["tcp://192.168.0.7:8786", "tcp://learner", "tcp://[fe80::1]:8786"])
def test_plain_tcp_to_another_computer_is_refused_unless_asked_for(text: str) -> None:
    with pytest.raises(ClusterError, match=r"is not encrypted, .* or pass --insecure"):
        scheduler_address(text)
    assert scheduler_address(text, insecure=True).url.startswith("tcp://")


def test_insecure_means_plain_tcp_where_no_scheme_is_named() -> None:
    assert scheduler_address("10.0.0.1", insecure=True).url == "tcp://10.0.0.1:8786"


def test_keys_for_plain_tcp_are_refused(keys: Path) -> None:
    with pytest.raises(ClusterError, match="plain TCP, which takes no keys"):
        scheduler_address("tcp://127.0.0.1:8786", keys)


@pytest.mark.parametrize("name", [AUTHORITY, CERTIFICATE, KEY])
def test_a_folder_without_a_part_of_the_keys_is_refused(name: str, keys: Path) -> None:
    (keys / name).unlink()
    with pytest.raises(ClusterError, match=f"no {name} there"):
        scheduler_address("10.0.0.1", keys)


def test_certificate_and_key_of_two_machines_are_refused(keys: Path, tmp_path: Path) -> None:
    (other,) = make_keys(tmp_path, ["other"])
    (keys / KEY).write_bytes((other / KEY).read_bytes())
    with pytest.raises(ClusterError, match="damaged, or of two machines"):
        scheduler_address("10.0.0.1", keys)


@pytest.mark.parametrize(
    "text",
    [
        "",
        ":8786",
        "tcp://",
        "127.0.0.1:x",
        "127.0.0.1:0",
        "127.0.0.1:99999",
        "ftp://127.0.0.1",
        "a/b",
        "u@h",
        "h?x=1",
        "a b",
    ],
)
def test_an_invalid_address_is_refused_in_one_line(text: str) -> None:
    with pytest.raises(ClusterError) as caught:
        scheduler_address(text)
    assert "\n" not in str(caught.value)


@given(st.ip_addresses(), st.integers(1, 65535))
def test_an_address_of_another_computer_is_never_plain_tcp_by_default(host: object, port: int) -> None:
    is_loopback = str(host).startswith("127.") or str(host) == "::1"
    text = f"[{host}]:{port}" if ":" in str(host) else f"{host}:{port}"
    if is_loopback:
        assert scheduler_address(text).url == f"tcp://{text}"
    else:
        with pytest.raises(ClusterError):
            scheduler_address(text)
