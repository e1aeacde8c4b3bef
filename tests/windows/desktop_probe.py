"""Prints, as one JSON object, how the Windows desktop's code works on a GLFW window. For a Windows Python.

usage: desktop_probe.py. A program of its own, since it runs under Wine; the parts that are the same on every system are
in window_probe.py (tests/live/desktop/real_windows).
"""

import ctypes
import json
import queue
import sys
import time
from typing import Any

import numpy as np

from mc_nested.errors import DesktopError
from mc_nested.live.desktop import open_desktop
from mc_nested.live.desktop.panic import open_panic_switch
from mc_nested.live.devices import Devices, Region
from tests.live.desktop.real_windows.window_driver import PATIENCE_S, DrivenWindow, driven_window

assert sys.platform == "win32"

HOLD_S = 0.15
TEXT = "/execute in minecraft:overworld run tp @s 0.5 64 é"
PUSH, PUSH_S = 23, 0.02
"""Pixels and seconds of a push of the mouse. Windows passes over a program that is slow to hear of one."""

_user32 = ctypes.WinDLL("user32")


def place_report(window: DrivenWindow, devices: Devices) -> dict[str, Any]:
    """Return the window as the project sees it, and as GLFW does; and the programs of the windows that have a title."""
    from mc_nested.live.desktop.win32 import titled_windows

    return {
        "programs": {title: program for _, (title, program) in titled_windows()},
        "size": devices.display.size(),
        "title": devices.display.title(),
        "is in front": devices.display.is_in_front(),
        "of GLFW": window.ask("state"),
    }


def grab_report(_: DrivenWindow, devices: Devices) -> dict[str, Any]:
    """Return how many colours each half of the picture has, and of a region across both; and the colours."""
    width, _ = devices.display.size()
    whole = devices.display.grab()
    middle = devices.display.grab(Region(width // 2 - 10, 10, 20, 30))
    parts = {"left": whole[:, : width // 2], "right": whole[:, width // 2 :], "middle": middle}
    return {"shape": whole.shape} | {
        name: np.unique(part.reshape(-1, 3), axis=0).tolist() for name, part in parts.items()
    }


def hold_report(window: DrivenWindow, devices: Devices) -> list[dict[str, Any]]:
    """Return, for each of ten holds, the events, and the seconds between sending the press and the release."""
    found = []
    for _hold in range(10):
        pressed = devices.clock.now()
        devices.keyboard.press("w")
        devices.clock.sleep_until(pressed + HOLD_S)
        devices.keyboard.release("w")
        held = devices.clock.now() - pressed
        events = window.events_until(lambda came: any(each[0] == "key" and each[3] == 0 for each in came))
        found.append({"events": [each[1:] for each in events if each[0] == "key"], "held": held})
    return found


def sneak_report(window: DrivenWindow, devices: Devices) -> list[list[int]]:
    """Return the events while Shift is held around two steps."""
    devices.keyboard.press("left.shift")
    for _step in range(2):
        devices.clock.sleep_until(devices.clock.now() + HOLD_S)
        devices.keyboard.press("w")
        devices.clock.sleep_until(devices.clock.now() + HOLD_S)
        devices.keyboard.release("w")
    devices.keyboard.release("left.shift")
    events = window.events_until(lambda came: sum(each[0] == "key" and each[3] == 0 for each in came) == 3)
    return [[each[1], each[3]] for each in events if each[0] == "key"]


def pointer_report(window: DrivenWindow, devices: Devices) -> dict[str, Any]:
    """Return where GLFW sees the cursor that was moved to some points, and the buttons that it sees."""
    points = ((0, 0), (100, 50), (160, 120), (319, 239))
    seen = []
    for point in points:
        devices.pointer.move(*point)
        # A cursor that is there already makes no event.
        events = window.events_until(lambda came, at=point: ["cursor", *map(float, at)] in came)
        seen.append([each[1:] for each in events if each[0] == "cursor"][-1:])
    for button in ("left", "right", "middle"):
        devices.pointer.press(button)
        devices.pointer.release(button)
    events = window.events_until(lambda came: sum(each[0] == "button" for each in came) == 6)
    return {"cursor": seen, "buttons": [each[1:] for each in events if each[0] == "button"]}


def clipboard_report(_: DrivenWindow, devices: Devices) -> dict[str, Any]:
    before = devices.clipboard.read()
    devices.clipboard.write(TEXT)
    read = devices.clipboard.read()
    devices.clipboard.write(before)
    return {"read": read}


def corner_report(_: DrivenWindow, __: Devices) -> list[list[str]]:
    """Return what the panic switch says for each corner that the mouse is pushed into, as a hand pushes it."""
    width, height = _user32.GetSystemMetrics(0), _user32.GetSystemMetrics(1)
    found = []
    for x, y, right, down in (
        (0, 0, -1, -1),
        (width - 1, 0, 1, -1),
        (0, height - 1, -1, 1),
        (width - 1, height - 1, 1, 1),
    ):
        said: queue.SimpleQueue[str] = queue.SimpleQueue()
        _user32.SetCursorPos(x - 40 * right, y - 40 * down)
        with open_panic_switch("f12", said.put):
            end = time.monotonic() + PATIENCE_S
            while said.empty() and time.monotonic() < end:
                _user32.mouse_event(1, PUSH * right, PUSH * down, 0, 0)
                time.sleep(PUSH_S)
            found.append([] if said.empty() else [said.get()])
    _user32.SetCursorPos(width // 2, height // 2)
    return found


def edge_report(window: DrivenWindow, devices: Devices) -> dict[str, str]:
    """Return what is said of a window that is partly off the screen."""
    window.ask("move", _user32.GetSystemMetrics(0) - 100, 100)
    end = time.monotonic() + PATIENCE_S
    problem = ""
    while not problem and time.monotonic() < end:
        problem = _problem_of(devices)
    return {"error": problem}


def _problem_of(devices: Devices) -> str:
    try:
        devices.display.grab()
    except DesktopError as error:
        return str(error)
    return ""


def main() -> None:
    with driven_window() as window, open_desktop(r"^Minecraft\*? \d") as devices:
        report = {
            "place": place_report(window, devices),
            "grab": grab_report(window, devices),
            "hold": hold_report(window, devices),
            "sneak": sneak_report(window, devices),
            "pointer": pointer_report(window, devices),
            "clipboard": clipboard_report(window, devices),
            "corner": corner_report(window, devices),
            "edge": edge_report(window, devices),
        }
    json.dump(report, sys.stdout)


if __name__ == "__main__":
    main()
