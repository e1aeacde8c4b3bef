"""Keys and text on macOS, through pynput: keys by the virtual keycode of their place, text by the keyboard's layout."""

from typing import Any

from pynput.keyboard import Controller, Key, KeyCode

from mc_nested.errors import DesktopError
from mc_nested.live.model.keys import PLACES, KeyPlace

_MODIFIERS: dict[int, Any] = {
    PLACES[place].mac: Key[f"{name}_{side[0]}"]
    for side in ("left", "right")
    for place, name in (
        (f"{side}.shift", "shift"),
        (f"{side}.control", "ctrl"),
        (f"{side}.alt", "alt"),
        (f"{side}.win", "cmd"),
    )
}
"""Keys that pynput has to know by its own names: it sets their flags on every later event."""


class QuartzKeySender:
    """Sends keys and characters as a keyboard's own."""

    def __init__(self, controller: Any) -> None:
        self._controller = controller

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        key = _MODIFIERS.get(place.mac) or KeyCode.from_vk(place.mac)
        (self._controller.press if is_down else self._controller.release)(key)

    def layout(self) -> None:
        """Return None: on macOS LWJGL 2 takes keycodes, which are places."""

    def type(self, character: str) -> None:
        try:
            try:
                self._controller.press(character)
            finally:
                self._controller.release(character)
        except (Controller.InvalidKeyException, Controller.InvalidCharacterException) as error:
            raise DesktopError(
                f"{character!r} can't be typed with this keyboard layout: switch to a Latin one"
            ) from error
