"""The Windows code, really run: a Windows Python under Wine, with this project's packages. Linux, as root.

    python scripts/windows.py setup                   fetch what is missing; a second run takes a second
    python scripts/windows.py test [-- ARGUMENTS]     set up, then pytest under Wine, on a screen of its own

Programs come with apt, the rest with pip, pinned with hashes (windows_parts.py); all of it stays in .windows/ (1.8 GB).
Nothing is left running. Exit code 2: the machine lacks something that the message names; 1: Wine did not start, or a
test failed.

Without arguments, pytest runs the unit tests of what differs on Windows, WHERE_WINDOWS_DIFFERS. What decides by its
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
from scripts.windows_parts import install_programs, install_python
from scripts.windows_session import Session, SessionError, make_prefix, open_session

CACHE = ROOT / ".windows"
STOPPED = 130
"""The exit code after Ctrl+C."""
LOOK_S = 1.0
"""Seconds between two looks at what pytest has printed."""

WHERE_WINDOWS_DIFFERS = {
    "tests/live/desktop": "windows, pictures, keys, the mouse, the clipboard and the clock, by Windows' own functions",
    "tests/live/input": "threads that release keys, and handlers of signals",
    "tests/live/test_devices_contract.py": "the devices as a whole",
    "tests/live/test_connection.py": "devices that are opened and released together",
    "tests/live/test_session.py": "devices that are opened and released together, and what a killed session leaves",
    "tests/live/profile": "profiles: found in a folder of the system's, written in one step, with its names of keys",
    "tests/live/recording": "recordings: written by a thread while a game is played, cut and read, after a kill, too",
    "tests/live/menus/test_reset.py": "a world's folder, copied and put back",
    "tests/live/menus/test_click_points.py": "a profile's pictures, by their names",
    "tests/live/vision/test_font.py": "fonts in jars and folders",
    "tests/live/vision/test_chat_region.py": "pictures that are kept as files",
    "tests/live/vision/test_read_pictures.py": "pictures that are read from files",
    "tests/calibration/doctor": "what the doctor asks the system: windows, keys, the clipboard, processes, files",
    "tests/calibration/font": "fonts, looked for where a system has its games",
    "tests/calibration/installation": "the game's folders, its processes and its options' file",
    "tests/calibration/report": "a report's file, and the names of this computer that it must not show",
    "tests/calibration/arena/test_undo.py": "a note in a file, written before anything is built",
    "tests/calibration/test_profiles.py": "profiles in files",
    "tests/calibration/test_step_profile.py": "profiles and pictures in files, and files that can't be written",
    "tests/view": "the view: a console's streams, keys and letters, and files that two programs share",
    "tests/sim/window": "the rehearsal window's keys, time and truth file",
    "tests/sim/client/game/test_realm.py": "a world's folder, which the client keeps as the game does",
    "tests/sim/client/test_world_reset.py": "a world's folder, copied and put back while its game runs",
    "tests/arena/test_scenario_file.py": "designs in files, by their paths and encodings",
    "tests/arena/test_corpus_file.py": "designs in files, by their paths and encodings",
    "tests/learn/runs/test_run_folder.py": "a run's files",
    "tests/workers/test_process.py": "processes: their start, their pipes and their end",
    "tests/workers/test_processes.py": "processes that end with their parent, and after a kill",
    "tests/cli/test_interrupt.py": "Ctrl+C",
    "tests/cli/test_output_folder.py": "folders' names",
    "tests/cli/test_rehearse.py": "one rehearsal at a time, by a lock in a folder of the system's",
    "tests/test_atomic_file.py": "files that are replaced in one step",
    "tests/test_file_lock.py": "locks, which Windows has of its own",
    "tests/test_toml_file.py": "files' encodings and ends of lines",
    "tests/test_other_processors.py": "a training's bytes, which do not differ",
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
