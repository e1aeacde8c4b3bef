"""The devices of a virtual client: the same protocols as a desktop's (mc_nested.live.devices)."""

from typing import TYPE_CHECKING

from mc_nested.live.devices import Button, Frame, Region

if TYPE_CHECKING:
    from sim.client.client import VirtualClient


class VirtualDisplay:
    """The client's window."""

    def __init__(self, client: "VirtualClient") -> None:
        self._client = client

    def size(self) -> tuple[int, int]:
        return self._client.window.size

    def title(self) -> str:
        return self._client.title

    def is_in_front(self) -> bool:
        return self._client.window.is_in_front

    def grab(self, region: Region | None = None) -> Frame:
        return self._client.grab(region)


class VirtualKeyboard:
    """The desktop's keys."""

    def __init__(self, client: "VirtualClient") -> None:
        self._client = client

    def press(self, key: str) -> None:
        controls = self._client.controls
        self._client.window.press(key, lambda: controls.key(key, is_down=True))

    def release(self, key: str) -> None:
        controls = self._client.controls
        self._client.window.release(key, lambda: controls.key(key, is_down=False))

    def type(self, text: str) -> None:
        for letter in text:
            self.press(letter)
            self.release(letter)


class VirtualPointer:
    """The desktop's mouse. While the game holds it, it stays in the window's middle and moving it turns the view."""

    def __init__(self, client: "VirtualClient") -> None:
        self._client = client

    def position(self) -> tuple[int, int]:
        return self._client.pointer_position()

    def move(self, x: int, y: int) -> None:
        self._client.move_pointer(x, y)

    def press(self, button: Button) -> None:
        self._client.press_button(button, is_down=True)

    def release(self, button: Button) -> None:
        self._client.press_button(button, is_down=False)


class VirtualClipboard:
    """The desktop's clipboard."""

    def __init__(self) -> None:
        self._text = ""

    def read(self) -> str:
        return self._text

    def write(self, text: str) -> None:
        self._text = text
