"""The real keyboard, through pynput."""

import sys
from contextlib import suppress
from typing import Any

from pynput.keyboard import Controller, Key, KeyCode

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.lost_display import LOST, raise_when_display_lost
from mc_nested.live.model.key_names import WORDS, check_key


class DesktopKeyboard:
    """Presses keys into whatever window is in front; the caller checks which window that is.

    Raises (every method): ProfileError for a name that no key has, DesktopError for a key that this keyboard's
    layout lacks; a press also where the display has closed.
    """

    def __init__(self) -> None:
        self._controller: Any = Controller()

    def press(self, key: str) -> None:
        with raise_when_display_lost():
            self._controller.press(self._on_layout(key))

    def release(self, key: str) -> None:
        with suppress(*LOST):
            self._controller.release(self._on_layout(key))

    def type(self, text: str) -> None:
        try:
            with raise_when_display_lost():
                self._controller.type(text)
        except Controller.InvalidCharacterException as error:
            raise DesktopError(f"{text!r} can't be typed with this keyboard layout: switch to a Latin one") from error

    def _on_layout(self, name: str) -> Key | KeyCode:
        key = pynput_key(name)
        code: Any = key.value if isinstance(key, Key) else key
        # Checked first: the X server's own error for a missing key comes too late.
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
        # before 26.3, compares times and drops such a press as a double once the key was pressed by hand. Given as its
        # keysym, which for Latin 1 is the character's own number, the key is pressed through XTEST, as named keys are.
        return KeyCode.from_vk(ord(name.lower()))
    return KeyCode.from_char(name)
