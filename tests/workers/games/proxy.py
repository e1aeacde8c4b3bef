"""A proxy between a game and its scheduler, which cuts the game off."""

import socket
import threading
from contextlib import suppress


class Proxy:
    """Passes on what goes to a scheduler, until it is cut: then every socket that it has is closed."""

    def __init__(self, to: str) -> None:
        host, port = to.removeprefix("tcp://").rsplit(":", 1)
        self._to = host, int(port)
        self._listening = socket.create_server(("127.0.0.1", 0))
        self._open: list[socket.socket] = []
        threading.Thread(target=self._accept, daemon=True).start()

    @property
    def address(self) -> str:
        """The address at which it listens."""
        return f"tcp://127.0.0.1:{self._listening.getsockname()[1]}"

    def cut(self) -> None:
        """Close all connections; new ones are let through."""
        connections, self._open = self._open, []
        for each in connections:
            with suppress(OSError):
                each.shutdown(socket.SHUT_RDWR)
            each.close()

    def close(self) -> None:
        """Let nothing through any more."""
        self._listening.close()
        self.cut()

    def _accept(self) -> None:
        with suppress(OSError):
            while True:
                ours, _ = self._listening.accept()
                theirs = socket.create_connection(self._to)
                self._open += [ours, theirs]
                for ends in ((ours, theirs), (theirs, ours)):
                    threading.Thread(target=_pass_on, args=ends, daemon=True).start()


def _pass_on(heard: socket.socket, said: socket.socket) -> None:
    with suppress(OSError):
        while heard_of := heard.recv(65536):
            said.sendall(heard_of)
    for each in (heard, said):
        with suppress(OSError):
            each.shutdown(socket.SHUT_RDWR)
