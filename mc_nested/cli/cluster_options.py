"""The options of verbs that can have their work done by a cluster."""

import time
from pathlib import Path
from typing import Annotated

import typer

from mc_nested.cli.output import Output
from mc_nested.errors import ClusterError
from mc_nested.workers.cluster.address import SchedulerAddress, scheduler_address
from mc_nested.workers.cluster.connection import connected
from mc_nested.workers.cluster.dask_jobs import workers_that_train

ClusterOption = Annotated[
    str | None,
    typer.Option(metavar="ADDRESS", help="let the workers of a Dask scheduler train, as tcp://127.0.0.1:8786"),
]
KeysOption = Annotated[
    Path | None, typer.Option(metavar="DIR", help="this machine's keys, for tls:// (mc-nested train keys)")
]
InsecureOption = Annotated[
    bool, typer.Option("--insecure", help="allow plain TCP to another computer; only in a network that is yours alone")
]

FIRST_WORKER_S = 60.0
"""Seconds that a cluster's first worker may take to come."""

LOOK_EVERY_S, NOTE_AFTER_S = 0.2, 1.0


def cluster_of(address: str | None, keys: Path | None, insecure: bool) -> SchedulerAddress | None:
    """Return the scheduler that was named, None if none was; raise ClusterError as ``scheduler_address`` raises it."""
    if address is not None:
        return scheduler_address(address, keys, insecure=insecure)
    if keys is not None or insecure:
        raise ClusterError("--keys and --insecure say how a cluster is spoken to: name one with --cluster")
    return None


def workers_of(cluster: SchedulerAddress, output: Output) -> int:
    """Wait for the first worker, and return how many there are; each trains one job at a time.

    Raise ClusterError if the scheduler can't be reached, or no worker comes.
    """
    with connected(cluster) as client:
        end, note_at = time.monotonic() + FIRST_WORKER_S, time.monotonic() + NOTE_AFTER_S
        while not (workers := len(workers_that_train(client))):
            now = time.monotonic()
            if now > end:
                raise ClusterError(
                    f"the scheduler at {cluster.url} has no worker: start some (dask worker {cluster.url} --nthreads 1)"
                )
            if now > note_at:
                output.note(f"waiting for a worker of {cluster.url}")
                note_at = end
            time.sleep(LOOK_EVERY_S)
        return workers
