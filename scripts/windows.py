"""The Windows code, really run: a Windows Python under Wine, with this project's packages. Linux, as root.

    python scripts/windows.py setup                   fetch what is missing; a second run takes a second
    python scripts/windows.py test [-- ARGUMENTS]     set up, then pytest under Wine, on a screen of its own

Programs come with apt, the rest with pip, pinned with hashes (windows_parts.py); all of it stays in .windows/ (1.8 GB).
Nothing is left running. Exit code 2: the machine lacks something that the message names; 1: Wine did not start, or a
test failed.

Without arguments, pytest runs the unit tests of what differs on Windows, windows/suite.txt. What decides by its
arguments alone, such as the rules of the arena, the reading of pictures and the simulator, does the same on every
system: a second run of some 2,500 such tests took 20 minutes, and never found anything that the first hadn't. What
differs is what is found by asking the system: its devices and windows, threads, clocks and processes, folders and files
with their names, locks, encodings and ends of lines, and the arithmetic that is compiled for it.
"""

import argparse
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.errors import RunError
from scripts.programs import ROOT, MissingError, alone
from scripts.window_display import wait_until
from scripts.windows_parts import PINS, install_programs, install_python
from scripts.windows_session import Session, SessionError, make_prefix, open_session

CACHE = ROOT / ".windows"
STOPPED = 130
"""The exit code after Ctrl+C."""
LOOK_S = 1.0
"""Seconds between two looks at what pytest has printed."""

WHERE_WINDOWS_DIFFERS = {
    place: why
    for place, _, why in (line.partition(": ") for line in (PINS / "suite.txt").read_text("utf-8").splitlines())
    if not place.startswith("#")
}
"""Folders and files of tests, and what of them Windows does in its own way."""

SUITE = ("-q", "-m", "not (slow or standin or realtime or window or wine)", *WHERE_WINDOWS_DIFFERS)
"""What pytest is given."""

PYTEST = ("-m", "pytest", "-p", "no:cacheprovider")


def main(arguments: Sequence[str] | None = None, cache: Path = CACHE) -> int:
    """Run the command; returns the exit code."""
    parser = argparse.ArgumentParser(description="The Windows code under Wine.")
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("setup", help="fetch what is missing")
    testing = commands.add_parser("test", help="run pytest under Wine")
    testing.add_argument("arguments", nargs="*", help="pytest's arguments, after --")
    wanted = parser.parse_args(arguments)
    try:
        with set_up(cache):
            if wanted.command == "setup":
                return 0
            with open_session(cache) as session:
                return run_pytest(session, wanted.arguments or SUITE)
    except MissingError as error:
        say(str(error))
        return 2
    except (RunError, SessionError) as error:
        say(str(error))
        return 1
    except KeyboardInterrupt:
        say("stopped; nothing is left running")
        return STOPPED


@contextmanager
def set_up(cache: Path) -> Iterator[None]:
    """Fetch and make what is missing; no other run uses the cache until the end of the block.

    Raises:
        MissingError: this machine can't have it; RunError: another run doesn't end; SessionError: Wine failed.
    """
    if sys.platform != "linux":
        raise MissingError("Wine needs Linux: on Windows itself, run pytest (this is for Debian, as root)")
    cache.mkdir(exist_ok=True)
    with alone(cache, say, "windows.py"):
        logs = cache / "logs"
        logs.mkdir(exist_ok=True)
        install_programs(say, logs / "apt.log")
        install_python(cache, say, logs / "pip.log")
        make_prefix(cache, say)
        yield


def run_pytest(session: Session, arguments: Sequence[str]) -> int:
    """Run pytest under Wine, its output as it comes; returns its exit code."""
    with session.started(*PYTEST, *arguments) as program:
        shown = 0
        while True:
            has_ended = wait_until(lambda: program.has_ended, LOOK_S)
            code = program.wait(LOOK_S) if has_ended else None
            printed = program.printed()
            print(printed[shown:], end="", flush=True)
            shown = len(printed)
            if code is not None:
                return code


def say(line: str) -> None:
    """Print one line of progress, or why it ended."""
    print(f"windows: {line}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(main())
