"""The virtual keyboard: a US one, whose keys are named by their places."""

from functools import partial

from mc_nested.live.model.key_names import canonical, check_key
from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls


class VirtualKeyboard:
    """Keys and characters that reach the game through its window.

    A key that is pressed also types what a US keyboard types there. Typed text presses the keys that have its
    characters, as text does on X11 and macOS; a character that is on no key comes alone, as every one does on Windows.
    """

    def __init__(self, window: VirtualWindow, controls: Controls) -> None:
        self._window, self._controls = window, controls

    def press(self, key: str) -> None:
        check_key(key)
        name = canonical(key)
        self._window.press(name, partial(self._go_down, name, " " if name == "space" else name))

    def release(self, key: str) -> None:
        check_key(key)
        name = canonical(key)
        self._window.release(name, partial(self._controls.key, name, is_down=False))

    def type(self, text: str) -> None:
        for character in text:
            name = "space" if character == " " else canonical(character)
            self._window.press(character, partial(self._go_down, name, character))
            self._window.release(character, partial(self._controls.key, name, is_down=False))

    def _go_down(self, key: str, typed: str) -> None:
        self._controls.key(key, is_down=True)
        if len(typed) == 1:
            self._controls.character(typed)
