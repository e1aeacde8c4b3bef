"""TerminalView: the live view in this terminal, as a process of its own, beside a run of this process.

A process of its own, since drawing would take the interpreter from an agent that is at its keys. What the run prints
meanwhile goes to a file; the view shows its last lines, and they are printed once the view is closed.
"""

import contextlib
import os
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import TextIO

from mc_nested.view.status import MOST_LINES

STDOUT, STDERR = 1, 2

CLOSES_WITHIN_S = 5.0
"""Seconds in which a view closes once its run has ended; after that it is ended."""

TAIL_BYTES = 4000

LEAVE = b"\x1b[?1049l\x1b[?1000l\x1b[?1003l\x1b[?1006l\x1b[?2004l\x1b[?25h\x1b[0m"
"""The terminal's main screen, no reports of mouse and paste, its cursor: what a view that was killed left undone."""


def can_draw() -> bool:
    """Return whether there is a terminal to draw in and to take keys from."""
    are_terminals = all(stream.isatty() for stream in (sys.stdin, sys.stdout, sys.stderr))
    return are_terminals and os.environ.get("TERM", "") not in ("dumb", "unknown")


class TerminalView:
    """The view of the run in a folder."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = threading.Lock()
        self._kept = tempfile.TemporaryDirectory(prefix="mc-nested-view-")
        self._printed = Path(self._kept.name) / "printed.txt"
        self._streams = sys.stdout, sys.stderr
        self._aside: TextIO | None = None
        self._terminal: dict[int, int] = {}
        self._restore = _terminal_restorer()
        self._process: subprocess.Popen[bytes] | None = None
        self._waits = threading.Thread(target=self._wait_for_its_end, name="view", daemon=True)

    @property
    def is_open(self) -> bool:
        """Whether somebody can see it."""
        return self._aside is not None

    def open(self) -> None:
        """Open it; the run's status must be published by now. Raise OSError or RuntimeError if the system refuses."""
        self._put_aside()
        try:
            command = [sys.executable, "-m", "mc_nested.cli", "view", str(self._folder), "--close-at-end"]
            out, err = self._terminal.get(STDOUT), self._terminal.get(STDERR)
            self._process = subprocess.Popen(command, stdout=out, stderr=err)  # noqa: S603 - this program
            self._waits.start()
        except (OSError, RuntimeError):
            if self._process:
                self._process.kill()
                self._process.wait()
                self._process = None
            self._put_back()
            raise

    def lines(self) -> Sequence[str]:
        """Return the last lines that the run printed."""
        with self._lock:
            if self._aside is None:
                return ()
            with self._printed.open("rb") as file:
                file.seek(max(0, self._printed.stat().st_size - TAIL_BYTES))
                text = file.read().decode(errors="replace")
        return [line.strip() for line in text.splitlines() if line.strip()][-MOST_LINES:]

    def close(self) -> None:
        """Wait until it has closed, which it does once the run has ended."""
        if self._process is not None:
            self._waits.join(CLOSES_WITHIN_S)
            if self._waits.is_alive():
                self._process.kill()
            self._waits.join()
        self._kept.cleanup()

    def _put_aside(self) -> None:
        """Send what this program and its libraries print from now on to a file."""
        for stream in self._streams:
            stream.flush()
        aside = self._printed.open("a", encoding="utf-8", errors="replace", buffering=1)
        if sys.platform != "win32":  # where a console's streams don't follow such a change
            for number in (STDOUT, STDERR):
                self._terminal[number] = os.dup(number)
                os.dup2(aside.fileno(), number)
        self._aside = sys.stdout = sys.stderr = aside

    def _put_back(self) -> None:
        """Print in the terminal again from now on, and print what was kept."""
        if self._aside is None:
            return
        with contextlib.suppress(OSError):
            self._aside.flush()
        sys.stdout, sys.stderr = self._streams
        for number, own in self._terminal.items():
            os.dup2(own, number)
            os.close(own)
        self._terminal.clear()
        self._aside.close()
        self._aside = None
        with contextlib.suppress(OSError):
            sys.stderr.write(self._printed.read_text(encoding="utf-8", errors="replace"))
            sys.stderr.flush()

    def _wait_for_its_end(self) -> None:
        code = self._process.wait() if self._process else 0
        with self._lock:
            if code:  # it was killed
                self._restore()
            self._put_back()


def _terminal_restorer() -> Callable[[], object]:
    """Return a function that puts the terminal back as it is now."""
    if sys.platform == "win32":
        return partial(os.write, STDERR, LEAVE)
    import termios

    before = termios.tcgetattr(sys.stdin)
    terminal = sys.stdin.fileno()

    def restore() -> None:
        with contextlib.suppress(termios.error, OSError):
            termios.tcsetattr(terminal, termios.TCSADRAIN, before)
            os.write(terminal, LEAVE)

    return restore
