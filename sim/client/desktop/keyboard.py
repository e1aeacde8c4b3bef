"""The virtual keyboard."""

from sim.client.desktop.window import VirtualWindow
from sim.client.game.controls import Controls


class VirtualKeyboard:
    """Keys that reach the game through its window."""

    def __init__(self, window: VirtualWindow, controls: Controls) -> None:
        self._window, self._controls = window, controls

    def press(self, key: str) -> None:
        self._window.press(key, lambda: self._controls.key(key, is_down=True))

    def release(self, key: str) -> None:
        self._window.release(key, lambda: self._controls.key(key, is_down=False))

    def type(self, text: str) -> None:
        for letter in text:
            self.press(letter)
            self.release(letter)
