"""Keys and text on Windows, through user32's SendInput: keys by scancode, text as Unicode characters.

A scancode is what GLFW, and so the game, knows a key by. A Unicode character needs no key: neither the layout nor Caps
Lock nor a held Shift changes it.
"""

import ctypes
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import wintypes

from mc_nested.errors import DesktopError
from mc_nested.live.model.key_places import EXTENDED, KeyPlace

assert sys.platform == "win32"  # noqa: S101  mypy learns from it that the rest is for Windows alone

_INPUT_KEYBOARD = 1
_EXTENDED_KEY, _KEY_UP, _UNICODE, _SCANCODE = 1, 2, 4, 8
"""KEYEVENTF_EXTENDEDKEY, _KEYUP, _UNICODE and _SCANCODE (winuser.h)."""


class _MouseInput(ctypes.Structure):
    """MOUSEINPUT, never sent: the largest member of the union, which gives INPUT its size."""

    _fields_ = (
        ("dx", wintypes.LONG),
        ("dy", wintypes.LONG),
        ("mouseData", wintypes.DWORD),
        ("dwFlags", wintypes.DWORD),
        ("time", wintypes.DWORD),
        ("dwExtraInfo", ctypes.c_size_t),
    )


class _KeyInput(ctypes.Structure):
    """KEYBDINPUT."""

    _fields_ = (
        ("wVk", wintypes.WORD),
        ("wScan", wintypes.WORD),
        ("dwFlags", wintypes.DWORD),
        ("time", wintypes.DWORD),
        ("dwExtraInfo", ctypes.c_size_t),
    )


class _AnyInput(ctypes.Union):
    _fields_ = (("mouse", _MouseInput), ("key", _KeyInput))


class _Input(ctypes.Structure):
    """INPUT."""

    _fields_ = (("type", wintypes.DWORD), ("of", _AnyInput))


_send_input = ctypes.WinDLL("user32", use_last_error=True).SendInput
_send_input.argtypes = (wintypes.UINT, ctypes.POINTER(_Input), ctypes.c_int)
_send_input.restype = wintypes.UINT


class Win32KeySender:
    """Sends keys and characters as a keyboard's own."""

    def send(self, place: KeyPlace, *, is_down: bool) -> None:
        extended = _EXTENDED_KEY if place.scan & EXTENDED else 0
        _send((place.scan & 0xFF, _SCANCODE | extended | (0 if is_down else _KEY_UP)))

    def type(self, character: str) -> None:
        # All in one call, between whose events no other program's can come. A character beyond 0xFFFF is two units.
        data = character.encode("utf-16-le")
        units = [int.from_bytes(data[at : at + 2], "little") for at in range(0, len(data), 2)]
        _send(*((unit, flags) for unit in units for flags in (_UNICODE, _UNICODE | _KEY_UP)))


@contextmanager
def open_sender() -> Iterator[Win32KeySender]:
    """The keys of this desktop."""
    yield Win32KeySender()


def _send(*events: tuple[int, int]) -> None:
    """Send key events, each a scancode or a UTF-16 unit with its flags."""
    inputs = (_Input * len(events))(
        *(_Input(_INPUT_KEYBOARD, _AnyInput(key=_KeyInput(0, scan, flags, 0, 0))) for scan, flags in events)
    )
    if _send_input(len(events), inputs, ctypes.sizeof(_Input)) != len(events):
        raise DesktopError("Windows took no key: close the program that blocks the keyboard, and start again")
