"""A Windows window that notes the virtual keys that reach it, as LWJGL 2 sees them. For a Windows Python.

usage: virtual_key_window.py PORT TITLE, as window_server.py has it. A key is the number of its virtual key, left and
right told apart, as LWJGL 2 does (its WindowsDisplay).
"""

import ctypes
import sys
import time
from ctypes import wintypes
from pathlib import Path
from typing import TYPE_CHECKING, Any

sys.path.insert(0, str(Path(__file__).parents[2]))  # a Windows Python that was only unpacked knows no PYTHONPATH

from tests.live.desktop.real_windows.window_server import Event, serve

if TYPE_CHECKING:
    from collections.abc import Callable

assert sys.platform == "win32"

SIZE = (320, 240)
LOOK_S = 0.004
_SHOWN, _TAKES_ALL = 0x10CF0000, 1
"""WS_VISIBLE and WS_OVERLAPPEDWINDOW; PM_REMOVE."""
_SET_FOCUS, _LOSES_FOCUS, _CHARACTER = 0x07, 0x08, 0x102
_KEYS = {0x100: 1, 0x101: 0, 0x104: 1, 0x105: 0}
"""WM_KEYDOWN, _KEYUP, WM_SYSKEYDOWN, _SYSKEYUP: down or up."""
_TO_VIRTUAL_KEY = 3
_SIDED = (0x10, 0x11, 0x12)
"""VK_SHIFT, _CONTROL, _MENU."""

_Procedure = ctypes.WINFUNCTYPE(ctypes.c_ssize_t, wintypes.HWND, wintypes.UINT, wintypes.WPARAM, wintypes.LPARAM)


class _WindowClass(ctypes.Structure):
    """WNDCLASSW."""

    _fields_ = (
        ("style", wintypes.UINT),
        ("procedure", _Procedure),
        ("extra", ctypes.c_int * 2),
        ("instance", wintypes.HINSTANCE),
        ("icon", wintypes.HANDLE),
        ("cursor", wintypes.HANDLE),
        ("background", wintypes.HANDLE),
        ("menu", wintypes.LPCWSTR),
        ("name", wintypes.LPCWSTR),
    )


_user32 = ctypes.WinDLL("user32")
_user32.DefWindowProcW.argtypes = (wintypes.HWND, wintypes.UINT, wintypes.WPARAM, wintypes.LPARAM)
_user32.DefWindowProcW.restype = ctypes.c_ssize_t
_user32.CreateWindowExW.argtypes = (
    *(wintypes.DWORD, wintypes.LPCWSTR, wintypes.LPCWSTR, wintypes.DWORD, *[ctypes.c_int] * 4),
    *(wintypes.HWND, wintypes.HMENU, wintypes.HINSTANCE, wintypes.LPVOID),
)
_user32.CreateWindowExW.restype = wintypes.HWND
_user32.GetForegroundWindow.restype = wintypes.HWND
_user32.SetForegroundWindow.argtypes = (wintypes.HWND,)


class VirtualKeyWindow:
    """The window, and its events since they were last asked for."""

    def __init__(self, title: str) -> None:
        self._events: list[Event] = []
        self._class = _WindowClass(procedure=_Procedure(self._on_message), name="keys")
        _user32.RegisterClassW(ctypes.byref(self._class))
        self._window = _user32.CreateWindowExW(0, "keys", title, _SHOWN, 60, 40, *SIZE, None, None, None, None)
        if not self._window:
            raise SystemExit("Windows opens no window")
        self.commands: dict[str, Callable[..., Any]] = {
            "events": self._taken_events,
            "focus": lambda: _user32.SetForegroundWindow(self._window),
            "take text": lambda: None,
            "state": lambda: {"has focus": _user32.GetForegroundWindow() == self._window},
        }

    def step(self) -> None:
        """Take the messages that have come."""
        message = wintypes.MSG()
        while _user32.PeekMessageW(ctypes.byref(message), None, 0, 0, _TAKES_ALL):
            _user32.TranslateMessage(ctypes.byref(message))
            _user32.DispatchMessageW(ctypes.byref(message))
        time.sleep(LOOK_S)

    def _taken_events(self) -> list[Event]:
        self.step()
        taken = list(self._events)
        self._events.clear()
        return taken

    def _on_message(self, window: int, kind: int, of: int, more: int) -> int:
        if kind in _KEYS:
            scan = more >> 16 & 0xFF | (0xE000 if more >> 24 & 1 else 0)
            key = _user32.MapVirtualKeyW(scan, _TO_VIRTUAL_KEY) if of in _SIDED else of
            again = _KEYS[kind] and more >> 30 & 1
            self._events.append(["key", key, scan, 2 if again else _KEYS[kind]])
        elif kind == _CHARACTER:
            self._events.append(["char", of])
        elif kind in (_SET_FOCUS, _LOSES_FOCUS):
            self._events.append(["focus", int(kind == _SET_FOCUS)])
        return int(_user32.DefWindowProcW(window, kind, of, more))


def main(port: int, title: str) -> None:
    serve(VirtualKeyWindow(title), port)


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
