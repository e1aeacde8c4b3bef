"""The game's window and the clipboard on macOS. Positions are points; a Retina screen has two pixels to a point."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from mc_nested.errors import ClipboardError, DesktopError
from mc_nested.live.desktop.window import TitledWindow, check_shown, closed_error, game_window
from mc_nested.live.devices import DesktopArea, not_text_error

if sys.platform == "darwin":
    import AppKit
    import HIServices
    import Quartz

assert sys.platform == "darwin"  # noqa: S101  mypy learns from it that the rest is for macOS alone

_ORDINARY_LAYER = 0
"""The layer of ordinary windows; menus, the dock and notes lie on others."""


@contextmanager
def open_window(title: str) -> Iterator["QuartzWindow"]:
    """Yield the one window whose title matches, as ``DesktopSystem.open_window``."""
    _check_permissions()
    windows = [each for each in _shown_windows() if each.get(Quartz.kCGWindowName)]
    titled = [
        TitledWindow(str(each[Quartz.kCGWindowName]), str(each.get(Quartz.kCGWindowOwnerName) or ""))
        for each in windows
    ]
    chosen = game_window(title, titled)
    window = QuartzWindow(int(windows[chosen][Quartz.kCGWindowNumber]), titled[chosen].title)
    window.client_area()
    yield window


def session_kind() -> str:
    """Return what this session is, in words; raise DesktopError where a permission is missing."""
    _check_permissions()
    return "a macOS desktop, Screen Recording and Accessibility allowed"


def open_clipboard() -> "QuartzClipboard":
    """Return the clipboard of macOS, its general pasteboard, not read yet."""
    return QuartzClipboard()


class QuartzWindow:
    """A window by its number."""

    def __init__(self, number: int, title: str) -> None:
        self._number = number
        self._title = title

    def title(self) -> str:
        self._title = str(self._described().get(Quartz.kCGWindowName) or self._title)
        return self._title

    def client_area(self) -> DesktopArea:
        bounds = self._described()[Quartz.kCGWindowBounds]
        left, top = round(bounds["X"]), round(bounds["Y"])
        width, height = round(bounds["Width"]), round(bounds["Height"])
        bar = 0 if _fills_a_screen(left, top, width, height) else _title_bar_height()
        area = DesktopArea(left, top + bar, width, height - bar)
        check_shown(area, self._title)
        return area

    def is_in_front(self) -> bool:
        front = next(iter(_shown_windows()), None)
        return front is not None and int(front[Quartz.kCGWindowNumber]) == self._number

    def _described(self) -> Any:
        found = [each for each in _shown_windows() if int(each[Quartz.kCGWindowNumber]) == self._number]
        if not found:
            raise closed_error(self._title)
        return found[0]


class QuartzClipboard:
    """The general pasteboard, which Cmd+V pastes from."""

    def read(self) -> str:
        board = AppKit.NSPasteboard.generalPasteboard()
        text = board.stringForType_(AppKit.NSPasteboardTypeString)
        if text is None and board.types():
            raise not_text_error()
        return str(text or "")

    def write(self, text: str) -> None:
        board = AppKit.NSPasteboard.generalPasteboard()
        board.clearContents()
        if text and not board.setString_forType_(text, AppKit.NSPasteboardTypeString):
            raise ClipboardError("the clipboard can't be written: close the program that holds it, and start again")


def _check_permissions() -> None:
    # Without these, macOS silently drops the keys and gives black pictures.
    remedy = "allow your terminal in System Settings, Privacy & Security"
    if not Quartz.CGPreflightScreenCaptureAccess():
        raise DesktopError(f"macOS doesn't let this program see the game: {remedy}, Screen Recording, and restart it")
    if not HIServices.AXIsProcessTrusted():
        raise DesktopError(f"macOS doesn't let this program press keys: {remedy}, Accessibility, and restart it")


def _shown_windows() -> list[Any]:
    """Return the ordinary windows on the screen, the front one first."""
    options = Quartz.kCGWindowListOptionOnScreenOnly | Quartz.kCGWindowListExcludeDesktopElements
    windows = Quartz.CGWindowListCopyWindowInfo(options, Quartz.kCGNullWindowID) or ()
    return [each for each in windows if int(each[Quartz.kCGWindowLayer]) == _ORDINARY_LAYER]


def _fills_a_screen(left: int, top: int, width: int, height: int) -> bool:
    _, displays, count = Quartz.CGGetActiveDisplayList(32, None, None)
    for display in displays[:count]:
        screen = Quartz.CGDisplayBounds(display)
        origin, size = screen.origin, screen.size
        if (round(origin.x), round(origin.y), round(size.width), round(size.height)) == (left, top, width, height):
            return True
    return False


def _title_bar_height() -> int:
    """Return the points that the title bar takes: to Quartz it is part of the window, and it differs by version."""
    inside = AppKit.NSMakeRect(0, 0, 100, 100)
    frame = AppKit.NSWindow.frameRectForContentRect_styleMask_(inside, AppKit.NSWindowStyleMaskTitled)
    return round(float(frame.size.height - inside.size.height))
