"""The stand-in: a real game window without Minecraft, for tests. Linux only.

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
import os
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from mc_nested.errors import RunError
from mc_nested.file_lock import file_lock
from scripts.programs import ROOT, MissingError, alone
from scripts.standin_game import KEEPER, LOOK_S, STATE, STOPPED, OracleError, StandinError, ask, say
from scripts.standin_parts import fetch_all
from scripts.window_display import wait_until

KEEP = (sys.executable, "-m", "scripts.standin_game")
"""The program that keeps the game, which takes the cache's folder."""
ENDS_S = 40.0
"""Seconds in which the keeper and all that it started must end."""


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
    except (RunError, StandinError) as error:
        say(str(error))
        return 1
    except KeyboardInterrupt:
        say("stopped; nothing is left running")
        return STOPPED


def up(cache: Path) -> int:
    """Start the stand-in, unless it is up, and print its state."""
    if not is_up(cache):
        _end_keeper(cache)
        fetch_all(cache, say)
        code = _start_keeper(cache)
        if code is not None:
            return code
    print(json.dumps(state_of(cache)))
    return 0


def down(cache: Path) -> int:
    """Stop everything that `up` started."""
    _end_keeper(cache)
    say("the stand-in is down")
    return 0


def status(cache: Path) -> int:
    """Print whether the stand-in is up, and its state."""
    code = 0 if is_up(cache) else 1
    line = "up" if code == 0 else "half up: take it down" if keeper_of(cache) else "down"
    print(f"the stand-in is {line}\n{json.dumps(state_of(cache))}")
    return code


def is_up(cache: Path) -> bool:
    """Return whether its keeper lives, and there is a player in its world."""
    state = state_of(cache)
    try:
        return bool(state["ready"] and ask(state["oracle"], "/player"))
    except OracleError:
        return False


def state_of(cache: Path) -> dict[str, Any]:
    """Return what its keeper wrote, if that one lives."""
    path = cache / STATE
    known: dict[str, Any] = json.loads(path.read_text("utf-8")) if keeper_of(cache) and path.exists() else {}
    return {"ready": False, **known}


def keeper_of(cache: Path) -> int | None:
    """Return the pid of the process that keeps it; None if there is none."""
    with file_lock(cache / KEEPER) as lock:
        return None if lock.is_mine else lock.holder


def _start_keeper(cache: Path) -> int | None:
    """Leave a keeper behind that has started the game; return the exit code if it couldn't."""
    state = cache / STATE
    state.unlink(missing_ok=True)  # of a keeper that was killed
    keeper = subprocess.Popen(  # noqa: S603 - our own
        [*KEEP, str(cache.resolve())],
        cwd=ROOT,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        while keeper.poll() is None and not state.exists():
            time.sleep(LOOK_S)
    except KeyboardInterrupt:
        keeper.terminate()
        keeper.wait()
        raise
    code = keeper.poll()
    keeper.returncode = 0  # otherwise Popen would warn that the process, which is meant to stay, still runs
    return code


def _end_keeper(cache: Path) -> None:
    for how in (signal.SIGTERM, signal.SIGKILL):
        pid = keeper_of(cache)
        if pid is None:
            return
        os.kill(pid, how)
        wait_until(lambda: keeper_of(cache) is None, ENDS_S)
    if keeper_of(cache) is not None:
        raise StandinError(f"the keeper, process {pid}, doesn't stop: end it by hand")


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(main())
