"""The game's window and the clipboard on Windows, through user32. Positions are physical pixels: it is DPI aware."""

import ctypes
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from ctypes import wintypes
from pathlib import PureWindowsPath

from mc_nested.errors import ClipboardError
from mc_nested.live.desktop.window import TitledWindow, check_shown, closed_error, game_window, minimised_error
from mc_nested.live.devices import DesktopArea, not_text_error

if sys.platform == "win32":
    import pyperclip

assert sys.platform == "win32"  # noqa: S101  mypy learns from it that the rest is for Windows alone

_PER_MONITOR_AWARE_V2 = -4
"""DPI_AWARENESS_CONTEXT_PER_MONITOR_AWARE_V2, a handle (windef.h)."""

_CLOAKED = 14
"""DWMWA_CLOAKED (dwmapi.h): the window of a suspended store app exists and counts as visible, but is never shown."""

_VIRTUAL_SCREEN = (76, 77, 78, 79)
"""SM_XVIRTUALSCREEN, SM_YVIRTUALSCREEN, SM_CXVIRTUALSCREEN and SM_CYVIRTUALSCREEN (winuser.h)."""

_QUERY_LIMITED = 0x1000
"""PROCESS_QUERY_LIMITED_INFORMATION (winnt.h): granted for other users' processes, too."""

_LONGEST_NAME = 1024
"""Characters of a class's name or a program's path that are looked at."""

_kernel32 = ctypes.WinDLL("kernel32", use_last_error=True)
_kernel32.OpenProcess.restype = wintypes.HANDLE
_user32 = ctypes.WinDLL("user32", use_last_error=True)
_user32.GetForegroundWindow.restype = wintypes.HWND
_EnumWindowsCallback = ctypes.WINFUNCTYPE(wintypes.BOOL, wintypes.HWND, wintypes.LPARAM)


@contextmanager
def open_window(title: str) -> Iterator["Win32Window"]:
    """Yield the one window whose title matches, as ``DesktopSystem.open_window``."""
    # Fails harmlessly where the process has chosen its awareness already; pyautogui would choose a weaker one.
    _user32.SetProcessDpiAwarenessContext(ctypes.c_void_p(_PER_MONITOR_AWARE_V2))
    windows = titled_windows()
    handle, described = windows[game_window(title, [described for _, described in windows])]
    window = Win32Window(handle, described.title)
    window.client_area()
    yield window


def titled_windows() -> list[tuple[int, TitledWindow]]:
    """Return the handle of each window that is shown and has a title, and what is known of it."""
    windows = [(handle, TitledWindow(_title_of(handle), _program_of(handle))) for handle in _shown_windows()]
    return [(handle, described) for handle, described in windows if described.title]


def virtual_screen() -> DesktopArea:
    """Return the area of all monitors together, as it is now."""
    left, top, width, height = (int(_user32.GetSystemMetrics(each)) for each in _VIRTUAL_SCREEN)
    return DesktopArea(left, top, width, height)


def session_kind() -> str:
    """Return what this session is, in words. Windows of a Windows desktop can always be pictured and driven."""
    return "a Windows desktop"


def open_clipboard() -> "Win32Clipboard":
    """Return the clipboard of Windows, not read yet."""
    return Win32Clipboard()


class Win32Window:
    """A window by its handle."""

    def __init__(self, handle: int, title: str) -> None:
        self._handle = handle
        self._title = title

    def title(self) -> str:
        self._title = _title_of(self._handle) or self._title
        return self._title

    def client_area(self) -> DesktopArea:
        handle = wintypes.HWND(self._handle)
        if not _user32.IsWindow(handle):
            raise closed_error(self._title)
        if _user32.IsIconic(handle) or not _user32.IsWindowVisible(handle):
            raise minimised_error(self._title)
        inside, corner = wintypes.RECT(), wintypes.POINT(0, 0)
        if not _user32.GetClientRect(handle, ctypes.byref(inside)):
            raise closed_error(self._title)
        _user32.ClientToScreen(handle, ctypes.byref(corner))
        area = DesktopArea(corner.x, corner.y, inside.right, inside.bottom)
        check_shown(area, self._title)
        return area

    def is_in_front(self) -> bool:
        front: int | None = _user32.GetForegroundWindow()
        return front == self._handle


class Win32Clipboard:
    """The text that Ctrl+V pastes, through pyperclip, which waits while another program has the clipboard open."""

    def read(self) -> str:
        try:
            text = str(pyperclip.paste())
        except pyperclip.PyperclipException as error:
            raise _unreachable(error) from error
        if not text and _user32.CountClipboardFormats():
            raise not_text_error()
        return text

    def write(self, text: str) -> None:
        try:
            pyperclip.copy(text)
        except pyperclip.PyperclipException as error:
            raise _unreachable(error) from error


def _unreachable(error: Exception) -> ClipboardError:
    return ClipboardError(f"the clipboard can't be reached ({error}): close the program that holds it, and start again")


def _shown_windows() -> list[int]:
    handles: list[int] = []

    def collect(handle: int, _: int) -> bool:
        if _user32.IsWindowVisible(wintypes.HWND(handle)) and not _is_cloaked(handle):
            handles.append(handle)
        return True

    _user32.EnumWindows(_EnumWindowsCallback(collect), 0)
    return handles


def _is_cloaked(handle: int) -> bool:
    cloaked = wintypes.DWORD(0)
    ctypes.WinDLL("dwmapi").DwmGetWindowAttribute(
        wintypes.HWND(handle), _CLOAKED, ctypes.byref(cloaked), ctypes.sizeof(cloaked)
    )
    return cloaked.value != 0


def _program_of(handle: int) -> str:
    """Return the file name of the window's process and the window's class; what can't be asked is left out."""
    name = ctypes.create_unicode_buffer(_LONGEST_NAME)
    _user32.GetClassNameW(wintypes.HWND(handle), name, _LONGEST_NAME)
    return f"{_process_of(handle)} {name.value}".strip()


def _process_of(handle: int) -> str:
    number = wintypes.DWORD(0)
    _user32.GetWindowThreadProcessId(wintypes.HWND(handle), ctypes.byref(number))
    process: int | None = _kernel32.OpenProcess(_QUERY_LIMITED, False, number)
    if not process:
        return ""
    try:
        path, length = ctypes.create_unicode_buffer(_LONGEST_NAME), wintypes.DWORD(_LONGEST_NAME)
        known = _kernel32.QueryFullProcessImageNameW(wintypes.HANDLE(process), 0, path, ctypes.byref(length))
        return PureWindowsPath(path.value).name if known else ""
    finally:
        _kernel32.CloseHandle(wintypes.HANDLE(process))


def _title_of(handle: int) -> str:
    length: int = _user32.GetWindowTextLengthW(wintypes.HWND(handle))
    text = ctypes.create_unicode_buffer(length + 1)
    _user32.GetWindowTextW(wintypes.HWND(handle), text, length + 1)
    return text.value
