"""A real GLFW window on X11, four coloured quarters, which prints what reaches it and does what it is told.

usage: xwayland_window.py TITLE. GLFW is what the game's own window is made with. Each event is one JSON list on a line
of the output: "key", key, action; "char", character; "button", button, action; "cursor", x, y; or "focus", 0 or 1. Each
line of the input is a JSON list, a command and its arguments, answered by "done" and what came of it.
"""

import json
import os
import sys
from typing import TYPE_CHECKING, Any

import glfw
import moderngl

if TYPE_CHECKING:
    from collections.abc import Callable

SIZE = (640, 400)
COLOURS = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 1.0, 0.0))
"""Of the upper left quarter, the upper right one, the lower left and the lower right one."""

LOOK_S = 0.01
ANY: Any = None
"""GLFW warns of a window that is named to the clipboard."""


def paste() -> str:
    text: Any = glfw.get_clipboard_string(ANY)  # bytes, whatever its stub says
    return str(text, "utf-8")


def say(*words: object) -> None:
    print(json.dumps(words), flush=True)


class Window:
    """The window and what it can be told."""

    def __init__(self, title: str) -> None:
        glfw.init_hint(glfw.PLATFORM, glfw.PLATFORM_X11)
        if not glfw.init():
            raise SystemExit("GLFW finds no X server")
        self.window = glfw.create_window(*SIZE, title, None, None)
        if not self.window:
            raise SystemExit("GLFW opens no window: is there OpenGL?")
        glfw.make_context_current(self.window)
        glfw.swap_interval(0)
        self.context = moderngl.create_context()
        glfw.set_key_callback(self.window, lambda _, key, __, action, ___: say("key", key, action))
        glfw.set_char_callback(self.window, lambda _, number: say("char", chr(number)))
        glfw.set_mouse_button_callback(self.window, lambda _, button, action, __: say("button", button, action))
        glfw.set_cursor_pos_callback(self.window, lambda _, x, y: say("cursor", x, y))
        glfw.set_window_focus_callback(self.window, lambda _, has_it: say("focus", has_it))
        self.commands: dict[str, Callable[..., object]] = {
            "hold the cursor": lambda: glfw.set_input_mode(self.window, glfw.CURSOR, glfw.CURSOR_DISABLED),
            "free the cursor": lambda: glfw.set_input_mode(self.window, glfw.CURSOR, glfw.CURSOR_NORMAL),
            "copy": lambda text: glfw.set_clipboard_string(ANY, text),
            "paste": paste,
            "place": lambda x, y: glfw.set_window_pos(self.window, x, y),
            "resize": self.resize,
            "minimise": lambda: glfw.iconify_window(self.window),
            "hide": lambda: glfw.hide_window(self.window),
        }

    def resize(self, width: int, height: int) -> None:
        """Take that size, and draw at it."""
        glfw.set_window_size(self.window, width, height)
        while tuple(glfw.get_framebuffer_size(self.window)) != (width, height):
            glfw.wait_events_timeout(LOOK_S)
        for _ in range(3):  # more than one buffer may wait
            self.draw()
        self.context.finish()

    def draw(self) -> None:
        width, height = glfw.get_framebuffer_size(self.window)
        for index, colour in enumerate(COLOURS):
            left, bottom = (index % 2) * width // 2, (1 - index // 2) * height // 2
            quarter = left, bottom, width - width // 2, height - height // 2
            self.context.screen.clear(*colour, viewport=quarter)
        glfw.swap_buffers(self.window)


def main(title: str) -> None:
    window = Window(title)
    for _ in range(3):
        window.draw()
    say("ready")
    os.set_blocking(sys.stdin.fileno(), False)
    waiting = b""
    while not glfw.window_should_close(window.window):
        window.draw()
        glfw.wait_events_timeout(LOOK_S)
        try:
            came: Any = os.read(sys.stdin.fileno(), 65536)
        except BlockingIOError:
            continue
        if not came:
            break
        *lines, waiting = (waiting + came).split(b"\n")
        for line in lines:
            command, *arguments = json.loads(line)
            say("done", window.commands[command](*arguments))
    glfw.terminate()


if __name__ == "__main__":
    main(sys.argv[1])
