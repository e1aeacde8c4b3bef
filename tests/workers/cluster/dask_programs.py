"""Dask's own programs on this computer, on loopback: `dask scheduler` and `dask worker`, for tests."""

import json
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mc_nested.workers.cluster.keys import AUTHORITY, CERTIFICATE, KEY
from scripts.window_display import WITH_THIS_PROCESS

START_S = 60.0
"""Seconds that a program may take to start."""


@contextmanager
def scheduler(folder: Path, *words: str) -> Iterator[str]:
    """Run a scheduler with those words beside its own, on a free port; yield its address. It ends after the block.

    TimeoutError if it doesn't start; its log is in the folder.
    """
    told = folder / "scheduler.json"
    told.unlink(missing_ok=True)
    host = () if "--host" in words else ("--host", "127.0.0.1")
    running = _started(
        folder / "scheduler.log",
        "scheduler",
        *host,
        "--port",
        "0",
        "--no-dashboard",
        "--dashboard-address",
        "127.0.0.1:0",
        "--scheduler-file",
        str(told),
        *words,
    )
    try:
        end = time.monotonic() + START_S
        while not (address := _address_in(told)):
            if time.monotonic() > end or running.poll() is not None:
                raise TimeoutError(f"no scheduler: see {folder / 'scheduler.log'}")
            time.sleep(0.05)
        yield address
    finally:
        running.kill()
        running.wait()


def worker(folder: Path, address: str, *words: str) -> subprocess.Popen[bytes]:
    """Return a worker of one thread, without a nanny, with those words beside its own; it may not be connected yet."""
    here = ("--host", "127.0.0.1", "--no-dashboard", "--dashboard-address", "127.0.0.1:0")
    own = (*here, "--nthreads", "1", "--no-nanny", "--local-directory", str(folder))
    return _started(folder / "worker.log", "worker", address, *own, *words)


def tls_words(keys: Path) -> tuple[str, ...]:
    """Return the words with which either program takes a machine's keys."""
    return ("--tls-ca-file", str(keys / AUTHORITY), "--tls-cert", str(keys / CERTIFICATE), "--tls-key", str(keys / KEY))


def _started(log: Path, *words: str) -> subprocess.Popen[bytes]:
    program = [*(WITH_THIS_PROCESS if sys.platform == "linux" else ()), sys.executable, "-m", "dask", *words]
    with log.open("ab") as file:
        return subprocess.Popen(program, stdin=subprocess.DEVNULL, stdout=file, stderr=file)


def _address_in(told: Path) -> str | None:
    try:
        address: str = json.loads(told.read_text("utf-8"))["address"]
    except (OSError, ValueError, KeyError):
        return None
    return address
