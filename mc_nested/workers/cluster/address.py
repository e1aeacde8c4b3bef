"""Which scheduler, and how it is spoken to: encrypted, with certificates on both ends, wherever others could listen."""

import ipaddress
import ssl
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import urlsplit

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster.keys import AUTHORITY, CERTIFICATE, KEY

PORT = 8786
"""A Dask scheduler's, unless it is told another."""


@dataclass(frozen=True)
class SchedulerAddress:
    """A scheduler's address, as Dask takes it, and the folder of this machine's keys; None for plain TCP."""

    url: str
    keys: Path | None


def scheduler_address(text: str, keys: Path | None = None, *, insecure: bool = False) -> SchedulerAddress:
    """Return the scheduler that ``tcp://HOST:PORT``, ``tls://HOST:PORT`` or ``HOST:PORT`` means.

    Without a scheme it is TLS, except on this computer where no keys are named.

    Args:
        text: what the user wrote.
        keys: the folder of this machine's certificate and key (keys.py).
        insecure: whether plain TCP to another computer was asked for.

    Raises:
        ClusterError: it is no address, TLS lacks keys, or plain TCP would leave this computer.
    """
    scheme, host, port = _parts_of(text)
    is_here = _is_loopback(host)
    if not scheme:
        scheme = "tcp" if keys is None and (is_here or insecure) else "tls"
    if scheme not in ("tcp", "tls"):
        raise ClusterError(f"{text}: {scheme}:// is not spoken here: write tls://HOST:PORT, or tcp://127.0.0.1:PORT")
    url = f"{scheme}://{f'[{host}]' if ':' in host else host}:{port}"
    if scheme == "tls":
        return SchedulerAddress(url, _checked_keys(url, keys))
    if keys is not None:
        raise ClusterError(f"{url} is plain TCP, which takes no keys: write tls://, or leave out --keys")
    if not is_here and not insecure:
        raise ClusterError(
            f"{url} is not encrypted, and whoever reaches it can run programs here: make keys with mc-nested "
            f"train keys, then write tls:// and --keys; or pass --insecure in a network that is yours alone"
        )
    return SchedulerAddress(url, None)


def _parts_of(text: str) -> tuple[str, str, int]:
    """Return scheme, host and port; ClusterError if they can't be told."""
    try:
        parts = urlsplit(text if "://" in text else f"//{text}")
        host, port = parts.hostname, parts.port
    except ValueError as error:
        raise ClusterError(f"{text!r} is no address of a scheduler: write HOST:PORT") from error
    if not host or port == 0 or parts.username or any((parts.path, parts.query, parts.fragment)) or " " in text:
        raise ClusterError(f"{text!r} is no address of a scheduler: write HOST:PORT")
    return parts.scheme, host, port or PORT


def is_local(address: SchedulerAddress) -> bool:
    """Return whether that scheduler is on this computer, and named so."""
    return _is_loopback(_parts_of(address.url)[1])


def _is_loopback(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:  # a name, of whatever computer
        return False


def _checked_keys(url: str, keys: Path | None) -> Path:
    if keys is None:
        raise ClusterError(
            f"{url} needs this machine's keys: name their folder with --keys (mc-nested train keys makes them)"
        )
    missing = next((name for name in (AUTHORITY, CERTIFICATE, KEY) if not (keys / name).is_file()), None)
    if missing:
        raise ClusterError(f"{keys}: no {missing} there: name a machine's folder that mc-nested train keys made")
    try:
        ssl.create_default_context(cafile=keys / AUTHORITY).load_cert_chain(keys / CERTIFICATE, keys / KEY)
    except OSError as error:  # ssl.SSLError is one
        raise ClusterError(f"{keys}: damaged, or of two machines: copy that machine's whole folder again") from error
    return keys
