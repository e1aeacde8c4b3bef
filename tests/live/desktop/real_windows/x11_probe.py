"""Opens a real X window, drives it through the desktop's devices and prints the results as one JSON object.

A process of its own, since pyautogui keeps to the display of its import: python x11_probe.py PART.
"""

import json
import select
import sys
import threading
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from Xlib import XK, X
from Xlib.display import Display
from Xlib.error import BadMatch
from Xlib.ext import xtest

from mc_nested.errors import McNestedError
from mc_nested.live.desktop import open_desktop
from mc_nested.live.desktop.key_listener import open_hotkeys
from mc_nested.live.desktop.panic import open_panic_switch
from mc_nested.live.devices import Devices, Region
from mc_nested.live.input.stops import CORNER_REASON, KEY_REASON

if TYPE_CHECKING:
    from Xlib.xobject.drawable import Window

TITLE, SIZE = "Minecraft* 1.20.1 - Singleplayer", (320, 240)
LEFT, TOP = 60, 40
RED, BLUE = 0xFF2010, 0x1020FF
PATIENCE_S = 5.0


class Probe:
    """A window with a red left half and a blue right half, and the events that reach it."""

    def __init__(self, display: Display, left: int, top: int, title: str) -> None:
        self.display = display
        screen = display.screen()
        mask = X.KeyPressMask | X.KeyReleaseMask | X.ButtonPressMask | X.ButtonReleaseMask
        self.window: Window = screen.root.create_window(
            left, top, *SIZE, 0, screen.root_depth, X.InputOutput, X.CopyFromParent, event_mask=mask
        )
        self.window.set_wm_name(title)
        self.window.set_wm_normal_hints(flags=1, min_width=0, min_height=0)  # 1: the position is the user's
        self.window.map()
        self.until(lambda: self.window.get_attributes().map_state == X.IsViewable)

    def until(self, done: Callable[[], bool]) -> bool:
        end = time.monotonic() + PATIENCE_S
        while not done():
            if time.monotonic() > end:
                return False
            self.display.sync()
            select.select([], [], [], 0.01)
        return True

    def focus(self) -> None:
        def is_focused() -> bool:
            try:
                self.window.set_input_focus(X.RevertToParent, X.CurrentTime)
                self.display.sync()
            except BadMatch:
                return False
            return bool(self.display.get_input_focus().focus == self.window)

        self.until(is_focused)

    def draw(self) -> None:
        half = SIZE[0] // 2
        for left, colour in ((0, RED), (half, BLUE)):
            gc = self.window.create_gc(foreground=colour)
            self.window.fill_rectangle(gc.id, left, 0, half, SIZE[1])
            gc.free()
        self.display.sync()

    def events(self) -> list[list[Any]]:
        self.display.sync()
        names = {X.KeyPress: "press", X.KeyRelease: "release", X.ButtonPress: "down", X.ButtonRelease: "up"}
        found: list[list[Any]] = []
        while self.display.pending_events():
            event = self.display.next_event()
            if event.type in names:
                detail = event.detail
                if event.type in (X.KeyPress, X.KeyRelease):
                    detail = self.display.keycode_to_keysym(event.detail, 1 if event.state & X.ShiftMask else 0)
                found.append([names[event.type], detail, bool(event._data["send_event"]), event.event_x, event.event_y])
        return found


def error_of(act: Callable[[], object]) -> str:
    try:
        act()
    except McNestedError as error:
        return str(error)
    return ""


def heard_hotkeys(display: Display) -> list[str]:
    """Return what is heard of F9, held so long that it repeats, of W, which is no hotkey, and of K."""

    def send(key: str, kinds: str) -> None:
        code = display.keysym_to_keycode(XK.string_to_keysym(key))
        for kind in kinds:
            xtest.fake_input(display, X.KeyPress if kind == "p" else X.KeyRelease, code)
        display.sync()

    with open_hotkeys(("f8", "f9", "k")) as next_key:
        hearing = threading.Event()

        def knock() -> None:
            while not hearing.wait(0.05):
                send("F8", "pr")

        knocking = threading.Thread(target=knock)
        knocking.start()
        next_key()
        hearing.set()
        knocking.join()
        for key, kinds in (("F9", "pppr"), ("w", "pr"), ("k", "pr"), ("F9", "pr")):
            send(key, kinds)
        heard: list[str] = []
        while len(heard) < 3:
            heard.extend(name for name in [next_key()] if name != "f8")
        return heard


def stopped_by(display: Display) -> list[tuple[str, float]]:
    """Return what stops the agent, and after how long, in s: the panic key, then the mouse in each of two corners."""
    heard: list[tuple[str, float]] = []
    happened = threading.Event()
    corner = display.screen().width_in_pixels - 1, display.screen().height_in_pixels - 1

    def stop(reason: str) -> None:
        heard.append((reason, time.monotonic() - began))
        happened.set()

    code = display.keysym_to_keycode(XK.string_to_keysym("F12"))
    with open_panic_switch("f12", stop):
        # The listeners begin to hear a moment after they say so.
        for reason, there, back in (
            (KEY_REASON, (X.KeyPress, code, 0, 0), (X.KeyRelease, code, 0, 0)),
            (CORNER_REASON, (X.MotionNotify, 0, 0, 0), (X.MotionNotify, 0, 300, 300)),
        ):
            end = time.monotonic() + PATIENCE_S
            while all(each != reason for each, _ in heard) and time.monotonic() < end:
                began = time.monotonic()
                for kind, detail, x, y in (there, back):
                    xtest.fake_input(display, kind, detail, x=x, y=y)
                    display.sync()
                    happened.wait(0.2)
                happened.clear()
        time.sleep(0.2)
        heard.clear()
        for kind, detail, x, y in (
            *((X.KeyPress, code, 0, 0), (X.KeyRelease, code, 0, 0), (X.MotionNotify, 0, 300, 0)),
            *((X.MotionNotify, 0, 0, 0), (X.MotionNotify, 0, 300, 300), (X.MotionNotify, 0, *corner)),
        ):
            happened.clear()
            began = time.monotonic()
            xtest.fake_input(display, kind, detail, x=x, y=y)
            display.sync()
            if (kind, x, y) not in ((X.KeyRelease, 0, 0), (X.MotionNotify, 300, 0), (X.MotionNotify, 300, 300)):
                happened.wait(PATIENCE_S)
    return heard


def error_of_opening(title: str) -> str:
    def act() -> None:
        with open_desktop(title):
            pass

    return error_of(act)


def camera_report(probe: Probe, desktop: Devices) -> dict[str, Any]:
    shown = desktop.display
    picture = shown.grab()
    report: dict[str, Any] = {
        "shape": picture.shape,
        "corners": [picture[y, x].tolist() for y, x in ((0, 0), (239, 0), (0, 319), (239, 319))],
        "seam": shown.grab(Region(159, 100, 2, 1)).tolist(),
    }
    probe.window.configure(x=LEFT + 37, y=TOP + 23)
    probe.display.sync()
    probe.draw()
    report["moved"] = [shown.grab()[0, 0].tolist(), shown.grab()[239, 319].tolist()]
    probe.window.configure(x=-50)
    probe.until(lambda: bool(error_of(shown.grab)))
    report["off the screen"] = error_of(shown.grab)
    return report


def key_report(probe: Probe, desktop: Devices) -> dict[str, Any]:
    keyboard = desktop.keyboard
    probe.events()
    for key in ("w", "f3", "left.shift", "/"):
        keyboard.press(key)
        keyboard.release(key)
    report: dict[str, Any] = {"keys": probe.events()}
    report["no such key"] = error_of(lambda: keyboard.press("é"))
    keyboard.type("/Tp @s")
    report["typed"] = "".join(chr(event[1]) for event in probe.events() if event[0] == "press")
    return report


def pointer_report(probe: Probe, desktop: Devices) -> dict[str, Any]:
    pointer = desktop.pointer
    pointer.move(200, 50)
    report: dict[str, Any] = {"pointer": pointer.position()}
    pointer.press("right")
    pointer.release("right")
    clicks: list[list[Any]] = []

    def is_clicked() -> bool:
        clicks.extend(probe.events())
        return len(clicks) == 2

    probe.until(is_clicked)  # a window manager holds clicks back for a moment
    report["clicks"] = clicks
    pointer.move(-5000, -5000)
    report["in the corner"] = error_of(lambda: pointer.press("left"))
    return report


def window_report(probe: Probe, desktop: Devices) -> dict[str, Any]:
    """Report on another window in front, the focus on none, a minimised window and a closed one."""
    shown, pointer = desktop.display, desktop.pointer
    report: dict[str, Any] = {"title": shown.title(), "size": shown.size(), "in front": shown.is_in_front()}
    report["no such window"] = error_of_opening("^Terraria")
    other = Probe(probe.display, 700, 500, "Terraria")
    other.focus()
    report["other in front"] = shown.is_in_front()
    report["several"] = error_of_opening("Minecraft|Terraria")
    other.window.destroy()
    probe.focus()
    report["again in front"] = shown.is_in_front()
    pointer.move(200, 50)
    probe.display.set_input_focus(X.PointerRoot, X.RevertToPointerRoot, X.CurrentTime)
    probe.display.sync()
    report["keys go to the pointer's window"] = shown.is_in_front()
    pointer.move(-50, -50)
    report["keys go elsewhere"] = shown.is_in_front()
    probe.window.unmap()
    probe.display.sync()
    report["minimised"] = error_of(shown.grab)
    probe.window.destroy()
    probe.display.sync()
    report["closed"] = error_of(shown.is_in_front)
    return report


PARTS: dict[str, Callable[[Probe, Devices], dict[str, Any]]] = {
    "camera": camera_report,
    "keyboard": key_report,
    "pointer": pointer_report,
    "hotkeys": lambda probe, _: {"hotkeys": heard_hotkeys(probe.display)},
    "panic": lambda probe, _: {"stopped by": stopped_by(probe.display)},
    "window": window_report,
}


def main(part: str) -> dict[str, Any]:
    probe = Probe(Display(), LEFT, TOP, TITLE)
    with open_desktop(r"^Minecraft\*? \d") as desktop:
        probe.focus()
        probe.draw()
        return PARTS[part](probe, desktop)


if __name__ == "__main__":
    json.dump(main(sys.argv[1]), sys.stdout)
