"""A Wayland desktop with an Xwayland of either kind, for tests: weston, on no screen or in a window under Xvfb."""

import os
import re
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from scripts.standin_parts import XVFB
from scripts.xwayland_parts import WESTON, XWAYLAND

SIZE = (1024, 768)
SOCKET = "mc-nested-test"
HAND = "MC_NESTED_TEST_HAND"
"""Names the display on which a person's hand clicks and types: the one that shows the compositor."""

_PATIENCE_S = 20.0
_WESTON_DISPLAY = re.compile(r"xserver listening on display (:\d+)")


@contextmanager
def rootful_desktop() -> Iterator[dict[str, str]]:
    """The environment of an Xwayland that is one window of a compositor without a screen."""
    with (
        _weston("headless-backend.so", [], dict(os.environ)) as (wayland, _),
        _x_server([XWAYLAND.required()], wayland) as x,
    ):
        yield {**wayland, "DISPLAY": x}


@contextmanager
def rootless_desktop() -> Iterator[dict[str, str]]:
    """The environment of a compositor's own Xwayland, whose windows are the compositor's, and ``HAND`` in it."""
    screen = [XVFB.required(), "-screen", "0", f"{SIZE[0] + 200}x{SIZE[1] + 200}x24"]
    with _x_server(screen, dict(os.environ)) as outer:
        environment = {**os.environ, "DISPLAY": outer}
        with _weston("x11-backend.so", ["--xwayland"], environment) as (wayland, log):
            _until(lambda: _WESTON_DISPLAY.search(log.read_text()) is not None, log)
            inner = _WESTON_DISPLAY.findall(log.read_text())[0]
            yield {**wayland, "DISPLAY": inner, HAND: outer}


@contextmanager
def _weston(backend: str, more: Sequence[str], env: dict[str, str]) -> Iterator[tuple[dict[str, str], Path]]:
    """The environment of its clients, and its log."""
    # A socket's path has room for 107 letters: pytest's own folders may be too deep.
    with tempfile.TemporaryDirectory(prefix="mc-nested-") as folder:
        log = Path(folder, "weston.log")
        log.touch()
        size = [f"--width={SIZE[0]}", f"--height={SIZE[1]}"]
        command = [WESTON.required(), f"--backend={backend}", f"--socket={SOCKET}", f"--log={log}", *size, *more]
        command += ["--use-pixman", "--no-config", "--idle-time=0"]
        wayland = {**env, "XDG_RUNTIME_DIR": folder, "XDG_SESSION_TYPE": "wayland"}
        with _running(command, wayland):
            _until(Path(folder, SOCKET).exists, log)
            yield {**wayland, "WAYLAND_DISPLAY": SOCKET}, log


@contextmanager
def _x_server(command: Sequence[str], env: dict[str, str]) -> Iterator[str]:
    """The display of an X server that takes a free number."""
    read, write = os.pipe()
    command = [*command, "-displayfd", str(write), "-nolisten", "tcp", "-noreset"]
    with os.fdopen(read) as numbers, _running(command, env, write):
        os.close(write)
        yield f":{numbers.readline().strip()}"


@contextmanager
def _running(command: Sequence[str], env: dict[str, str], *kept: int) -> Iterator[None]:
    process = subprocess.Popen(command, env=env, pass_fds=kept, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(10)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _until(done: Callable[[], bool], log: Path) -> None:
    end = time.monotonic() + _PATIENCE_S
    while not done():
        if time.monotonic() > end:
            raise TimeoutError(f"weston isn't ready: {log.read_text()[-2000:]}")
        time.sleep(0.02)
