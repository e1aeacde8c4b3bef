"""Drives a GLFW window through the desktop's own devices, and prints what reached it as one JSON object.

usage: glfw_probe.py PART [ARGUMENT in JSON]. A process of its own, since pyautogui keeps to the display of its import.
It runs on every system that the desktop's devices are for.
"""

import json
import queue
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[3]))  # a Windows Python that was only unpacked knows no PYTHONPATH

from mc_nested.errors import McNestedError
from mc_nested.live.desktop import open_desktop
from mc_nested.live.desktop.hotkeys import open_hotkeys
from mc_nested.live.desktop.key_listener import listening
from mc_nested.live.desktop.panic import open_panic_switch
from mc_nested.live.devices import Devices
from tests.live.desktop.glfw_driver import PATIENCE_S, DrivenWindow, Event, driven_window

PRESSED, RELEASED = 1, 0
CLICKS = 100


def key_report(window: DrivenWindow, devices: Devices, names: list[str]) -> dict[str, Any]:
    """The GLFW keys that each of these keys arrives as, pressed and released, or the error."""
    report: dict[str, Any] = {}
    for name in names:
        try:
            devices.keyboard.press(name)
            devices.keyboard.release(name)
        except McNestedError as error:
            report[name] = str(error)
            continue
        events = window.events_until(lambda came: any(_is_key(each, RELEASED) for each in came))
        report[name] = [[each[1], each[3]] for each in events if each[0] == "key"]
    return report


def text_report(window: DrivenWindow, devices: Devices, text: str) -> dict[str, Any]:
    """The characters that a typed text arrives as, or the error."""
    try:
        devices.keyboard.type(text)
    except McNestedError as error:
        return {"error": str(error)}
    events = window.events_until(lambda came: sum(each[0] == "char" for each in came) >= len(text))
    return {"text": "".join(chr(each[1]) for each in events if each[0] == "char")}


def click_report(window: DrivenWindow, devices: Devices, _: None) -> dict[str, Any]:
    """How often each kind of event comes while the window holds the mouse and is clicked 100 times."""
    devices.pointer.move(100, 100)
    has_raw = window.ask("grab cursor")
    window.ask("events")  # the pointer's way into the window: else it passes for the movement that is waited for next
    devices.pointer.move(120, 120)
    window.events_until(lambda came: any(each[0] == "cursor" for each in came))
    for _click in range(CLICKS):
        devices.pointer.press("right")
        devices.pointer.release("right")
    events = window.events_until(lambda came: sum(each[0] == "button" for each in came) == 2 * CLICKS)
    devices.pointer.release("right")  # once more, as it is done before a world is left
    events += window.events_until(lambda _: True)
    window.ask("free cursor")
    kinds = ("button", "cursor")
    return {"has raw motion": has_raw, **{kind: sum(each[0] == kind for each in events) for kind in kinds}}


def listener_report(window: DrivenWindow, devices: Devices, _: None) -> dict[str, Any]:
    """The keys that are heard while keys are pressed and a text is typed."""
    heard: queue.SimpleQueue[tuple[str, bool]] = queue.SimpleQueue()
    with listening(lambda name, is_down: heard.put((name, is_down))):
        for name in ("w", "left.shift", "f12"):
            devices.keyboard.press(name)
            devices.keyboard.release(name)
        devices.keyboard.type("was")
        devices.keyboard.press("/")
        devices.keyboard.release("/")
        came = [heard.get(timeout=PATIENCE_S) for _key in range(8)]
    window.ask("events")
    return {"heard": came}


def hotkey_report(_: DrivenWindow, devices: Devices, __: None) -> dict[str, Any]:
    """What the panic key and a hotkey, each a letter, do when they are pressed beside others."""
    stopped: queue.SimpleQueue[str] = queue.SimpleQueue()
    with open_panic_switch("z", stopped.put), open_hotkeys(("Q",)) as next_key:
        for name in ("w", "a", "q", "z"):
            devices.keyboard.press(name)
            devices.keyboard.release(name)
        return {"stopped": [stopped.get(timeout=PATIENCE_S)], "hotkeys": [next_key().lower()]}


def _is_key(event: Event, action: int) -> bool:
    return event[0] == "key" and bool(event[3] == action)


PARTS: dict[str, Callable[[DrivenWindow, Devices, Any], dict[str, Any]]] = {
    "keys": key_report,
    "text": text_report,
    "clicks": click_report,
    "listener": listener_report,
    "hotkeys": hotkey_report,
}


def main(part: str, argument: str = "null") -> None:
    with driven_window() as window, open_desktop(r"^Minecraft\*? \d") as devices:
        json.dump(PARTS[part](window, devices, json.loads(argument)), sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
