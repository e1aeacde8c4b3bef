"""An X display of its own for a real window, with a keyboard layout and perhaps a window manager; and programs on it.

Linux only.
"""

import ctypes
import os
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import psutil  # type: ignore[import-untyped]  # it brings no types

from scripts.programs import OPENGL, XVFB, Program, Say, install

OPENBOX = Program(("openbox",), "openbox")
SETXKBMAP = Program(("setxkbmap",), "x11-xkb-utils")
XRANDR = Program(("xrandr",), "x11-xserver-utils")
PROGRAMS = (XVFB, OPENBOX, SETXKBMAP, XRANDR)
LIBRARIES = (*OPENGL, "libxcursor1", "libxi6", "libxinerama1", "libxrandr2")
"""Debian's packages of what GLFW and OpenGL load."""

WITH_THIS_PROCESS = ("setpriv", "--pdeathsig", "TERM", "--")
"""The first words of a command that must end with the process that starts it, even if that is killed."""

SIZE = (1400, 1000)
PATIENCE_S = 10.0

_PR_SET_CHILD_SUBREAPER = 36  # linux/prctl.h


def install_programs(say: Say, log: Path) -> None:
    """Install what is missing with apt; MissingError where that is impossible."""
    install("a real window", PROGRAMS, LIBRARIES, say, log)


@contextmanager
def open_display(
    *,
    size: tuple[int, int] = SIZE,
    layout: str = "us",
    has_window_manager: bool = False,
    has_opengl: bool = True,
) -> Iterator[dict[str, str]]:
    """Open a new, empty display, and yield its programs' environment; what was started is ended after the block."""
    with ExitStack() as started:
        read, write = os.pipe()
        screen = f"{size[0]}x{size[1]}x24"
        server = [XVFB.required(), "-displayfd", str(write), "-screen", "0", screen, "-nolisten", "tcp", "-noreset"]
        server += [] if has_opengl else ["-extension", "GLX"]
        started.enter_context(running(server, keep=(write,)))
        os.close(write)
        with os.fdopen(read) as numbers:
            env = {**os.environ, "DISPLAY": f":{numbers.readline().strip()}"}
        env.pop("WAYLAND_DISPLAY", None)
        folder = started.enter_context(tempfile.TemporaryDirectory(prefix="mc-nested-display-"))
        # Clipboards, caches and profiles of what runs there are nobody else's.
        env |= {"HOME": folder, "XDG_SESSION_TYPE": "x11"}
        set_layout(layout, env)
        if has_window_manager:
            started.enter_context(running([OPENBOX.required()], env=env))
            _wait_for_window_manager(env)
        yield env


def set_layout(layout: str, env: Mapping[str, str]) -> None:
    """Give the keyboard of a display the layout of a country, or Dvorak's."""
    subprocess.run([SETXKBMAP.required(), "-layout", *_layout_words(layout)], env=dict(env), check=True)  # noqa: S603 - fixed


def _layout_words(layout: str) -> list[str]:
    """Return what setxkbmap takes: Dvorak is a variant of the United States' layout."""
    return ["us", "-variant", "dvorak"] if layout == "dvorak" else [layout]


def _wait_for_window_manager(env: dict[str, str]) -> None:
    from Xlib.display import Display

    display = Display(env["DISPLAY"])
    try:
        atom = display.intern_atom("_NET_SUPPORTING_WM_CHECK")
        wait_until(lambda: display.screen().root.get_full_property(atom, 0) is not None, PATIENCE_S)
    finally:
        display.close()


@contextmanager
def running(
    command: Sequence[str],
    *,
    env: Mapping[str, str] | None = None,
    keep: Sequence[int] = (),
    log: Path | None = None,
    ended_with: Sequence[str] = WITH_THIS_PROCESS,
) -> Iterator[subprocess.Popen[bytes]]:
    """Run a process while the block and this process last; its output goes to ``log``, or nowhere."""
    with ExitStack() as opened:
        output = opened.enter_context(log.open("wb")) if log else subprocess.DEVNULL
        process = subprocess.Popen(  # noqa: S603 - fixed commands of the scripts
            [*ended_with, *command],
            env=env,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            pass_fds=keep,
        )
        try:
            yield process
        finally:
            end(process)


def end(process: subprocess.Popen[bytes]) -> None:
    """End a process with SIGTERM, and with SIGKILL where that takes too long."""
    process.terminate()
    try:
        process.wait(PATIENCE_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


@contextmanager
def adopting(is_ours: Callable[[str], bool] = lambda _name: True) -> Iterator[None]:
    """Adopt programs whose parent has ended, during the block; after it, end those of such a name.

    An ended process stays listed until its parent, or else the system's first process, collects its status. In many
    containers the first process never does.
    """
    libc = ctypes.CDLL(None)
    libc.prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    try:
        yield
    finally:
        for each in psutil.Process().children():
            with suppress(psutil.NoSuchProcess):
                if is_ours(each.name()):
                    _end_adopted(each)
        libc.prctl(_PR_SET_CHILD_SUBREAPER, 0, 0, 0, 0)


def _end_adopted(process: psutil.Process) -> None:
    """Wait for the end of a process, and collect it; it is killed where that takes too long."""
    try:
        process.wait(PATIENCE_S)
    except psutil.TimeoutExpired:
        process.kill()
        process.wait()


def wait_until(is_so: Callable[[], bool], timeout_s: float, every_s: float = 0.05) -> bool:
    """Wait until it is so, no longer than ``timeout_s``; return whether it is."""
    end_at = time.monotonic() + timeout_s
    while not is_so():
        if time.monotonic() > end_at:
            return False
        time.sleep(every_s)
    return True
