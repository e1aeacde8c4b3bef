"""The virtual keyboard, with the layout of the United States."""

from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls

_CONTROL = ("left.control", "right.control", "ctrl")


class VirtualKeyboard:
    """Keys and characters that reach the game through its window."""

    def __init__(self, window: VirtualWindow, controls: Controls) -> None:
        self._window, self._controls = window, controls

    def press(self, key: str) -> None:
        character = " " if key == "space" else key if len(key) == 1 else ""
        # With Control, a key makes no character.
        has_character = bool(character) and not self._window.down.intersection(_CONTROL)

        def arrive() -> None:
            self._controls.key(key, is_down=True)
            if has_character:
                self._controls.character(character)

        self._window.press(key, arrive)

    def release(self, key: str) -> None:
        self._window.release(key, lambda: self._controls.key(key, is_down=False))

    def type(self, text: str) -> None:
        for letter in text:
            self.press(letter)
            self.release(letter)
