"""Xwayland, the X server of a Wayland session (FACTS: Input and windows).

Rootless, as desktops run it, each window is a window of the desktop and there is no screen to picture. Rootful, it is
an ordinary X server in one window.
"""

import os

from Xlib import X
from Xlib.display import Display
from Xlib.error import BadMatch
from Xlib.ext import randr

from mc_nested.errors import DesktopError, NoWindowError

ALL_PLANES = 0xFFFFFFFF

ALLOW = "where the desktop asks whether to allow remote interaction, allow it"
"""GNOME and KDE may ask at the first key that isn't pressed by hand (FACTS: Input and windows)."""

PANIC = "the panic key is heard only while that window is in front"
"""In one window, an X server keeps its focus when another window is in front, so the agent plays on."""

_AS_X11 = "env XDG_SESSION_TYPE=x11 SDL_VIDEO_DRIVER=x11"
"""Before a launcher's command, makes GLFW and SDL 3 open X11 windows (FACTS: Input and windows)."""


def is_xwayland(display: Display) -> bool:
    """Whether the X server is an Xwayland, of either kind."""
    if display.query_extension("XWAYLAND") is not None:  # from 23.1 on
        return True
    if display.query_extension("RANDR") is None:
        return False
    root = display.screen().root
    screens = randr.get_screen_resources_current(root)
    names = (randr.get_output_info(root, each, screens.config_timestamp).name for each in screens.outputs)
    return any(name.startswith("XWAYLAND") for name in names)


def is_rootless(display: Display) -> bool:
    """Whether the screen can't be pictured, only each window by itself: only a rootless Xwayland says so."""
    try:
        display.screen().root.get_image(0, 0, 1, 1, X.ZPixmap, ALL_PLANES)
    except BadMatch:
        return True
    return False


def is_wayland_session() -> bool:
    """Whether this process's environment is that of a Wayland session."""
    return bool(os.environ.get("WAYLAND_DISPLAY")) or os.environ.get("XDG_SESSION_TYPE") == "wayland"


def no_x_server_error() -> DesktopError:
    """The error for a Wayland session in which there is no X server."""
    return DesktopError(
        "this Wayland session has no X server (DISPLAY is not set), and only X11 windows can be driven: install your "
        "distribution's xwayland, log in again, start the game, run this in a terminal of that session"
    )


def no_x11_window_error(error: NoWindowError) -> NoWindowError:
    """``error``, where the missing window may be a Wayland one, which no X server knows."""
    return NoWindowError(
        f"{error}; a game that uses Wayland itself isn't seen: start its launcher with {_AS_X11} before the command"
    )
