"""A Wayland desktop with an Xwayland of either kind, for tests: on no screen, or in a window under Xvfb."""

import os
import re
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from scripts.programs import XDOTOOL, XVFB, Program
from scripts.window_display import WITH_THIS_PROCESS

WESTON = Program(("weston",), "weston")
MUTTER = Program(("mutter",), "mutter")
"""GNOME's compositor."""
DBUS = Program(("dbus-daemon",), "dbus-daemon")
WAYLAND_WINDOW = Program(("weston-terminal",), "weston")
XWAYLAND = Program(("Xwayland",), "xwayland")
PROGRAMS = (WESTON, MUTTER, DBUS, WAYLAND_WINDOW, XWAYLAND, XVFB, XDOTOOL)

SIZE = (1024, 768)
HAND = "MC_NESTED_TEST_HAND"
"""Names the display on which a person's hand clicks and types: the one that shows the compositor."""

_PATIENCE_S = 20.0
_SOCKET = "mc-nested-test"
_X_DISPLAY = re.compile(r"(?:xserver listening on display|Using public X11 display) (:\d+)")
"""What weston and mutter say when their X server is up."""


@contextmanager
def rootful_desktop() -> Iterator[dict[str, str]]:
    """Yield the environment of an Xwayland that is one window of a compositor without a screen."""
    command = [*_weston(), "--backend=headless-backend.so"]
    with (
        _compositor(command, dict(os.environ)) as (wayland, _),
        _x_server([XWAYLAND.required()], wayland) as display,
    ):
        yield {**wayland, "DISPLAY": display}


@contextmanager
def rootless_desktop(name: str) -> Iterator[dict[str, str]]:
    """Yield the environment of a compositor's own Xwayland, whose windows are the compositor's, and ``HAND`` in it.

    ``name`` is the compositor's: "weston", or "mutter", which is GNOME's.
    """
    command = {"weston": [*_weston(), "--backend=x11-backend.so", "--xwayland"], "mutter": _mutter()}[name]
    screen = [XVFB.required(), "-screen", "0", f"{SIZE[0] + 200}x{SIZE[1] + 200}x24"]
    with _x_server(screen, dict(os.environ)) as outer:
        settings = {"DISPLAY": outer, "MUTTER_DEBUG_DUMMY_MODE_SPECS": f"{SIZE[0]}x{SIZE[1]}"}
        with _compositor(command, {**os.environ, **settings}) as (wayland, log):
            _until(lambda: _X_DISPLAY.search(log.read_text()), log)
            inner = {"DISPLAY": _X_DISPLAY.findall(log.read_text())[0], HAND: outer}
            for allowed in Path(wayland["XDG_RUNTIME_DIR"]).glob(".mutter-Xwaylandauth.*"):
                inner["XAUTHORITY"] = str(allowed)
            yield {**wayland, **inner}


def _weston() -> list[str]:
    size = [f"--width={SIZE[0]}", f"--height={SIZE[1]}"]
    return [WESTON.required(), f"--socket={_SOCKET}", *size, "--use-pixman", "--no-config", "--idle-time=0"]


def _mutter() -> list[str]:
    return [MUTTER.required(), "--wayland", "--nested", f"--wayland-display={_SOCKET}"]


def _bus(address: str) -> list[str]:
    """Return the session's message bus, without which mutter doesn't start."""
    return [DBUS.required(), "--session", "--nofork", "--nopidfile", f"--address={address}"]


@contextmanager
def _compositor(command: Sequence[str], env: dict[str, str]) -> Iterator[tuple[dict[str, str], Path]]:
    """Yield the environment of its clients, and its log."""
    # A socket's path has room for 107 letters: pytest's own folders may be too deep.
    with tempfile.TemporaryDirectory(prefix="mc-nested-", ignore_cleanup_errors=True) as folder:
        log = Path(folder, "log")
        bus = f"unix:path={folder}/bus"
        wayland = {**env, "XDG_RUNTIME_DIR": folder, "XDG_CONFIG_HOME": folder, "DBUS_SESSION_BUS_ADDRESS": bus}
        with log.open("w") as output, _running(_bus(bus), wayland, output=output.fileno()):
            _until(Path(folder, "bus").exists, log)
            with _running(command, {**wayland, "XDG_SESSION_TYPE": "wayland"}, output=output.fileno()):
                _until(Path(folder, _SOCKET).exists, log)
                yield {**wayland, "XDG_SESSION_TYPE": "wayland", "WAYLAND_DISPLAY": _SOCKET}, log


@contextmanager
def _x_server(command: Sequence[str], env: dict[str, str]) -> Iterator[str]:
    """Yield the display of an X server that takes a free number."""
    read, write = os.pipe()
    command = [*command, "-displayfd", str(write), "-nolisten", "tcp", "-noreset"]
    with os.fdopen(read) as numbers, _running(command, env, kept=[write]):
        os.close(write)
        yield f":{numbers.readline().strip()}"


@contextmanager
def _running(
    command: Sequence[str], env: dict[str, str], *, output: int = subprocess.DEVNULL, kept: Sequence[int] = ()
) -> Iterator[None]:
    """Run the program until the context ends, and then end what it leaves behind of those that it started."""
    process = subprocess.Popen(
        [*WITH_THIS_PROCESS, *command],
        env=env,
        pass_fds=kept,
        stdout=output,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )
    try:
        yield
    finally:
        process.terminate()
        with suppress(subprocess.TimeoutExpired):
            process.wait(10)
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _until(done: Callable[[], object], log: Path) -> None:
    end = time.monotonic() + _PATIENCE_S
    while not done():
        if time.monotonic() > end:
            raise TimeoutError(f"the compositor isn't ready: {log.read_text()[-2000:]}")
        time.sleep(0.02)
