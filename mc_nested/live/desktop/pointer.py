"""The real mouse: pyautogui moves it and asks where it is, pynput presses its buttons.

pyautogui's own presses also move the mouse to where it is. A game that holds the mouse takes that as a turn: with raw
motion on, of some 70 to 100 degrees (FACTS: Input and windows).
"""

import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from mc_nested.errors import LiveError
from mc_nested.live.desktop.lost_display import LOST, raise_when_display_lost
from mc_nested.live.desktop.window import GameWindow
from mc_nested.live.devices import Button


class DesktopPointer:
    """The mouse, in pixels of the window's client area; ``ratio`` gives pixels to a point of the desktop."""

    def __init__(self, window: GameWindow, ratio: Callable[[], float]) -> None:
        self._window = window
        self._ratio = ratio
        self._mouse = load_pyautogui()
        from pynput import mouse  # needs a display when it is imported

        self._buttons: Any = mouse.Controller()
        self._named: Any = mouse.Button

    def position(self) -> tuple[int, int]:
        area, ratio = self._window.client_area(), self._ratio()
        x, y = self._mouse.position()
        return round((x - area.left) * ratio), round((y - area.top) * ratio)

    def move(self, x: int, y: int) -> None:
        area, ratio = self._window.client_area(), self._ratio()
        self._mouse.moveTo(area.left + x / ratio, area.top + y / ratio, _pause=False)

    def press(self, button: Button) -> None:
        with raise_when_display_lost():
            if tuple(self._mouse.position()) in self._mouse.FAILSAFE_POINTS:
                raise LiveError("the mouse is in a corner of the screen, which means stop: nothing was clicked")
            self._buttons.press(self._named[button])

    def release(self, button: Button) -> None:
        with suppress(*LOST):
            self._buttons.release(self._named[button])


def load_pyautogui() -> Any:
    """Return the module pyautogui without its pauses and its fail-safe, which would also refuse to release a button."""
    # mouseinfo ends the whole process where tkinter is missing, and pyscreeze starts programs that this project doesn't
    # need. With None in sys.modules, their import fails in the one way that pyautogui handles.
    blocked = [name for name in ("mouseinfo", "pyscreeze") if name not in sys.modules]
    sys.modules.update(dict.fromkeys(blocked))  # type: ignore[arg-type]  # None is what Python documents for this
    try:
        import pyautogui
    finally:
        for name in blocked:
            del sys.modules[name]
    pyautogui.PAUSE = 0
    pyautogui.FAILSAFE = False
    return pyautogui
