"""Windows, macOS or X11: what differs between the systems, one module for each."""

import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Protocol, runtime_checkable

from mc_nested.live.desktop.display import Camera
from mc_nested.live.desktop.window import GameWindow
from mc_nested.live.devices import Clipboard, DesktopArea, Frame


class DesktopSystem(Protocol):
    """The functions that win32.py, quartz.py and x11.py each offer."""

    def open_window(self, title: str) -> AbstractContextManager[GameWindow]:
        """Return the one window whose title matches the regular expression ``title``, while the context lasts.

        Raises:
            DesktopError: no display, a session that can't be driven, a missing permission, no window of that title or
                several of them, or one that is minimised.
        """

    def session_kind(self) -> str:
        """Return what kind of session this is, in words.

        Raise DesktopError where its windows can't be pictured and driven.
        """

    def open_clipboard(self) -> Clipboard:
        """Return the clipboard, which is not read yet.

        Both its methods raise ClipboardError where the clipboard can't be reached, or holds something other than text,
        which could not be put back.
        """


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
