"""Games on the virtual client that are served to a learner (`mc-nested serve-game`), as processes of this computer."""

import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

JOINS_S = 60.0
"""Seconds that a game may take to join, or to be asked for an episode again."""

LEAVES_S = 20.0
"""Seconds that a game may take to leave, before it is killed."""


def command(*words: str) -> list[str]:
    """The words that run ``mc-nested`` from the root."""
    return [sys.executable, "-m", "mc_nested.cli", *words]


class ServedGame:
    """A served game, and its log.

    Args:
        name: the game's, which no other may have.
        url: of the scheduler that it joins.
        folder: its log is there.
    """

    def __init__(self, name: str, url: str, folder: Path) -> None:
        self._name = name
        self._url = url
        self._log = folder / f"{name}.log"
        self._log.touch()
        self._process = self._started()

    @property
    def said(self) -> str:
        """All that it has said so far."""
        return self._log.read_text("utf-8")

    def wait_until_joined(self) -> None:
        """Wait until it has joined; TimeoutError if it doesn't."""
        end = time.monotonic() + JOINS_S
        while "has joined" not in self.said:
            if time.monotonic() > end or self._process.poll() is not None:
                raise TimeoutError(f"{self._name} has not joined: {self.said[-400:]}")
            time.sleep(0.05)

    def lose(self) -> None:
        """Kill it, and start it again."""
        self._process.kill()
        self._process.wait()
        self._process = self._started()

    def end(self) -> None:
        """End it, as a player does."""
        self._process.send_signal(signal.SIGINT)
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(LEAVES_S)
        self._process.kill()
        self._process.wait()

    def _started(self) -> subprocess.Popen[bytes]:
        words = ["serve-game", "--scheduler", self._url, "--backend", "virtual", "--name", self._name]
        with self._log.open("ab") as file:
            return subprocess.Popen(command(*words), cwd=ROOT, stdout=file, stderr=file)  # noqa: S603 - our own
