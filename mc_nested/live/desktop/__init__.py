"""The real devices: a window of this desktop, its screen, keyboard and mouse, the clock and the clipboard.

What differs between Windows, macOS and X11 is in a module for each. Importing this works without a display; opening
says in one line what is missing.
"""

import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Protocol, runtime_checkable

from mc_nested.live.desktop.clock import MonotonicClock
from mc_nested.live.desktop.display import Camera, WindowDisplay
from mc_nested.live.desktop.window import GameWindow
from mc_nested.live.devices import Clipboard, DesktopArea, Devices, Frame


@contextmanager
def open_desktop(title: str) -> Iterator[Devices]:
    """Yield the devices of the one window in whose title the regular expression ``title`` is found.

    Keys that are held when the context ends stay held: the input controller releases them.

    Raises:
        DesktopError: as ``DesktopSystem.open_window``, or a window that is partly off the screen.
    """
    system = this_system()
    with system.open_window(title) as window:
        # Without a display these imports fail, so the window comes first: it says what is missing.
        from mc_nested.live.desktop.camera import monitors
        from mc_nested.live.desktop.keyboard import open_keyboard
        from mc_nested.live.desktop.pointer import DesktopPointer

        with open_camera(window) as camera, open_keyboard() as keyboard:
            display = WindowDisplay(window, camera)
            pointer = DesktopPointer(window, display.ratio)
            clipboard = system.open_clipboard()
            yield Devices(display, keyboard, pointer, MonotonicClock(), clipboard, display.area, monitors)


class DesktopSystem(Protocol):
    """The functions that win32.py, quartz.py and x11.py each offer."""

    def open_window(self, title: str) -> AbstractContextManager[GameWindow]:
        """Return the one window whose title matches the regular expression ``title``, while the context lasts.

        Raises:
            DesktopError: no display, a Wayland session without Xwayland, a missing permission, no window of that title
                or several of them, or one that is minimised.
        """

    def session_kind(self) -> str:
        """Return what kind of session this is, in words.

        Raise DesktopError where its windows can't be pictured and driven: no display, a Wayland session without
        Xwayland, a missing permission.
        """

    def open_clipboard(self) -> Clipboard:
        """Return the clipboard, which is not read yet.

        Both its methods raise ClipboardError where the clipboard can't be reached, or holds something other than text,
        which could not be put back.
        """


def this_system() -> DesktopSystem:
    """Return the module of the system that this process runs on; without a display, this works too."""
    if sys.platform == "win32":
        from mc_nested.live.desktop import win32

        return win32
    if sys.platform == "darwin":
        from mc_nested.live.desktop import quartz

        return quartz
    from mc_nested.live.desktop import x11

    return x11


@runtime_checkable
class PicturesItself(Protocol):
    """A window whose picture is taken of itself, on a desktop whose screen can't be pictured."""

    def picture(self, area: DesktopArea) -> Frame: ...


@contextmanager
def open_camera(window: GameWindow) -> Iterator[Camera]:
    """Yield the camera for that window: its own, or one over all screens.

    Open the window first: mss needs a display.
    """
    if isinstance(window, PicturesItself):
        yield window.picture
        return
    from mc_nested.live.desktop import camera

    with camera.open_camera() as over_all_screens:
        yield over_all_screens
