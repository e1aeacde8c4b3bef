"""A connection to a Dask scheduler, for who gives out work and for who does it."""

import logging
import os
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from mc_nested.errors import ClusterError
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.keys import AUTHORITY, CERTIFICATE, KEY

if TYPE_CHECKING:  # the cluster extra's; loading it takes a second
    from distributed import Client, Security

CONNECT_S = 10.0
"""Seconds that a scheduler may take to answer."""

HOW_TO_INSTALL = "pip install 'mc-nested[cluster]'"


def check_installed() -> None:
    """ClusterError if Dask or cryptography isn't installed."""
    try:
        import cryptography  # noqa: F401 - only whether it is there
        import distributed  # noqa: F401
    except ImportError as error:
        raise ClusterError(f"a cluster needs Dask, which isn't installed: {HOW_TO_INSTALL}") from error


def security_of(address: SchedulerAddress) -> "Security":
    """What Dask needs for TLS: the authority, and this machine's pair for each part that it may play."""
    from distributed import Security

    if address.keys is None:
        return Security()
    own = {
        f"tls_{role}_{what}": str(address.keys / file)
        for role in ("client", "worker", "scheduler")
        for what, file in (("cert", CERTIFICATE), ("key", KEY))
    }
    return Security(tls_ca_file=str(address.keys / AUTHORITY), require_encryption=True, **own)


@contextmanager
def connected(address: SchedulerAddress) -> Iterator["Client"]:
    """A client of that scheduler; it listens on no port.

    ClusterError if none answers, or it refuses this machine's certificate, or its own isn't the authority's.
    """
    check_installed()
    from distributed import Client

    quieten()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of other versions: the workers say that, in a line of ours
            client = Client(
                address.url, security=security_of(address), timeout=CONNECT_S, set_as_default=False, name="mc-nested"
            )
    except (OSError, ValueError, TypeError) as error:
        raise ClusterError(unreachable(address)) from error
    try:
        yield client
    finally:
        client.close(timeout=CONNECT_S)


def unreachable(address: SchedulerAddress) -> str:
    """Why nothing came of a connection, as far as one end can tell."""
    if address.keys:
        return (
            f"no scheduler answered at {address.url} in {CONNECT_S:g} s: is it running there, with keys of the same "
            f"authority as {address.keys}?"
        )
    return (
        f"no scheduler answered at {address.url} in {CONNECT_S:g} s: start one there (dask scheduler), or mend the "
        f"address; one with keys is written tls://"
    )


def quieten() -> None:
    """Keep Dask's log off the terminal: what matters of it is said in this project's own words."""
    for name in ("distributed", "tornado.application", "asyncio"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    os.environ.setdefault("DASK_DISTRIBUTED__LOGGING__DISTRIBUTED", "critical")  # it sets its own when it is loaded
