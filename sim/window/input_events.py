"""Pass GLFW's events on to the virtual client as the game takes them (FACTS: Keys; Input and windows).

GLFW names keys by the place where a keyboard of the United States has them, as profiles do.
"""

from typing import Any

import glfw

from mc_nested.live.devices import Button
from sim.client.client import VirtualClient
from sim.client.desktop.keyboard import key_of
from sim.window.glfw_window import GlfwWindow

_WORDS = {
    32: "space",
    256: "esc",
    257: "enter",
    258: "tab",
    259: "backspace",
    260: "insert",
    261: "delete",
    262: "right",
    263: "left",
    264: "down",
    265: "up",
    266: "page.up",
    267: "page.down",
    268: "home",
    269: "end",
    280: "caps.lock",
    340: "left.shift",
    341: "left.control",
    342: "left.alt",
    343: "left.win",
    344: "right.shift",
    345: "right.control",
    346: "right.alt",
    347: "right.win",
}
_FIRST_FUNCTION_KEY = 290
_CHARACTERS = "abcdefghijklmnopqrstuvwxyz0123456789`-=[]\\;',./"

PLACES: dict[int, str] = (
    _WORDS
    | {ord(character.upper()): character for character in _CHARACTERS}
    | {_FIRST_FUNCTION_KEY + number: f"f{number + 1}" for number in range(20)}
)
"""The name of each place, by GLFW's number of its key (glfw3.h)."""


def symbol_at(place: str, made: str | None, *, has_shift: bool) -> str:
    """Return the key that LWJGL 2 takes, to 1.12, for the one at a place (FACTS: Input and windows); "" for none.

    ``made`` is the character of the key without Shift, as GLFW says. GLFW doesn't say the character with Shift. On the
    layouts known here the game uses only digits among those, on keys that make no digit without Shift.
    """
    if len(place) > 1:
        return place
    plain = key_of(made or "")
    return place if has_shift and place.isdigit() and not plain.isdigit() else plain


_BUTTONS: dict[int, Button] = {0: "left", 1: "right", 2: "middle"}


class InputEvents:
    """Keys by their place, characters, the mouse, the focus and the size of a window, for a client.

    While the client's world is played, the cursor is disabled and, where GLFW offers it, moved by raw motion.
    """

    def __init__(self, window: GlfwWindow, client: VirtualClient) -> None:
        self._window, self._client = window, client
        self._is_grabbed: bool | None = None
        self._last: tuple[float, float] | None = None
        handle = window.handle
        glfw.set_key_callback(handle, self._on_key)
        glfw.set_char_callback(handle, self._on_character)
        glfw.set_mouse_button_callback(handle, self._on_button)
        glfw.set_cursor_pos_callback(handle, self._on_cursor)
        glfw.set_window_focus_callback(handle, self._on_focus)
        glfw.set_framebuffer_size_callback(handle, self._on_size)
        if glfw.raw_mouse_motion_supported():
            glfw.set_input_mode(handle, glfw.RAW_MOUSE_MOTION, glfw.TRUE)

    def follow_screen(self) -> None:
        """Grab the cursor or free it, as the client's screen wants it now."""
        is_grabbed = self._client.pointer.is_held
        if is_grabbed == self._is_grabbed:
            return
        self._is_grabbed = is_grabbed
        handle = self._window.handle
        width, height = glfw.get_window_size(handle)
        # The first movement after the game has taken the mouse is lost (FACTS: Keys).
        self._last = None
        glfw.set_input_mode(handle, glfw.CURSOR, glfw.CURSOR_DISABLED if is_grabbed else glfw.CURSOR_NORMAL)
        glfw.set_cursor_pos(handle, width / 2, height / 2)

    def _on_key(self, _window: Any, key: int, scancode: int, action: int, modifiers: int) -> None:
        client, name = self._client, PLACES.get(key)
        if name and not client.edition.since(1, 13):
            made = glfw.get_key_name(key, scancode)
            name = symbol_at(name, made, has_shift=bool(modifiers & glfw.MOD_SHIFT))
        if not name:
            return
        if action == glfw.RELEASE:
            client.window.release(name, lambda: client.controls.key(name, is_down=False))
        elif action == glfw.PRESS:
            client.window.press(name, lambda: client.controls.key(name, is_down=True))
        elif name == "backspace":  # a held key repeats in a text alone
            client.window.deliver(lambda: client.controls.key(name, is_down=True))

    def _on_character(self, _window: Any, character: int) -> None:
        controls = self._client.controls
        self._client.window.deliver(lambda: controls.character(chr(character)))

    def _on_button(self, _window: Any, button: int, action: int, _modifiers: int) -> None:
        name = _BUTTONS.get(button)
        if name is None:
            return
        if action == glfw.PRESS:
            self._client.pointer.press(name)
        else:
            self._client.pointer.release(name)

    def _on_cursor(self, _window: Any, x: float, y: float) -> None:
        if not self._is_grabbed:
            if self._client.pointer.is_held:  # to be grabbed at the next frame: this is no turn of the mouse
                return
            ratio = self._window.pixels_a_point
            self._client.pointer.move(int(x * ratio), int(y * ratio))
            return
        last, self._last = self._last, (x, y)
        if last is not None:
            self._client.turn(x - last[0], y - last[1])

    def _on_focus(self, _window: Any, is_focused: int) -> None:
        self._client.set_front(is_in_front=bool(is_focused))

    def _on_size(self, _window: Any, width: int, height: int) -> None:
        if width and height:
            self._client.resize((width, height))
