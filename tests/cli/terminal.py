"""A program in a pseudo-terminal: the text that it shows, and keys for it."""

import fcntl
import os
import pty
import re
import select
import struct
import subprocess
import sys
import termios
import time
from collections.abc import Sequence
from pathlib import Path

PATIENCE_S = 60.0
ESCAPES = re.compile(rb"\x1b(\[[0-9;?<>=]*[A-Za-z]|[()][A-Z0-9]|[=>]|\][^\x07]*\x07)")


class Terminal:
    """``mc-nested`` with these words in a terminal of so many columns and lines; ``hangs_up`` when it is closed."""

    def __init__(
        self, words: Sequence[str | Path], folder: Path, columns: int = 100, lines: int = 30, *, hangs_up: bool = False
    ) -> None:
        self._master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))
        self.before = termios.tcgetattr(slave)
        self._slave = slave
        self._open = [slave, self._master]
        command = [sys.executable, "-m", "mc_nested.cli", *map(str, words)]
        if hangs_up:
            command = ["env", "--default-signal=HUP", "setsid", "--ctty", *command]  # the tests may run under nohup
        env = {**os.environ, "TERM": "xterm-256color"}
        alone = not hangs_up
        self.process = subprocess.Popen(
            command, stdin=slave, stdout=slave, stderr=slave, cwd=folder, env=env, start_new_session=alone
        )
        self.raw = b""

    @property
    def text(self) -> str:
        """The whole text that was shown until now, without colours and positions."""
        return ESCAPES.sub(b"", self.raw).decode(errors="replace")

    @property
    def mode(self) -> list[object]:
        """The terminal's current settings."""
        return list(termios.tcgetattr(self._slave))

    def until(self, words: str, *others: "Terminal") -> None:
        """Read on until these words were shown. Other terminals are read, too: a full one stops its program."""
        end = time.monotonic() + PATIENCE_S
        while words not in self.text:
            assert time.monotonic() < end, f"{words!r} never came: {self.text[-2000:]}"
            for terminal in (self, *others):
                terminal.read()

    def press(self, keys: str) -> None:
        """Type them; what is shown from now on is looked at alone."""
        self.raw = b""
        os.write(self._master, keys.encode())

    def end(self) -> int:
        """Read on until the program has ended; its exit code."""
        end = time.monotonic() + PATIENCE_S
        while self.process.poll() is None:
            assert time.monotonic() < end, f"it goes on: {self.text[-2000:]}"
            self.read()
        self.read()
        return self.process.returncode

    def until_gone(self, process: int) -> None:
        """Read on until a process is gone, or a zombie that nobody asked for."""
        end = time.monotonic() + PATIENCE_S
        stat = Path(f"/proc/{process}/stat")
        while stat.exists() and " Z " not in stat.read_text():
            assert time.monotonic() < end, f"it goes on: {self.text[-2000:]}"
            self.read()

    def hang_up(self) -> int:
        """Close the terminal, as a person closes its window, and return the program's exit code."""
        self._close()
        return self.process.wait(PATIENCE_S)

    def close(self) -> None:
        """End it, whatever it does."""
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self._close()

    def _close(self) -> None:
        for number in self._open:
            os.close(number)
        self._open.clear()

    def read(self) -> None:
        """Read what is there."""
        while select.select([self._master], [], [], 0.1)[0]:
            self.raw += os.read(self._master, 65536)
