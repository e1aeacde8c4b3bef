"""A connection to a Dask scheduler, for who gives out work and for who does it."""

import logging
import warnings
from collections.abc import Callable, Iterator
from concurrent.futures import Future, wait
from contextlib import contextmanager
from threading import Thread
from typing import TYPE_CHECKING, TypeVar

from mc_nested.errors import ClusterError, with_extra
from mc_nested.workers.cluster.address import SchedulerAddress
from mc_nested.workers.cluster.keys import AUTHORITY, CERTIFICATE, KEY

if TYPE_CHECKING:  # the cluster extra's; loading it takes a second
    from distributed import Client, Security

CONNECT_S = 10.0
"""Seconds that a scheduler may take to answer."""

LONGER_S = 2.0
"""Seconds longer, before it is given up."""


def check_installed() -> None:
    """Raise ClusterError if Dask or cryptography isn't installed."""
    try:
        import cryptography  # noqa: F401 - only whether it is there
        import distributed  # noqa: F401 - likewise
    except ImportError as error:
        raise ClusterError(f"a cluster needs Dask, which isn't installed: {with_extra('cluster')}") from error


def security_of(address: SchedulerAddress) -> "Security":
    """Return what Dask needs for TLS: the authority, and this machine's pair for each part that it may play."""
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
    """Connect a client to that scheduler; it listens on no port.

    ClusterError if none answers, or it refuses this machine's certificate, or its own isn't the authority's.
    """
    check_installed()
    quieten()
    connection = _begin(lambda: _new_client(address))
    client = _in_time(connection)
    if not client:
        connection.add_done_callback(_close_late)
        raise ClusterError(unreachable(address))
    try:
        yield client
    finally:
        _in_time(_begin(lambda: client.close(timeout=CONNECT_S)))


def _close_late(connection: "Future[Client | None]") -> None:
    if client := connection.result():
        client.close(timeout=CONNECT_S)


def _new_client(address: SchedulerAddress) -> "Client | None":
    from distributed import Client

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of other versions: the workers say that, in a line of ours
            return Client(
                address.url, security=security_of(address), timeout=CONNECT_S, set_as_default=False, name="mc-nested"
            )
    except (OSError, ValueError, TypeError):
        return None


Result = TypeVar("Result")


def _begin(work: Callable[[], Result]) -> Future[Result]:
    """Run ``work`` in a thread that the program needn't wait for: Dask waits for ever for a scheduler that hangs."""
    done: Future[Result] = Future()

    def run() -> None:
        try:
            done.set_result(work())
        except BaseException as error:  # it is raised where it is waited for
            done.set_exception(error)

    Thread(target=run, name="dask-client", daemon=True).start()
    return done


def _in_time(done: Future[Result]) -> Result | None:
    """Return its result; None if it takes longer than CONNECT_S and LONGER_S."""
    wait([done], CONNECT_S + LONGER_S)
    return done.result() if done.done() else None


def unreachable(address: SchedulerAddress) -> str:
    """Return why nothing came of a connection, as far as one end can tell."""
    if address.keys:
        return (
            f"no scheduler answered at {address.url}: is it running there, with keys of the same authority as "
            f"{address.keys}?"
        )
    return (
        f"no scheduler answered at {address.url}: start one there (dask scheduler), or mend the address; one with keys "
        f"is written tls://"
    )


def quieten() -> None:
    """Keep Dask's log off the terminal: what matters of it is said in this project's own words."""
    import distributed.client  # noqa: F401 - it makes loggers, each with a level of its own

    for name in ("tornado", "asyncio", *list(logging.root.manager.loggerDict)):
        if name.split(".")[0] in ("distributed", "tornado", "asyncio"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
