"""Tell a real window of the tests what to do, over a local socket: a JSON list a line, answered with a JSON line.

A list is a command and its arguments. Every such program takes the port and the window's title as its last arguments,
and ends when the connection does.
"""

import json
import socket
from collections.abc import Callable
from typing import Any, Protocol

Event = list[Any]
"""What reached a window: "key", the key, its number, 1 down, 2 again or 0 up; "char", its number; "button", the button,
1 or 0; "cursor", x, y; or "focus", 1 or 0. Keys and buttons are named as the window's library has them."""


class ToldWindow(Protocol):
    """A window that notes what reaches it, and what it can be told by name."""

    commands: dict[str, Callable[..., Any]]

    def step(self) -> None:
        """Draw, and take the events that have come."""


def serve(window: ToldWindow, port: int) -> None:
    """Do what 127.0.0.1:PORT asks for, until the connection ends."""
    with socket.create_connection(("127.0.0.1", port)) as connection:
        connection.setblocking(False)
        waiting = b""
        while True:
            window.step()
            try:
                came = connection.recv(65536)
            except BlockingIOError:
                continue
            if not came:
                return
            *lines, waiting = (waiting + came).split(b"\n")
            for line in lines:
                command, *arguments = json.loads(line)
                answer = window.commands[command](*arguments)
                connection.setblocking(True)
                connection.sendall(json.dumps(answer).encode() + b"\n")
                connection.setblocking(False)
