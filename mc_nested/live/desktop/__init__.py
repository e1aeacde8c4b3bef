"""The real devices: a window of this desktop, its screen, keyboard and mouse, the clock and the clipboard.

Importing this works without a display; opening says in one line what is missing.
"""

from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.live.desktop.clock import MonotonicClock
from mc_nested.live.desktop.display import WindowDisplay
from mc_nested.live.desktop.system import open_camera, this_system
from mc_nested.live.devices import Clipboard, Devices


@contextmanager
def open_desktop(title: str) -> Iterator[Devices]:
    """Yield the devices of the one window in whose title the regular expression ``title`` is found.

    Keys that are held when the context ends stay held: the input controller releases them.

    Raises:
        DesktopError: no display, a Wayland session without Xwayland, a missing permission, no window of that title or
            several of them, or one that is minimised or partly off the screen.
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


def open_clipboard() -> Clipboard:
    """Return this desktop's clipboard, which is not read yet."""
    return this_system().open_clipboard()


def session_kind() -> str:
    """Return what kind of session this is, in words.

    Raise DesktopError where its windows can't be pictured and driven: no display, a Wayland session without Xwayland, a
    missing permission.
    """
    return this_system().session_kind()
