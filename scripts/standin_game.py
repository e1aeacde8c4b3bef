"""Keeps the stand-in: starts its screen, server and browser, joins the world, and ends all of it when it is asked to.

    python -m scripts.standin_game CACHE

A process of its own, which standin.py leaves behind. It is asked by SIGTERM. What was fetched is in the folder CACHE,
where it locks KEEPER as long as it lives, and writes STATE once the game can be played.
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from mc_nested.atomic_file import atomic_write
from mc_nested.file_lock import file_lock
from scripts.programs import XDOTOOL
from scripts.standin_parts import BROWSER, FONTS, NODE, NODE_FOLDER, WEB_CLIENT
from scripts.window_display import adopting, open_display, running, wait_until

KEEPER, STATE = "keeper.lock", "state.json"
SIZE = WIDTH, HEIGHT = 1024, 768
ANSWER_S = 5.0
LOOK_S = 0.2
STOPPED = 130
"""The exit code after Ctrl+C."""

BROWSER_FLAGS = (
    # A local page, as root in a container.
    *("--no-sandbox", "--no-first-run", "--no-default-browser-check", "--password-store=basic"),
    # Only 127.0.0.1 is ever contacted.
    *("--no-proxy-server", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-default-apps"),
    *("--disable-extensions", "--disable-domain-reliability", "--disable-breakpad", "--no-pings"),
    "--disable-features=Translate,OptimizationHints,MediaRouter",
    # WebGL without a graphics card.
    *("--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"),
    *("--disable-dev-shm-usage", "--mute-audio", "--force-device-scale-factor=1"),
    *("--window-position=0,0", f"--window-size={WIDTH},{HEIGHT}", "--kiosk"),
)

# A proxy of the environment must not be used for 127.0.0.1.
_DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))


class StandinError(Exception):
    """The stand-in did not start, or did not stop; the message is one line."""


class OracleError(StandinError):
    """The oracle gave no answer, or refused the question."""


def ask(oracle: str, question: str) -> Any:
    """Return the answer to a question of standin/oracle.js, such as ``/player``; OracleError where there is none."""
    try:
        with _DIRECT.open(oracle + question, timeout=ANSWER_S) as answer:
            return json.load(answer)
    except urllib.error.HTTPError as error:
        with error:
            raise OracleError(f"{question}: {json.load(error)['error']}") from error
    except (OSError, ValueError) as error:
        raise OracleError(f"{oracle} does not answer {question} ({error})") from error


def blocks(oracle: str, low: tuple[int, int, int], high: tuple[int, int, int]) -> dict[tuple[int, int, int], str]:
    """Return the blocks other than air between two corners, which are included, by position."""
    corners = [",".join(map(str, corner)) for corner in (low, high)]
    found = ask(oracle, f"/blocks?from={corners[0]}&to={corners[1]}")
    return {(each["pos"][0], each["pos"][1], each["pos"][2]): each["name"] for each in found}


class StandinGame:
    """The game that is kept until the end of a block: a display, the server, and a browser in which it is played.

    Args:
        cache: the folder of what was fetched.
        scratch: an empty folder for what its programs write.
        started: ends them.
    """

    def __init__(self, cache: Path, scratch: Path, started: ExitStack) -> None:
        self._cache, self._scratch, self._started = cache, scratch, started
        homes = ("HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR")
        display = started.enter_context(open_display(size=SIZE))["DISPLAY"]
        path = os.environ.get("PATH", os.defpath)
        self._env = {"PATH": path, "LANG": "C.UTF-8", "DISPLAY": display, **dict.fromkeys(homes, str(scratch))}
        self._processes: dict[str, subprocess.Popen[bytes]] = {}
        self._oracle = ""

    def join(self) -> dict[str, Any]:
        """Start everything, until the debug screen of a player in the world shows; return the state.

        Raises:
            StandinError: something did not start, in time or at all.
        """
        say("starting the server")
        ports_file = self._scratch / "ports.json"
        client, modules = self._cache / WEB_CLIENT.folder, self._cache / "node" / "node_modules"
        server = [NODE.required(), str(NODE_FOLDER / "server.js"), str(client), str(ports_file)]
        self._start("server", server, NODE_PATH=str(modules))
        self._wait_for(ports_file.exists, 60, "starting the server")
        ports: dict[str, int] = json.loads(ports_file.read_text(encoding="utf-8"))
        self._oracle = f"http://127.0.0.1:{ports['oracle']}"
        say("starting the browser")
        page, game = f"127.0.0.1:{ports['page']}", f"127.0.0.1:{ports['game']}"
        address = f"http://{page}/?address={game}&proxy={page}&username=agent&version=1.18.2"
        profile = f"--user-data-dir={self._scratch}/browser"
        self._start("browser", [BROWSER.required(), profile, *BROWSER_FLAGS, address])
        say("joining the world")
        self._wait_for(lambda: self._screen().get("playing", False), 90, "joining the world")
        say("opening the debug screen")
        self._open_debug_screen()
        fonts = self._cache / FONTS.folder
        font = fonts / "1.13/font/ascii.png"
        return {
            "ready": True,
            "display": self._env["DISPLAY"],
            "window_title": self._xdotool("getwindowfocus", "getwindowname"),
            "oracle": self._oracle,
            "font": str(font),
            "fonts": str(fonts),
            "profile": str(write_profile(self._cache / "profile.toml", font)),
            "logs": str(self._cache / "logs"),
            "pids": {"keeper": os.getpid(), **{name: process.pid for name, process in self._processes.items()}},
        }

    def keep(self) -> None:
        """Wait until one of its programs ends."""
        while all(process.poll() is None for process in self._processes.values()):
            time.sleep(LOOK_S)

    def _start(self, name: str, command: Sequence[str], **env: str) -> None:
        log = self._cache / "logs" / f"{name}.log"
        process = self._started.enter_context(running(command, env={**self._env, **env}, log=log))
        self._processes[name] = process

    def _wait_for(self, is_so: Callable[[], bool], timeout_s: float, what: str) -> None:
        """Wait until it is so; StandinError when that takes too long or a program ends meanwhile."""
        logs = self._cache / "logs"

        def has_ended() -> list[str]:
            return [name for name, process in self._processes.items() if process.poll() is not None]

        in_time = wait_until(lambda: bool(has_ended()) or is_so(), timeout_s)
        for name in has_ended():
            raise StandinError(f"{name} stopped: {last_line(logs / f'{name}.log')}")
        if not in_time:
            raise StandinError(f"{what} took more than {timeout_s:.0f} s: see the logs in {logs}")

    def _open_debug_screen(self) -> None:
        """Give the game the focus and the pointer with a middle click, which changes nothing, then press F3."""
        self._xdotool("mousemove", str(WIDTH // 2), str(HEIGHT // 2), "click", "2")
        self._wait_for(lambda: self._screen()["pointer_locked"], 10, "taking the pointer")
        self._xdotool("key", "F3")
        self._wait_for(lambda: self._screen()["overlay"], 10, "opening the debug screen")
        self._wait_for(lambda: self._screen()["steady"], 60, "drawing the world")

    def _screen(self) -> dict[str, Any]:
        """Return what the page reports it shows, empty before its first report; StandinError if that is an error."""
        shown: dict[str, Any] = ask(self._oracle, "/screen") or {}
        if shown.get("error_screen"):
            raise StandinError(f"the web client stopped: {shown['error_screen']}")
        return shown

    def _xdotool(self, *arguments: str) -> str:
        command = [XDOTOOL.required(), *arguments]
        done = subprocess.run(command, env=self._env, capture_output=True, text=True, timeout=20, check=False)  # noqa: S603 - fixed
        if done.returncode != 0:
            raise StandinError(f"xdotool {' '.join(arguments)} failed: {done.stderr.strip()}")
        return done.stdout.strip()


def write_profile(path: Path, font: Path) -> Path:
    """Write mc-nested's profile of the stand-in, with the path of the font; return ``path``."""
    text = (NODE_FOLDER / "profile.toml").read_text(encoding="utf-8")
    path.write_text(text.replace('"FONT"', json.dumps(str(font))), encoding="utf-8")
    return path


def last_line(log: Path) -> str:
    """Return the last line of a log that isn't blank."""
    lines = [line.strip() for line in log.read_text(encoding="utf-8", errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else f"{log} is empty"


def say(line: str) -> None:
    """Print one line of progress, or why it ended."""
    print(f"standin: {line}", file=sys.stderr, flush=True)


def main(cache: Path) -> int:
    """Keep the game; return the exit code, which nobody sees once it can be played."""
    with file_lock(cache / KEEPER), ExitStack() as held:
        held.callback((cache / STATE).unlink, missing_ok=True)
        try:
            scratch = held.enter_context(tempfile.TemporaryDirectory(prefix="mc-nested-standin-"))
            with adopting(), ExitStack() as started:
                game = StandinGame(cache, Path(scratch), started)
                state = game.join()
                with atomic_write(cache / STATE) as unfinished:
                    unfinished.write_text(json.dumps(state), encoding="utf-8")
                _release_terminal()
                game.keep()
        except StandinError as error:
            say(str(error))
            return 1
        except KeyboardInterrupt:
            return STOPPED
    return 0


def _release_terminal() -> None:
    """Let go of the terminal: whoever started this process may be waiting for the end of its output."""
    nothing = os.open(os.devnull, os.O_RDWR)
    for each in (0, 1, 2):
        os.dup2(nothing, each)


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    sys.exit(main(Path(sys.argv[1])))
