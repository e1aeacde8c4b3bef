"""An X display of its own for a real window: Xvfb, with a keyboard layout and perhaps a window manager.

Standard library only, and Linux only.
"""

import os
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

from scripts.standin_parts import XVFB, Program, Say, apt_install, is_installed

OPENBOX = Program(("openbox",), "openbox")
SETXKBMAP = Program(("setxkbmap",), "x11-xkb-utils")
XRANDR = Program(("xrandr",), "x11-xserver-utils")
PROGRAMS = (XVFB, OPENBOX, SETXKBMAP, XRANDR)
LIBRARIES = ("libgl1", "libgl1-mesa-dri", "libxcursor1", "libxi6", "libxinerama1", "libxrandr2")
"""Debian's packages of what GLFW and OpenGL load."""

WITH_THIS_PROCESS = ("setpriv", "--pdeathsig", "TERM", "--")
"""What a command begins with that must not outlive the process that starts it, even where that one is killed."""

SIZE = (1400, 1000)
PATIENCE_S = 10.0


def install_programs(say: Say, log: Path) -> None:
    """Install what is missing with apt; MissingError where that is impossible."""
    packages = {program.package for program in PROGRAMS if program.path() is None}
    packages |= {library for library in LIBRARIES if not is_installed(library)}
    if packages:
        apt_install("a real window", sorted(packages), say, log)


@contextmanager
def open_display(
    *, layout: str = "us", has_window_manager: bool = False, has_opengl: bool = True
) -> Iterator[dict[str, str]]:
    """The environment of programs on a new, empty display; what was started is ended after the block."""
    with ExitStack() as started:
        read, write = os.pipe()
        screen = f"{SIZE[0]}x{SIZE[1]}x24"
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


@contextmanager
def running(
    command: list[str], *, env: dict[str, str] | None = None, keep: tuple[int, ...] = (), log: Path | None = None
) -> Iterator[subprocess.Popen[bytes]]:
    """A process, while the block and this process last; its output goes to ``log``, or nowhere."""
    with ExitStack() as opened:
        output = opened.enter_context(log.open("wb")) if log else subprocess.DEVNULL
        process = subprocess.Popen(  # noqa: S603 - fixed commands of the scripts
            [*WITH_THIS_PROCESS, *command],
            env=env,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            pass_fds=keep,
        )
        try:
            yield process
        finally:
            process.terminate()
            try:
                process.wait(PATIENCE_S)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def _layout_words(layout: str) -> list[str]:
    """What setxkbmap takes: Dvorak is a variant of the United States' layout."""
    return ["us", "-variant", "dvorak"] if layout == "dvorak" else [layout]


def _wait_for_window_manager(env: dict[str, str]) -> None:
    from Xlib.display import Display

    display = Display(env["DISPLAY"])
    try:
        atom = display.intern_atom("_NET_SUPPORTING_WM_CHECK")
        end = time.monotonic() + PATIENCE_S
        while display.screen().root.get_full_property(atom, 0) is None and time.monotonic() < end:
            time.sleep(0.05)
    finally:
        display.close()
