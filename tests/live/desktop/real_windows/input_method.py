"""An input method in front of a window: IBus with the table wubi, on a session bus of its own."""

import subprocess
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from scripts.programs import Program, Say, install
from scripts.window_display import running, wait_until

BUS = Program(("dbus-daemon",), "dbus-daemon")
IBUS = Program(("ibus-daemon",), "ibus")
TABLE = "ibus-table-wubi"
ENGINE = "table:wubi-jidian86"
PATIENCE_S = 20.0


def install_input_method(say: Say, log: Path) -> None:
    """Install what is missing with apt; raise MissingError where that is impossible."""
    install("an input method", (BUS, IBUS), [TABLE], say, log)


@contextmanager
def input_method(display: dict[str, str], folder: Path) -> Iterator[dict[str, str]]:
    """Yield the environment of programs that it is in front of, on a display that has a home of its own."""
    folder.mkdir(mode=0o700, exist_ok=True)
    address = f"unix:path={folder}/bus"
    env = {
        **display,
        "XMODIFIERS": "@im=ibus",
        "XDG_RUNTIME_DIR": str(folder),
        "DBUS_SESSION_BUS_ADDRESS": address,
        "NO_AT_BRIDGE": "1",
    }
    bus = [BUS.required(), "--session", "--nofork", f"--address={address}"]
    daemon = [IBUS.required(), "--xim", "--panel=disable", "--config=disable", "--emoji-extension=disable"]
    with running(bus, env=env):
        _wait_until((folder / "bus").exists, "the session bus")
        with running([*daemon, "--cache=none"], env=env, log=folder / "ibus.log"):
            _wait_until(lambda: _says(["ibus", "engine", ENGINE], env) == "", f"IBus's {ENGINE}")
            _wait_until(lambda: _says(["ibus", "engine"], env) == ENGINE, f"IBus's {ENGINE}")
            yield env


def _says(command: list[str], env: dict[str, str]) -> str | None:
    """Return what a program prints; None where it fails."""
    done = subprocess.run(command, env=env, capture_output=True, text=True, check=False, timeout=PATIENCE_S)
    return done.stdout.strip() if done.returncode == 0 else None


def _wait_until(is_so: Callable[[], bool], what: str) -> None:
    if not wait_until(is_so, PATIENCE_S):
        raise TimeoutError(f"{what} didn't start")
