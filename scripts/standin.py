"""The stand-in: a real game window without Minecraft, for tests. Linux, standard library only.

    python scripts/standin.py up       fetch what is missing, then start it; ends when the debug screen shows
    python scripts/standin.py status   one line, and the state as JSON; exit code 0 when it is up, 1 when it is down
    python scripts/standin.py down     stop everything that `up` started

An X server (Xvfb) shows a browser with prismarine-web-client, joined to flying-squid, a Minecraft 1.18.2 server:
third-party programs, fetched with apt and npm and pinned in standin_parts.py. Everything listens only on 127.0.0.1, on
free ports. `up` prints the state, which is in .standin/state.json too: `display`, `window_title`, `oracle` (the address
that answers what standin/oracle.js lists), `font` (an ascii.png), `fonts` (a folder of them, by version), `profile` (of
mc-nested), `pids` and `logs`. Where it is already up, `up` prints that state. Exit code 2: the machine lacks something
that the message names; 1: the stand-in did not come up, or is down.
"""

import argparse
import json
import signal
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from scripts.cache_lock import BusyError, alone  # noqa: E402 - found only with the line above
from scripts.standin_game import Folders, start_game  # noqa: E402
from scripts.standin_keeper import stay_behind  # noqa: E402
from scripts.standin_oracle import answers  # noqa: E402
from scripts.standin_parts import FONTS, WEB_CLIENT, MissingError, fetch, install_programs, install_server  # noqa: E402
from scripts.standin_processes import StandinError, State, clean_up, load_state  # noqa: E402

STOPPED = 130
"""The exit code after Ctrl+C."""


def main(arguments: Sequence[str] | None = None, cache: Path = ROOT / ".standin") -> int:
    """Run the command; returns the exit code."""
    parser = argparse.ArgumentParser(description="A real game window without Minecraft, for tests.")
    parser.add_argument("command", choices=["up", "down", "status"])
    command = parser.parse_args(arguments).command
    if sys.platform != "linux":
        say("the stand-in needs Linux: run it in a Debian container or virtual machine (its programs come with apt)")
        return 2
    cache.mkdir(exist_ok=True)
    try:
        with alone(cache, say, "standin.py"):
            return {"up": up, "down": down, "status": status}[command](cache)
    except MissingError as error:
        say(str(error))
        return 2
    except (BusyError, StandinError) as error:
        say(str(error))
        return 1
    except KeyboardInterrupt:
        say("stopped; nothing is left running")
        return STOPPED


def up(cache: Path) -> int:
    """Start the stand-in, unless it is up, and print its state."""
    path = cache / "state.json"
    state = load_state(path)
    if state is not None and not _is_up(state):
        say("cleaning up after an earlier run")
        clean_up(state)
        state = None
    if state is None:
        folders = _fetched(cache)
        code = stay_behind(lambda: _start(path, folders))
        state = load_state(path)
        if code != 0 or state is None:
            return code or 1
    print(json.dumps(state.as_json()))
    return 0


def _start(path: Path, folders: Folders) -> int:
    """Start the game; when that fails, or Ctrl+C is pressed, stop what was started. Returns the exit code."""
    state = State(path, scratch=tempfile.mkdtemp(prefix="mc-nested-standin-"))
    try:
        state.save()
        start_game(state, folders, say)
    except (StandinError, KeyboardInterrupt) as error:
        # A second Ctrl+C would interrupt the stopping.
        for again in (signal.SIGINT, signal.SIGTERM):
            signal.signal(again, signal.SIG_IGN)
        clean_up(state)
        say(str(error) or "stopped; nothing is left running")
        return STOPPED if isinstance(error, KeyboardInterrupt) else 1
    except BaseException:
        clean_up(state)
        raise
    return 0


def down(cache: Path) -> int:
    """Stop everything that `up` started, whether or not it finished."""
    state = load_state(cache / "state.json")
    if state is not None:
        clean_up(state)
    say("the stand-in is down")
    return 0


def status(cache: Path) -> int:
    """Print whether the stand-in is up, and its state."""
    state = load_state(cache / "state.json")
    is_up = state is not None and _is_up(state)
    remains = state is not None and any(process.pids() for process in state.processes)
    line = "up" if is_up else "half up: take it down" if remains else "down"
    print(f"the stand-in is {line}\n{json.dumps(state.as_json() if state else {'ready': False})}")
    return 0 if is_up else 1


def say(line: str) -> None:
    """Print one line of progress, or why it ended."""
    print(f"standin: {line}", file=sys.stderr, flush=True)


def _is_up(state: State) -> bool:
    return state.is_up and answers(state.facts["oracle"])


def _fetched(cache: Path) -> Folders:
    logs = cache / "logs"
    logs.mkdir(exist_ok=True)
    install_programs(say, logs / "apt.log")
    return Folders(
        cache=cache,
        logs=logs,
        modules=install_server(cache, say, logs / "npm.log"),
        client=fetch(WEB_CLIENT, cache, say, logs / "npm.log"),
        fonts=fetch(FONTS, cache, say, logs / "npm.log"),
    )


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(main())
