"""Drives a real window through the desktop's own devices, and prints what reached it as one JSON object.

usage: window_probe.py PART [ARGUMENT in JSON [TITLE PROGRAM...]]. A process of its own, since pyautogui keeps to the
display of its import. It runs on every system that the desktop's devices are for. Without a program the window is
GLFW's.
"""

import json
import queue
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[4]))  # a Windows Python that was only unpacked knows no PYTHONPATH

from mc_nested.errors import McNestedError
from mc_nested.live.connection import prepare_keyboard
from mc_nested.live.desktop import open_desktop
from mc_nested.live.desktop.key_listener import listening, open_hotkeys
from mc_nested.live.desktop.panic import open_panic_switch
from mc_nested.live.devices import Devices
from mc_nested.live.profile.tables import Profile
from tests.live.desktop.real_windows.window_driver import GLFW_WINDOW, PATIENCE_S, TITLE, DrivenWindow, driven_window
from tests.live.desktop.real_windows.window_server import Event

PRESSED, RELEASED = 1, 0
CLICKS = 100
TRIES = 50
MARK, MARK_NAME = "left.control", "LCONTROL"
"""A key that comes after each place, by LWJGL's name: a modifier, which an accent doesn't wait for."""

CLICK_S = 0.02
"""Seconds of a click, and between two. The game's are longer; SDL 3 loses or doubles some that are shorter."""

MOVED_S = 1.0
"""Seconds within which a movement of the pointer comes, if the window takes it for one."""


def key_report(window: DrivenWindow, devices: Devices, names: list[str]) -> dict[str, Any]:
    """Return the keys of the window that each of these keys arrives as, pressed and released, or the error."""
    report: dict[str, Any] = {}
    for name in names:
        try:
            devices.keyboard.press(name)
            devices.keyboard.release(name)
        except McNestedError as error:
            report[name] = str(error)
            continue
        report[name] = _keys(window.events_until(_are_up))
    return report


def symbol_report(window: DrivenWindow, devices: Devices, names: list[str]) -> dict[str, Any]:
    """Return what places arrive as, alone and beside Shift; then what ``prepared_report`` says."""
    report: dict[str, Any] = {"alone": _place_report(window, devices, names)}
    devices.keyboard.press("left.shift")
    window.events_until(lambda came: any(_is_key(each, PRESSED) for each in came))
    report["shifted"] = _place_report(window, devices, names)
    devices.keyboard.release("left.shift")
    window.events_until(lambda came: any(_is_key(each, RELEASED) for each in came))
    return report | prepared_report(window, devices, names)


def prepared_report(window: DrivenWindow, devices: Devices, names: list[str]) -> dict[str, Any]:
    """Return what keys arrive as, pressed as the title's version has them.

    ``refused`` is why a profile's own can't be.
    """
    report: dict[str, Any] = {}
    try:
        prepare_keyboard(Profile(), devices)
    except McNestedError as error:
        report["refused"] = str(error)
    return report | {"keys": key_report(window, devices, names)}


def _place_report(window: DrivenWindow, devices: Devices, names: list[str]) -> dict[str, Any]:
    """Return what each place arrives as; nothing for a dead accent, which waits for the next key and takes it, too."""

    def tap(name: str) -> list[list[Any]]:
        for key in (name, MARK):
            devices.keyboard.press(key)
            devices.keyboard.release(key)
        came = _keys(window.events_until(lambda came: _keys(came)[-1:] == [[MARK_NAME, RELEASED]]))
        return [each for each in came if each[0] != MARK_NAME]

    report: dict[str, Any] = {}
    for name in names:
        report[name] = tap(name)
        if not report[name]:
            tap("esc")
    return report


def focus_report(window: DrivenWindow, devices: Devices, _: None) -> dict[str, Any]:
    """Return whether the window is in front, by itself and by the project, while another is opened and closed."""
    seen = [[window.ask("state")["has focus"], devices.display.is_in_front()]]
    with driven_window(title="Terraria"):
        came = window.events_until(lambda came: ["focus", 0] in came)
        seen.append([window.ask("state")["has focus"], devices.display.is_in_front()])
        devices.keyboard.press("w")
        devices.keyboard.release("w")
    came += window.events_until(lambda came: ["focus", 1] in came)
    seen.append([window.ask("state")["has focus"], devices.display.is_in_front()])
    return {"in front": seen, "keys": _keys(came)}


def text_report(window: DrivenWindow, devices: Devices, text: str) -> dict[str, Any]:
    """Return the characters that a typed text arrives as, or the error."""
    window.ask("take text")
    try:
        devices.keyboard.type(text)
    except McNestedError as error:
        return {"error": str(error)}
    events = window.events_until(lambda came: sum(each[0] == "char" for each in came) >= len(text))
    return {"text": "".join(chr(each[1]) for each in events if each[0] == "char")}


def click_report(window: DrivenWindow, devices: Devices, _: None) -> dict[str, Any]:
    """Return how often each kind of event comes while the window holds the mouse and is clicked 100 times.

    ``moves`` is whether the pointer's own movement before it came as one.
    """
    devices.pointer.move(100, 100)
    has_raw = window.ask("grab cursor")
    window.ask("events")  # the pointer's way into the window: else it passes for the movement that is waited for next
    devices.pointer.move(120, 120)
    moved = window.events_until(lambda came: any(each[0] == "cursor" for each in came), MOVED_S)
    for _click in range(CLICKS):
        devices.pointer.press("right")
        time.sleep(CLICK_S)
        devices.pointer.release("right")
        time.sleep(CLICK_S)
    events = window.events_until(lambda came: sum(each[0] == "button" for each in came) == 2 * CLICKS)
    devices.pointer.release("right")  # once more, as it is done before a world is left
    events += window.events_until(lambda _: True)
    window.ask("free cursor")
    counts = {kind: sum(each[0] == kind for each in events) for kind in ("button", "cursor")}
    return {"has raw motion": has_raw, "moves": bool(moved), **counts}


def listener_report(window: DrivenWindow, devices: Devices, _: None) -> dict[str, Any]:
    """Return the keys that are heard while keys are pressed and a text is typed."""
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
    """Return what the panic key and a hotkey, each a letter, do when they are pressed beside others."""
    stopped: queue.SimpleQueue[str] = queue.SimpleQueue()
    with open_panic_switch("z", stopped.put), open_hotkeys(("Q",)) as next_key:
        for name in ("w", "a", "q", "z"):
            devices.keyboard.press(name)
            devices.keyboard.release(name)
        return {"stopped": [stopped.get(timeout=PATIENCE_S)], "hotkeys": [next_key().lower()]}


def at_once_report(_: DrivenWindow, devices: Devices, __: None) -> dict[str, Any]:
    """Return how many listeners hear a key that is pressed as soon as they are open."""
    heard: queue.SimpleQueue[str] = queue.SimpleQueue()
    count = 0
    for _try in range(TRIES):
        with listening(lambda name, _: heard.put(name)):
            devices.keyboard.press("q")
            devices.keyboard.release("q")
            with suppress(queue.Empty):
                count += [heard.get(timeout=MOVED_S) for _event in range(2)] == ["q", "q"]
    return {"heard": count}


def _keys(events: list[Event]) -> list[list[Any]]:
    """Return the keys and what they do, without what repeats."""
    return [[each[1], each[3]] for each in events if each[0] == "key" and each[3] in (PRESSED, RELEASED)]


def _are_up(events: list[Event]) -> bool:
    """Return whether all keys are up again that went down, and any did."""
    return 0 < sum(_is_key(each, PRESSED) for each in events) <= sum(_is_key(each, RELEASED) for each in events)


def _is_key(event: Event, action: int) -> bool:
    return event[0] == "key" and bool(event[3] == action)


PARTS: dict[str, Callable[[DrivenWindow, Devices, Any], dict[str, Any]]] = {
    "keys": key_report,
    "symbols": symbol_report,
    "profile keys": prepared_report,
    "focus": focus_report,
    "text": text_report,
    "clicks": click_report,
    "listener": listener_report,
    "hotkeys": hotkey_report,
    "at once": at_once_report,
}


def main(part: str, argument: str = "null", title: str = TITLE, *program: str) -> None:
    with driven_window(program or GLFW_WINDOW, title) as window, open_desktop(r"^Minecraft\*? \d") as devices:
        json.dump(PARTS[part](window, devices, json.loads(argument)), sys.stdout)


if __name__ == "__main__":
    main(*sys.argv[1:])
