"""Starting the stand-in: the screen, the server, the browser, and joining the world. Standard library only."""

import json
import os
import select
import signal
import subprocess
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

from scripts.standin_oracle import OracleError, ask
from scripts.standin_parts import BROWSER, NODE, NODE_FOLDER, XDOTOOL, XVFB, Say
from scripts.standin_processes import Running, StandinError, State, last_line, start, wait_until

WIDTH, HEIGHT = 1024, 768

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


@dataclass(frozen=True)
class Folders:
    """The cache, its logs, and what was fetched into it."""

    cache: Path
    logs: Path
    modules: Path
    client: Path
    fonts: Path


@dataclass
class Stage:
    """The stand-in during its start; ``state`` is what has been started so far."""

    state: State
    folders: Folders
    env: dict[str, str]

    def launch(self, name: str, command: Sequence[str], keep: Sequence[int] = (), **env: str) -> None:
        """Start a process, and save it in the state before anything can stop this script."""
        log, scratch = self.folders.logs / f"{name}.log", Path(self.state.scratch)
        with _ctrl_c_waits():
            self.state.processes.append(start(name, command, log, scratch, {**self.env, **env}, keep))
            self.state.save()

    def wait_for(self, is_so: Callable[[], bool], timeout_s: float, what: str) -> None:
        """Wait until ``is_so``; StandinError when that takes too long or a process stops meanwhile."""
        stopped: list[Running] = []

        def is_over() -> bool:
            stopped[:] = [process for process in self.state.processes if not process.is_alive]
            return bool(stopped) or is_so()

        in_time = wait_until(is_over, timeout_s)
        for process in stopped:
            raise StandinError(f"{process.name} stopped: {last_line(self.folders.logs / f'{process.name}.log')}")
        if not in_time:
            raise StandinError(f"{what} took more than {timeout_s:.0f} s: see the logs in {self.folders.logs}")


def start_game(state: State, folders: Folders, say: Say) -> None:
    """Start everything, until the debug screen of a player in the world shows. ``state`` has what was started.

    Raises:
        StandinError: something did not start, in time or at all.
    """
    home = dict.fromkeys(("HOME", "TMPDIR", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"), state.scratch)
    stage = Stage(state, folders, {"PATH": os.environ.get("PATH", os.defpath), "LANG": "C.UTF-8", **home})
    say("starting the screen and the server")
    ports_file = Path(state.scratch) / "ports.json"
    stage.launch(
        "server",
        [NODE.required(), str(NODE_FOLDER / "server.js"), str(folders.client), str(ports_file)],
        NODE_PATH=str(folders.modules),
    )
    _start_screen(stage)
    stage.wait_for(ports_file.exists, 60, "starting the server")
    ports: dict[str, int] = json.loads(ports_file.read_text(encoding="utf-8"))
    oracle = f"http://127.0.0.1:{ports['oracle']}"
    say("starting the browser")
    page, game = f"127.0.0.1:{ports['page']}", f"127.0.0.1:{ports['game']}"
    address = f"http://{page}/?address={game}&proxy={page}&username=agent&version=1.18.2"
    stage.launch("browser", [BROWSER.required(), f"--user-data-dir={state.scratch}/browser", *BROWSER_FLAGS, address])
    say("joining the world")
    stage.wait_for(lambda: _screen(oracle).get("playing", False), 90, "joining the world")
    say("opening the debug screen")
    _open_debug_screen(stage, oracle)
    font = folders.fonts / "1.13/font/ascii.png"
    title = _xdotool(stage.env, "getwindowfocus", "getwindowname")
    state.facts = {
        "window_title": title,
        "oracle": oracle,
        "font": str(font),
        "fonts": str(folders.fonts),
        "profile": str(write_profile(folders.cache / "profile.toml", font)),
        "logs": str(folders.logs),
    }
    state.ready = True
    state.save()


def write_profile(path: Path, font: Path) -> Path:
    """Write mc-nested's profile of the stand-in, with the path of the font; returns ``path``."""
    text = (NODE_FOLDER / "profile.toml").read_text(encoding="utf-8")
    path.write_text(text.replace('"FONT"', json.dumps(str(font))), encoding="utf-8")
    return path


def _start_screen(stage: Stage) -> None:
    """Start an X server on a free display, whose number it writes to a pipe once it is ready."""
    end, start_of_pipe = os.pipe()
    try:
        screen = ["-screen", "0", f"{WIDTH}x{HEIGHT}x24", "+extension", "GLX", "-nolisten", "tcp", "-noreset"]
        stage.launch("xvfb", [XVFB.required(), "-displayfd", str(start_of_pipe), *screen], keep=[start_of_pipe])
        number = bytearray()

        def is_ready() -> bool:
            if select.select([end], [], [], 0)[0]:
                number.extend(os.read(end, 64))
            return number.endswith(b"\n")

        stage.wait_for(is_ready, 20, "starting the screen")
    finally:
        os.close(end)
        os.close(start_of_pipe)
    stage.state.display = f":{int(number)}"
    stage.env["DISPLAY"] = stage.state.display
    stage.state.save()


def _open_debug_screen(stage: Stage, oracle: str) -> None:
    """Give the game the focus and the pointer with a middle click, which changes nothing, then press F3."""
    _xdotool(stage.env, "mousemove", str(WIDTH // 2), str(HEIGHT // 2), "click", "2")
    stage.wait_for(lambda: _screen(oracle)["pointer_locked"], 10, "taking the pointer")
    _xdotool(stage.env, "key", "F3")
    stage.wait_for(lambda: _screen(oracle)["overlay"], 10, "opening the debug screen")
    stage.wait_for(lambda: _screen(oracle)["steady"], 60, "drawing the world")


def _screen(oracle: str) -> dict[str, Any]:
    """What the page reports it shows, empty before its first report; StandinError when it shows an error."""
    try:
        shown: dict[str, Any] = ask(oracle, "/screen") or {}
    except OracleError as error:
        raise StandinError(str(error)) from error
    if shown.get("error_screen"):
        raise StandinError(f"the web client stopped: {shown['error_screen']}")
    return shown


def _xdotool(env: Mapping[str, str], *arguments: str) -> str:
    command = [XDOTOOL.required(), *arguments]
    done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=20, check=False)  # noqa: S603 - fixed
    if done.returncode != 0:
        raise StandinError(f"xdotool {' '.join(arguments)} failed: {done.stderr.strip()}")
    return done.stdout.strip()


@contextmanager
def _ctrl_c_waits() -> Iterator[None]:
    """Hold Ctrl+C back until the end of the block, so that every started process is recorded."""
    held: list[int] = []

    def hold(number: int, _frame: FrameType | None) -> None:
        held.append(number)

    earlier = {number: signal.signal(number, hold) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in earlier.items():
            signal.signal(number, handler)
    if held:
        raise KeyboardInterrupt
