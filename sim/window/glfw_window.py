"""A window of GLFW with an OpenGL context, and the desktop around it: its clipboard, its monitor, its time."""

import os
import re
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from mc_nested.errors import DesktopError

if sys.platform.startswith("linux"):
    # Windows of X11 can be pictured and driven by other programs, those of Wayland can't.
    os.environ.setdefault("PYGLFW_LIBRARY_VARIANT", "x11")

import glfw

OPENGL = (3, 3)

SPIN_S = 0.002 if sys.platform == "win32" else 0.0005
"""The last seconds of a wait, in which events are polled all the time: a wait may last that much too long."""

USUAL_RATE = 60.0
"""Frames a second on a monitor that doesn't say its rate, as a virtual one."""


class GlfwWindow:
    """An open window. ``handle`` is GLFW's, for its own functions."""

    def __init__(self, handle: Any) -> None:
        self.handle = handle
        self.is_stale = True
        """Whether the desktop has lost what was shown."""
        glfw.set_window_refresh_callback(handle, lambda _: self._lose_picture())

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in framebuffer pixels; 0 while it is minimised on some systems."""
        width, height = glfw.get_framebuffer_size(self.handle)
        return width, height

    @property
    def pixels_a_point(self) -> float:
        """Framebuffer pixels to a point of the desktop, in which the cursor's position is given."""
        points = glfw.get_window_size(self.handle)[0]
        return self.size[0] / points if points else 1.0

    @property
    def is_closing(self) -> bool:
        """Whether somebody has asked it to close."""
        return bool(glfw.window_should_close(self.handle))

    def resize(self, size: tuple[int, int]) -> None:
        """Ask for another size, in framebuffer pixels; one that the main screen has no room for is left out."""
        ratio = self.pixels_a_point
        width, height = round(size[0] / ratio), round(size[1] / ratio)
        _, _, across, high = glfw.get_monitor_workarea(glfw.get_primary_monitor())
        if width <= across and height <= high:
            glfw.set_window_size(self.handle, width, height)
            self.shift_window(0, 0)

    def shift_window(self, right: int, down: int) -> None:
        """Move it by some points of the desktop, but not off the main screen."""
        (x, y), (width, height) = glfw.get_window_pos(self.handle), glfw.get_window_size(self.handle)
        left, top, across, high = glfw.get_monitor_workarea(glfw.get_primary_monitor())
        furthest = max(left, left + across - width), max(top, top + high - height)
        glfw.set_window_pos(self.handle, min(max(left, x + right), furthest[0]), min(max(top, y + down), furthest[1]))

    def set_front(self, *, is_in_front: bool) -> None:
        """Minimise it, or bring it back to the front."""
        if is_in_front:
            glfw.restore_window(self.handle)
            glfw.focus_window(self.handle)
        else:
            glfw.iconify_window(self.handle)

    def set_title(self, title: str) -> None:
        glfw.set_window_title(self.handle, title)

    def wait_until(self, at: float) -> None:
        """Take events as they come, until the time ``at`` of ``now``; at least once."""
        glfw.poll_events()
        while (left := at - now()) > 0:
            if left > SPIN_S:
                glfw.wait_events_timeout(left - SPIN_S)
            else:
                glfw.poll_events()

    def show(self) -> None:
        """Show what was drawn."""
        glfw.swap_buffers(self.handle)
        self.is_stale = False

    def _lose_picture(self) -> None:
        self.is_stale = True

    # The desktop's clipboard.

    def read(self) -> str:
        """Return the clipboard's text; empty where it holds none."""
        try:
            text: Any = glfw.get_clipboard_string(self.handle) or b""  # bytes, whatever its type says
            return str(text, "utf-8", "replace")
        except glfw.GLFWError:
            return ""

    def write(self, text: str) -> None:
        """Put a text on the clipboard."""
        glfw.set_clipboard_string(self.handle, text)


def now() -> float:
    """Return the real time in seconds, on a scale that never goes back."""
    return time.perf_counter()


def refresh_rate() -> float:
    """Return the main monitor's frames a second."""
    monitor = glfw.get_primary_monitor()
    mode = glfw.get_video_mode(monitor) if monitor else None
    return float(mode.refresh_rate) if mode and mode.refresh_rate else USUAL_RATE


@contextmanager
def open_glfw_window(title: str, size: tuple[int, int]) -> Iterator[GlfwWindow]:
    """Open a window with an OpenGL context, current in this thread; it is closed after the block.

    Frames are shown at once: whoever draws decides when. DesktopError without a display, or without OpenGL 3.3.
    """
    before, glfw.ERROR_REPORTING = glfw.ERROR_REPORTING, "exception"
    try:
        try:
            if sys.platform.startswith("linux") and hasattr(glfw, "PLATFORM"):
                glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_X11)
            glfw.init()
        except glfw.GLFWError as error:
            raise DesktopError(
                f"no window can be opened ({_words(error)}): run this in a desktop session, on Wayland with Xwayland"
            ) from error
        try:
            yield GlfwWindow(_created(title, size))
        finally:
            glfw.terminate()
    finally:
        glfw.ERROR_REPORTING = before


def _created(title: str, size: tuple[int, int]) -> Any:
    glfw.window_hint(glfw.CONTEXT_VERSION_MAJOR, OPENGL[0])
    glfw.window_hint(glfw.CONTEXT_VERSION_MINOR, OPENGL[1])
    glfw.window_hint(glfw.OPENGL_PROFILE, glfw.OPENGL_CORE_PROFILE)
    glfw.window_hint(glfw.OPENGL_FORWARD_COMPAT, True)
    try:
        handle: Any = glfw.create_window(*size, title, None, None)
        glfw.make_context_current(handle)
        glfw.swap_interval(0)
    except glfw.GLFWError as error:
        raise DesktopError(
            f"this display offers no OpenGL 3.3 ({_words(error)}): update the graphics driver, or install Mesa's"
        ) from error
    return handle


def _words(error: Exception) -> str:
    """Return GLFW's own words, which come as bytes behind a number."""
    return re.sub(r"^\(\d+\) b?['\"](.*)['\"]$", r"\1", str(error))
