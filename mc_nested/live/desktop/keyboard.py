"""The real keyboard, through pynput."""

import sys
from contextlib import suppress
from typing import Any

from pynput.keyboard import Controller, Key, KeyCode

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.connection import LOST, told_when_lost
from mc_nested.live.desktop.keys import WORDS, check_key


class DesktopKeyboard:
    """Presses keys into whatever window is in front: whoever calls it has looked which one that is.

    Raises (every method): ProfileError for a name that no key has, DesktopError for a key that this keyboard's
    layout hasn't; a press also where the display has closed.
    """

    def __init__(self) -> None:
        self._controller: Any = Controller()

    def press(self, key: str) -> None:
        with told_when_lost():
            self._controller.press(self._on_layout(key))

    def release(self, key: str) -> None:
        with suppress(*LOST):
            self._controller.release(self._on_layout(key))

    def type(self, text: str) -> None:
        try:
            with told_when_lost():
                self._controller.type(text)
        except Controller.InvalidCharacterException as error:
            raise DesktopError(f"{text!r} can't be typed with this keyboard layout: switch to a Latin one") from error

    def _on_layout(self, name: str) -> Key | KeyCode:
        key = pynput_key(name)
        code: Any = key.value if isinstance(key, Key) else key
        # Asked first, since an X server answers a key that it doesn't have with an error that comes too late to mend.
        if sys.platform.startswith("linux") and code.vk not in self._controller.keyboard_mapping:
            raise DesktopError(f"this keyboard's layout has no key {name!r}: switch to a Latin one")
        return key


def pynput_key(name: str) -> Key | KeyCode:
    """The key of that name; ProfileError where there is none."""
    check_key(name)
    if name in WORDS:
        return Key[WORDS[name]]
    if sys.platform.startswith("linux"):
        # pynput sends a plain character as an event without a time (XSendEvent). GLFW, which takes the game's keys
        # before 26.3, compares times and drops such a press as a double once the key was pressed by hand. Named by its
        # keysym, for Latin 1 the character's own number, the key is pressed through XTEST, as the named keys are.
        return KeyCode.from_vk(ord(name.lower()))
    return KeyCode.from_char(name)
