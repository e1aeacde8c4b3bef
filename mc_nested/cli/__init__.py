"""The command line: one file for each verb, what the verbs share, and the loops that train and show their progress."""

import io
import os
import signal
import sys
from collections.abc import Sequence
from typing import TextIO


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command and exit, as ``app.main``; Ctrl+C is also quiet while Python loads and ends."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a pipe may not know ε
    # One thread per process, set before anything is loaded: for products this small, two only wait for each other.
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    try:
        from mc_nested.cli.app import main as run

        run(arguments)
    except KeyboardInterrupt:
        print("mc-nested: stopped", file=sys.stderr)
        sys.exit(130)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        for stream in (sys.stdout, sys.stderr):
            _flush(stream)


def _flush(stream: TextIO) -> None:
    """Write what is left to print; if the reader is gone, drop it, or Python would exit with its own code, 120."""
    try:
        stream.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
