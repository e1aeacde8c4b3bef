"""Starts a real window that notes what reaches it, and talks to it (window_server.py); on any system."""

import json
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from tests.live.desktop.real_windows.window_server import Event

GLFW_WINDOW = (sys.executable, str(Path(__file__).with_name("glfw_window.py")))
"""The window of the game from 1.13 to 26.2."""

TITLE = "Minecraft* 1.20.1 - Singleplayer"
PATIENCE_S = 10.0


class DrivenWindow:
    """The window, by its connection."""

    def __init__(self, connection: socket.socket) -> None:
        self._lines = connection.makefile("rwb")

    def ask(self, command: str, *arguments: object) -> Any:
        """Let the window do something; its answer."""
        self._lines.write(json.dumps([command, *arguments]).encode() + b"\n")
        self._lines.flush()
        return json.loads(self._lines.readline())

    def events_until(self, is_enough: Callable[[list[Event]], bool], patience_s: float = PATIENCE_S) -> list[Event]:
        """Return the events since they were last asked for, once there are enough; or all that came in that time."""
        came: list[Event] = []
        end = time.monotonic() + patience_s
        while True:
            came.extend(self.ask("events"))
            if is_enough(came) or time.monotonic() > end:
                return came
            time.sleep(0.005)

    def focus(self) -> None:
        """Bring the window to the front, and forget the events until then."""
        end = time.monotonic() + PATIENCE_S
        while not self.ask("state")["has focus"]:
            if time.monotonic() > end:
                raise TimeoutError("the window didn't get the focus")
            self.ask("focus")
            time.sleep(0.02)
        self.ask("events")


@contextmanager
def driven_window(program: Sequence[str] = GLFW_WINDOW, title: str = TITLE) -> Iterator[DrivenWindow]:
    """Yield the window of such a program, in a process of its own, in front."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        server.settimeout(60)
        process = subprocess.Popen([*program, str(server.getsockname()[1]), title])
        try:
            connection, _ = server.accept()
            with connection:
                connection.settimeout(60)
                window = DrivenWindow(connection)
                window.focus()
                yield window
                connection.shutdown(socket.SHUT_RDWR)
            process.wait(PATIENCE_S)
        finally:
            process.kill()
            process.wait()
