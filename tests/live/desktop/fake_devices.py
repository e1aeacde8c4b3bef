"""Made-up pynput and pyautogui: the real ones can't be imported without a display."""

import enum
import importlib
import sys
from collections.abc import Callable
from types import ModuleType, SimpleNamespace
from typing import Any, ClassVar

import pytest

from mc_nested.live.desktop.lost_display import LOST


class KeyCode:
    """A key without a name of its own."""

    def __init__(self, vk: int | None = None, char: str | None = None) -> None:
        self.vk, self.char = vk, char

    @classmethod
    def from_vk(cls, vk: int) -> "KeyCode":
        return cls(vk=vk)

    @classmethod
    def from_char(cls, char: str) -> "KeyCode":
        return cls(char=char)


_MODIFIERS = [f"{name}_{side}" for name in ("alt", "cmd", "ctrl", "shift") for side in "lr"]
Key: Any = enum.Enum("Key", {name: KeyCode(vk=1000 + index) for index, name in enumerate(_MODIFIERS)})  # type: ignore[misc]


class Listener:
    """A thread that hears keys or the mouse; here the test says what it hears."""

    started: ClassVar[list["Listener"]]
    is_silent = False
    """Whether the desktop lets no program listen."""

    def __init__(self, **heard: Callable[..., None]) -> None:
        self.heard = heard
        self.is_running = False
        self.joined: list[float] = []

    def __enter__(self) -> "Listener":
        self.is_running = not type(self).is_silent
        type(self).started.append(self)
        return self

    def __exit__(self, *_: object) -> None:
        self.is_running = False

    def wait(self) -> None:
        pass

    def is_alive(self) -> bool:
        return self.is_running

    def join(self, timeout: float) -> None:
        self.joined.append(timeout)


class Controller:
    """A keyboard that notes what is sent."""

    class InvalidKeyException(Exception):  # noqa: N818 - pynput's name
        """A key that can't be pressed."""

    class InvalidCharacterException(Exception):  # noqa: N818 - pynput's name
        """A character that can't be typed."""

    def __init__(self) -> None:
        self.sent: list[tuple[str, Any]] = []
        self.is_interrupted = False

    def press(self, key: Any) -> None:
        self._send("press", key)
        if self.is_interrupted:
            raise KeyboardInterrupt

    def release(self, key: Any) -> None:
        self._send("release", key)

    def _send(self, kind: str, what: Any) -> None:
        if what == "木":
            raise self.InvalidKeyException
        self.sent.append((kind, what))


class Buttons:
    """The mouse's buttons, as long as there is a display."""

    def __init__(self) -> None:
        self.sent: list[tuple[str, str]] = []
        self.has_display = True

    def press(self, button: str) -> None:
        self._send("down", button)

    def release(self, button: str) -> None:
        self._send("up", button)

    def _send(self, kind: str, button: str) -> None:
        if not self.has_display:
            raise LOST[0]("gone")
        self.sent.append((kind, button))


class Mouse(ModuleType):
    """The module pyautogui over a screen of 1024 x 768."""

    def __init__(self) -> None:
        super().__init__("pyautogui")
        self.FAILSAFE_POINTS = [(0, 0), (1023, 767)]
        self.PAUSE, self.FAILSAFE = 0.1, True
        self.at: tuple[float, float] = (500, 300)

    def size(self) -> tuple[int, int]:
        return 1024, 768

    def position(self) -> tuple[float, float]:
        return self.at

    def moveTo(self, x: float, y: float, *, _pause: bool) -> None:  # noqa: N802 - pyautogui's name
        assert not _pause
        self.at = x, y


def install_mouse(patch: pytest.MonkeyPatch) -> Mouse:
    """Make ``import pyautogui`` give this from here on."""
    mouse = Mouse()
    patch.setitem(sys.modules, "pyautogui", mouse)
    return mouse


class X11Error(Exception):
    """pynput's, for what an X server has refused."""


def install_pynput(patch: pytest.MonkeyPatch, buttons: Buttons | None = None) -> tuple[list[Listener], list[Listener]]:
    """Make ``import pynput`` give this from here on; return the started listeners of the keyboard and of the mouse."""

    class KeyListener(Listener):
        started: ClassVar[list[Listener]] = []

    class MoveListener(Listener):
        started: ClassVar[list[Listener]] = []

    keyboard: Any = SimpleNamespace(Key=Key, KeyCode=KeyCode, Listener=KeyListener, Controller=Controller)
    named = {name: name for name in ("left", "right", "middle")}
    mouse: Any = SimpleNamespace(Listener=MoveListener, Controller=lambda: buttons, Button=named)
    xorg: Any = SimpleNamespace(X11Error=X11Error)
    pynput: Any = SimpleNamespace(keyboard=keyboard, mouse=mouse)
    modules = {"pynput": pynput, "pynput.keyboard": keyboard, "pynput.mouse": mouse, "pynput._util.xorg": xorg}
    for name, module in modules.items():
        patch.setitem(sys.modules, name, module)
    return KeyListener.started, MoveListener.started


def reloaded(name: str, patch: pytest.MonkeyPatch) -> Any:
    """Return the module, loaded again over what ``import pynput`` gives; what was loaded comes back afterwards."""
    package, _, last = name.rpartition(".")
    patch.setattr(importlib.import_module(package), last, None, raising=False)
    patch.setitem(sys.modules, name, sys)
    del sys.modules[name]
    return importlib.import_module(name)
