"""The real devices: a window of this desktop, its screen, keyboard and mouse, the clock and the clipboard.

Importing this works without a display; opening says in one line what is missing.
"""

import sys
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass

from mc_nested.live.desktop.clipboard import open_clipboard
from mc_nested.live.desktop.clock import MonotonicClock
from mc_nested.live.desktop.screen import WindowDisplay
from mc_nested.live.desktop.window import GameWindow
from mc_nested.live.devices import Clipboard, Clock, Display, Keyboard, Pointer


@dataclass(frozen=True)
class Desktop:
    """The devices of one game window.

    ``points`` gives the client area's width and height in points of the desktop; None where nobody knows them.
    """

    display: Display
    keyboard: Keyboard
    pointer: Pointer
    clock: Clock
    clipboard: Clipboard
    points: Callable[[], tuple[int, int]] | None = None


@contextmanager
def open_desktop(title: str) -> Iterator[Desktop]:
    """The devices of the one window in whose title the regular expression ``title`` is found.

    Keys held when the context ends are not released here: ``hands`` owns them.

    Raises:
        DesktopError: no display, a Wayland session, a missing permission, no window of that title or several of
            them, or one that is minimised or partly off the screen.
    """
    with _open_window(title) as window:
        # These fail at import without a display, so the window, which says what is missing, comes first.
        from mc_nested.live.desktop.camera import open_camera
        from mc_nested.live.desktop.keyboard import DesktopKeyboard
        from mc_nested.live.desktop.pointer import DesktopPointer

        with open_camera() as camera:
            display = WindowDisplay(window, camera)
            pointer = DesktopPointer(window, display.ratio)
            points = display.points
            yield Desktop(display, DesktopKeyboard(), pointer, MonotonicClock(), open_clipboard(), points)


def session_kind() -> str:
    """What kind of session this is, in words.

    DesktopError where no window of it can be pictured and driven: no display, Wayland, a missing permission.
    """
    if sys.platform == "win32":
        from mc_nested.live.desktop import win32

        return win32.session_kind()
    if sys.platform == "darwin":
        from mc_nested.live.desktop import quartz

        return quartz.session_kind()
    from mc_nested.live.desktop import x11

    return x11.session_kind()


def _open_window(title: str) -> AbstractContextManager[GameWindow]:
    if sys.platform == "win32":
        from mc_nested.live.desktop import win32

        return win32.open_window(title)
    if sys.platform == "darwin":
        from mc_nested.live.desktop import quartz

        return quartz.open_window(title)
    from mc_nested.live.desktop import x11

    return x11.open_window(title)
