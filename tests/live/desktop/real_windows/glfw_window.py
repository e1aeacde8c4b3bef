"""A real GLFW window, made as the game's own is, that notes what reaches it and does what it is told.

usage: glfw_window.py PORT TITLE, as window_server.py has it. It runs wherever GLFW does, under Wine too.
"""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import glfw
import moderngl

sys.path.insert(0, str(Path(__file__).parents[4]))  # a Windows Python that was only unpacked knows no PYTHONPATH

from tests.live.desktop.real_windows.window_server import Event, serve

if TYPE_CHECKING:
    from collections.abc import Callable

SIZE = (320, 240)
LEFT, TOP = 60, 40
RED, BLUE = (1.0, 0.125, 0.0625), (0.0625, 0.125, 1.0)
LOOK_S = 0.004
"""Seconds between two looks at the connection, and at the window's events."""


class LoggingWindow:
    """The window, red on its left half and blue on its right one, and its events since they were last asked for.

    An event is a list: "key", key, scancode, action; "char", its number; "button", button, action; "cursor", x, y; or
    "focus", 0 or 1. Numbers are GLFW's.
    """

    def __init__(self, title: str) -> None:
        if not glfw.init():
            raise SystemExit("GLFW finds no display")
        glfw.window_hint(glfw.RESIZABLE, glfw.FALSE)
        self._window = glfw.create_window(*SIZE, title, None, None)
        if not self._window:
            raise SystemExit("GLFW opens no window: is there OpenGL?")
        glfw.set_window_pos(self._window, LEFT, TOP)
        glfw.make_context_current(self._window)
        self._context = moderngl.create_context()
        self._events: list[Event] = []
        note = self._events.append
        glfw.set_key_callback(self._window, lambda _, key, code, action, __: note(["key", key, code, action]))
        glfw.set_char_callback(self._window, lambda _, number: note(["char", number]))
        glfw.set_mouse_button_callback(self._window, lambda _, button, action, __: note(["button", button, action]))
        glfw.set_cursor_pos_callback(self._window, lambda _, x, y: note(["cursor", x, y]))
        glfw.set_window_focus_callback(self._window, lambda _, has_it: note(["focus", has_it]))
        self.commands: dict[str, Callable[..., Any]] = {
            "events": self._taken_events,
            "take text": lambda: None,
            "focus": lambda: glfw.focus_window(self._window),
            "grab cursor": self._grab_cursor,
            "free cursor": lambda: glfw.set_input_mode(self._window, glfw.CURSOR, glfw.CURSOR_NORMAL),
            "move": lambda x, y: glfw.set_window_pos(self._window, x, y),
            "state": self._state,
        }

    def step(self) -> None:
        """Draw, and take the events that have come."""
        (width, height), screen = glfw.get_framebuffer_size(self._window), self._context.screen
        screen.clear(*RED, viewport=(0, 0, width // 2, height))
        screen.clear(*BLUE, viewport=(width // 2, 0, width - width // 2, height))
        glfw.swap_buffers(self._window)
        glfw.wait_events_timeout(LOOK_S)

    def _taken_events(self) -> list[Event]:
        """Return those of all input until now: an X server answers a question behind the events that it sent before."""
        glfw.get_window_pos(self._window)  # such a question
        glfw.poll_events()
        taken = list(self._events)
        self._events.clear()
        return taken

    def _grab_cursor(self) -> bool:
        """Hold the mouse as the game does in its world; return whether there is raw motion, which is used then."""
        has_raw = bool(glfw.raw_mouse_motion_supported())
        glfw.set_input_mode(self._window, glfw.CURSOR, glfw.CURSOR_DISABLED)
        if has_raw:
            glfw.set_input_mode(self._window, glfw.RAW_MOUSE_MOTION, glfw.TRUE)
        return has_raw

    def _state(self) -> dict[str, Any]:
        return {
            "position": glfw.get_window_pos(self._window),
            "size": glfw.get_framebuffer_size(self._window),
            "has focus": bool(glfw.get_window_attrib(self._window, glfw.FOCUSED)),
            "is shown": bool(glfw.get_window_attrib(self._window, glfw.VISIBLE)),
        }


def main(port: int, title: str) -> None:
    serve(LoggingWindow(title), port)
    glfw.terminate()


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2])
