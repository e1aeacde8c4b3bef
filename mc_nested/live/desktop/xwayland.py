"""Xwayland, the X server of a Wayland session, and pictures of one of its windows (FACTS: Input and windows).

Rootless, as desktops run it, each window is a window of the desktop and there is no screen to picture, so that a window
is pictured by itself. Rootful, it is an ordinary X server in one window.
"""

import os

import cv2
import numpy as np
from Xlib import X
from Xlib.display import Display
from Xlib.error import BadMatch, CatchError
from Xlib.ext import randr
from Xlib.xobject.drawable import Drawable, Window

from mc_nested.errors import DesktopError, NoWindowError
from mc_nested.live.devices import DesktopArea, Frame

ALL_PLANES = 0xFFFFFFFF

ALLOW = "where the desktop asks whether to allow remote interaction, allow it"
"""GNOME and KDE may ask at the first key that isn't pressed by hand (FACTS: Input and windows)."""

PANIC = "the panic key is heard only while that window is in front"
"""In one window, an X server keeps its focus when another window is in front, so the agent plays on."""

_AS_X11 = "env XDG_SESSION_TYPE=x11 SDL_VIDEO_DRIVER=x11"
"""Before a launcher's command, makes GLFW and SDL 3 open X11 windows (FACTS: Input and windows)."""


def is_xwayland(display: Display) -> bool:
    """Return whether the X server is an Xwayland, of either kind."""
    if display.query_extension("XWAYLAND") is not None:  # from 23.1 on
        return True
    if display.query_extension("RANDR") is None:
        return False
    root = display.screen().root
    screens = randr.get_screen_resources_current(root)
    names = (randr.get_output_info(root, each, screens.config_timestamp).name for each in screens.outputs)
    return any(name.startswith("XWAYLAND") for name in names)


def is_rootless(display: Display) -> bool:
    """Return whether the screen can't be pictured, only each window by itself: only a rootless Xwayland says so."""
    try:
        display.screen().root.get_image(0, 0, 1, 1, X.ZPixmap, ALL_PLANES)
    except BadMatch:
        return True
    return False


def is_wayland_session() -> bool:
    """Return whether this process's environment is that of a Wayland session."""
    return bool(os.environ.get("WAYLAND_DISPLAY")) or os.environ.get("XDG_SESSION_TYPE") == "wayland"


def no_x_server_error() -> DesktopError:
    """Return the error for a Wayland session in which there is no X server."""
    return DesktopError(
        "this Wayland session has no X server (DISPLAY is not set), and only X11 windows can be driven: install your "
        "distribution's xwayland, log in again, start the game, run this in a terminal of that session"
    )


def no_x11_window_error(error: NoWindowError) -> NoWindowError:
    """Return ``error`` with a hint that the missing window may be a Wayland one, which no X server knows."""
    return NoWindowError(
        f"{error}; a game that uses Wayland itself isn't seen: start its launcher with {_AS_X11} before the command"
    )


BAND_BYTES = 2_000_000
"""python-xlib's time for an answer grows with the square of its length: a longer picture comes in such bands."""

_BGRX = (24, 32)
"""The depths whose pixels are four bytes: blue, green, red and one more."""


class WindowCamera:
    """The Camera of one window, wherever that is and whatever covers it.

    A picture is one moment's, as the X server has it, also where it is fetched in bands. Raises (a picture): XError or
    ConnectionClosedError where the window or the server is gone, DesktopError where the window is smaller than the
    area, isn't shown, or has other colours than 8 bits each.
    """

    def __init__(self, display: Display, window: Window) -> None:
        self._root = display.screen().root
        self._window = window

    def __call__(self, area: DesktopArea) -> Frame:
        inside = self._inside(area)
        depth = self._checked_depth(inside)
        try:
            data = self._pixels(inside, depth)
        except BadMatch as error:
            raise _cannot_be_pictured() from error
        pixels = np.frombuffer(data, np.uint8).reshape(area.height, area.width, 4)
        return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGRA2BGR), np.uint8)

    def _inside(self, area: DesktopArea) -> DesktopArea:
        corner = self._root.translate_coords(self._window, 0, 0)
        return DesktopArea(area.left - corner.x, area.top - corner.y, area.width, area.height)

    def _checked_depth(self, inside: DesktopArea) -> int:
        found = self._window.get_geometry()
        if found.depth not in _BGRX:
            raise DesktopError(f"the game's window has colours of {found.depth} bits: set the desktop to 24 bits")
        right, bottom = inside.left + inside.width, inside.top + inside.height
        if min(inside.left, inside.top) < 0 or right > found.width or bottom > found.height:
            raise _cannot_be_pictured()
        return int(found.depth)

    def _pixels(self, inside: DesktopArea, depth: int) -> bytes:
        rows = max(1, BAND_BYTES // (4 * inside.width))
        if inside.height <= rows:
            return _image(self._window, inside)
        copy = self._root.create_pixmap(inside.width, inside.height, depth)
        context = copy.create_gc(subwindow_mode=X.IncludeInferiors, graphics_exposures=False)
        failed = CatchError()
        try:
            copy.copy_area(
                context, self._window, inside.left, inside.top, inside.width, inside.height, 0, 0, onerror=failed
            )
            bands = [
                _image(copy, DesktopArea(0, top, inside.width, min(rows, inside.height - top)))
                for top in range(0, inside.height, rows)
            ]
        finally:
            context.free()
            copy.free()
        if (error := failed.get_error()) is not None:
            raise error
        return b"".join(bands)


def _image(drawable: Drawable, part: DesktopArea) -> bytes:
    data = drawable.get_image(part.left, part.top, part.width, part.height, X.ZPixmap, ALL_PLANES).data
    return data if isinstance(data, bytes) else str(data).encode("latin-1")


def _cannot_be_pictured() -> DesktopError:
    return DesktopError("the game's window can't be pictured while it is hidden or resized: bring it back, leave it so")
