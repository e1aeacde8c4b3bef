"""Drives a GLFW window on a rootless Xwayland through the desktop's devices, and prints one JSON object of what came.

usage: xwayland_probe.py PART, in the environment of ``rootless_desktop``. A process of its own, since pyautogui keeps
to the display of its import. A person's hand is played by xdotool, on the screen that shows the compositor.
"""

import itertools
import json
import os
import queue
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from Xlib.display import Display

from mc_nested.errors import DesktopError
from mc_nested.live.desktop import open_desktop, this_system
from mc_nested.live.desktop.panic import open_panic_switch
from mc_nested.live.devices import Devices, Region
from scripts.programs import XDOTOOL
from tests.live.desktop.real_windows.xwayland_desktop import HAND, SIZE, WAYLAND_WINDOW

TITLE, OTHER = "Minecraft* 1.20.1 - Singleplayer", "Terraria"
PATIENCE_S = 10.0
ROOT = Path(__file__).resolve().parents[4]
LARGE = (960, 640)
"""A window whose picture is fetched in bands."""

Event = list[Any]


class Window:
    """A window of xwayland_window.py, and its events."""

    def __init__(self, process: "subprocess.Popen[str]") -> None:
        self._process = process
        self._came: queue.SimpleQueue[Event] = queue.SimpleQueue()
        threading.Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        assert self._process.stdout
        for line in self._process.stdout:
            self._came.put(json.loads(line))

    def until(self, is_last: Callable[[Event], bool], patience_s: float = PATIENCE_S) -> list[Event]:
        """Return the events up to the one that is the last, or all that came in time."""
        events: list[Event] = []
        end = time.monotonic() + patience_s
        with suppress(queue.Empty):
            while not (events and is_last(events[-1])):
                events.append(self._came.get(timeout=max(0.0, end - time.monotonic())))
        return events

    def tell(self, *command: object) -> Any:
        """Let the window do something; what came of it. The events until then are forgotten."""
        assert self._process.stdin
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()
        return self.until(lambda event: event[0] == "done")[-1][1]

    def events(self) -> list[Event]:
        """Return the events so far: the window has taken all that the X server sent before it answers."""
        time.sleep(0.1)  # an event that should not come can't be waited for
        assert self._process.stdin
        self._process.stdin.write('["free the cursor"]\n')
        self._process.stdin.flush()
        return self.until(lambda event: event[0] == "done")[:-1]


@contextmanager
def shown(title: str) -> Iterator[Window]:
    """Yield a window of that title, drawn, which the compositor has put in front."""
    command = [sys.executable, "-m", "tests.live.desktop.real_windows.xwayland_window", title]
    # PyPI's glfw is two libraries: in a Wayland session, it would load the one that knows no X11.
    env = {**os.environ, "PYGLFW_LIBRARY_VARIANT": "x11"}
    pipe = subprocess.PIPE
    with subprocess.Popen(command, cwd=ROOT, env=env, text=True, stdin=pipe, stdout=pipe) as process:
        try:
            window = Window(process)
            assert window.until(lambda event: event[0] == "ready")[-1] == ["ready"]
            yield window
        finally:
            process.kill()


def hand(*command: object) -> bool:
    """Click or press a key as a person does, on the screen that shows the compositor; return whether it was done."""
    environment = {**os.environ, "DISPLAY": os.environ[HAND]}
    return subprocess.run([XDOTOOL.required(), *map(str, command)], env=environment, check=False).returncode == 0


def hand_clicks_game(desktop: Devices) -> bool:
    """Click the game's corners as a person does, some below another window; return whether the game is in front."""
    width, height = desktop.display.size()
    for x, y in itertools.product((20, width - 20), (20, height - 20)):
        desktop.pointer.move(x, y)
        at = on_screen()
        # The compositor takes the pointer's place anew where it enters its window: from outside.
        hand("mousemove", SIZE[0] + 100, SIZE[1] + 100, "mousemove", *at, "click", 1)
        if until(desktop.display.is_in_front, 1):
            return True
    return False


def on_screen() -> tuple[int, int]:
    """Return where Xwayland's pointer is; the compositor, which has one of its own, counts the same pixels."""
    display = Display()
    at = display.screen().root.query_pointer()
    display.close()
    return at.root_x, at.root_y


@contextmanager
def wayland_window() -> Iterator[None]:
    """Yield a Wayland window, put in front by the compositor, and gone afterwards."""
    command = [WAYLAND_WINDOW.required()]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
        try:
            yield
        finally:
            process.kill()


def until(done: Callable[[], bool], patience_s: float = PATIENCE_S) -> bool:
    end = time.monotonic() + patience_s
    while not done():
        if time.monotonic() > end:
            return False
        time.sleep(0.02)
    return True


def error_of(act: Callable[[], object]) -> str:
    try:
        act()
    except DesktopError as error:
        return str(error)
    return ""


def error_of_opening(title: str) -> str:
    def act() -> None:
        with open_desktop(title):
            pass

    return error_of(act)


def corners(desktop: Devices) -> list[list[int]]:
    """Return the colours of the picture's corners, as blue, green, red."""
    picture = desktop.display.grab()
    height, width = picture.shape[:2]
    return [picture[y, x].tolist() for y in (1, height - 2) for x in (1, width - 2)]


def camera_report(window: Window, desktop: Devices) -> dict[str, Any]:
    width, height = desktop.display.size()
    report: dict[str, Any] = {
        "session": this_system().session_kind(),
        "shape": desktop.display.grab().shape,
        "corners": corners(desktop),
        "seam": desktop.display.grab(Region(width // 2 - 1, 10, 2, 1)).tolist(),
        "below": desktop.display.grab(Region(10, height // 2 - 1, 1, 2)).tolist(),
    }
    with shown(OTHER) as other:
        other.tell("place", 0, 0)
        other.tell("resize", *SIZE)
        report["covered"] = corners(desktop)
    window.tell("place", -100, 50)
    report["partly off the screen"] = corners(desktop)
    window.tell("resize", *LARGE)
    report["large"] = [desktop.display.grab().shape, corners(desktop)]
    window.tell("minimise")
    until(lambda: bool(error_of(desktop.display.grab)), 1)
    report["minimised"] = error_of(desktop.display.grab)
    window.tell("hide")
    until(lambda: bool(error_of(desktop.display.grab)))
    report["hidden"] = error_of(desktop.display.grab)
    return report


def input_report(window: Window, desktop: Devices) -> dict[str, Any]:
    until(desktop.display.is_in_front)
    window.events()
    for key in ("w", "f3", "left.shift", "/"):
        desktop.keyboard.press(key)
        desktop.keyboard.release(key)
    report: dict[str, Any] = {"keys": [event for event in window.events() if event[0] == "key"]}
    desktop.keyboard.type("/Tp @s")
    report["typed"] = "".join(event[1] for event in window.events() if event[0] == "char")
    desktop.pointer.move(200, 50)
    report["pointer"] = desktop.pointer.position()
    desktop.pointer.press("right")
    desktop.pointer.release("right")
    report["clicks"] = [event for event in window.events() if event[0] in ("button", "cursor")]
    window.tell("hold the cursor")
    desktop.pointer.press("right")
    desktop.pointer.release("right")
    report["in the world"] = [event for event in window.events() if event[0] == "button"]
    return report


def focus_report(window: Window, desktop: Devices) -> dict[str, Any]:
    """Say if it is in front and a key arrives: beside a Wayland window, clicked again, beside an X11 window."""

    def key_arrives() -> bool:
        window.events()
        desktop.keyboard.press("w")
        desktop.keyboard.release("w")
        return any(event[0] == "key" for event in window.events())

    window.tell("place", 10, 40)
    window.tell("resize", *LARGE)
    until(desktop.display.is_in_front)
    report: dict[str, Any] = {"at first": [desktop.display.is_in_front(), key_arrives()]}
    with wayland_window():
        until(lambda: not desktop.display.is_in_front())
        report["a Wayland window"] = [desktop.display.is_in_front(), key_arrives()]
        report["not seen"] = error_of_opening("Wayland Terminal")
        report["clicked"] = [hand_clicks_game(desktop), key_arrives()]
    with shown(OTHER):
        until(lambda: not desktop.display.is_in_front())
        report["another window"] = [desktop.display.is_in_front(), key_arrives()]
    return report


def clipboard_report(window: Window, desktop: Devices) -> dict[str, Any]:
    until(desktop.display.is_in_front)
    desktop.clipboard.write("/tp @s 1 2 3")
    report: dict[str, Any] = {"pasted": window.tell("paste")}
    window.tell("copy", "F3+C's text")
    report["copied"] = desktop.clipboard.read()
    return report


def panic_report(window: Window, desktop: Devices) -> dict[str, Any]:
    """Return what the panic key does, pressed by hand: with the game in front, and with a Wayland window there."""
    heard: list[str] = []
    happened = threading.Event()

    def stop(reason: str) -> None:
        heard.append(reason)
        happened.set()

    until(desktop.display.is_in_front)
    with open_panic_switch("f12", stop):
        until(lambda: hand("key", "F12") and happened.wait(0.2))  # listening begins a moment late
        report: dict[str, Any] = {"in front": heard[:1]}
        with wayland_window():
            until(lambda: not desktop.display.is_in_front())
            window.events()
            heard.clear()
            happened.clear()
            hand("key", "F12")
            happened.wait(1)
            report["behind"] = list(heard)
    return report


PARTS: dict[str, Callable[[Window, Devices], dict[str, Any]]] = {
    "camera": camera_report,
    "input": input_report,
    "focus": focus_report,
    "clipboard": clipboard_report,
    "panic": panic_report,
}


def main(part: str) -> None:
    with shown(TITLE) as window, open_desktop(r"^Minecraft\*? \d") as desktop:
        json.dump(PARTS[part](window, desktop), sys.stdout)


if __name__ == "__main__":
    main(sys.argv[1])
