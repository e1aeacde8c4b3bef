"""The stand-in, a real game window, for tests (scripts/standin.py)."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import psutil  # type: ignore[import-untyped]  # it brings no types
import pytest

from scripts import standin_game
from scripts.programs import ROOT

Block = tuple[int, int, int]

LONGEST_S, STOPS_WITHIN_S = 1800.0, 60.0
"""Seconds that the script may take: it may be fetching everything over a slow connection."""


@dataclass(frozen=True)
class Standin:
    """The stand-in while it is up: where its window is, what mc-nested must know of it, and what its server knows."""

    display: str
    window_title: str
    oracle: str
    font: Path
    profile: Path

    @property
    def env(self) -> dict[str, str]:
        """The environment of a program that plays in its window."""
        return {**os.environ, "DISPLAY": self.display}

    def position(self) -> tuple[float, float, float]:
        """Return where the server has the player."""
        x, y, z = standin_game.ask(self.oracle, "/player")["position"]
        return x, y, z

    def held(self) -> str | None:
        """Return the item that the server has in the player's hand; None for an empty one."""
        held = standin_game.ask(self.oracle, "/player")["held"]
        return str(held["name"]) if held else None

    def blocks(self, low: Block, high: Block) -> dict[Block, str]:
        """Return the blocks, not air, that the server has between two corners, both inside, by position."""
        return standin_game.blocks(self.oracle, low, high)

    def is_playing(self) -> bool:
        """Return whether the page shows the world, and neither a menu nor an error instead of it."""
        return bool(standin_game.ask(self.oracle, "/screen")["playing"])

    def is_chatting(self) -> bool:
        """Return whether the page has its chat line open."""
        return bool(standin_game.ask(self.oracle, "/screen")["chat"])

    def errors(self) -> list[str]:
        """Return the errors of the page since it was opened."""
        return [str(error) for error in standin_game.ask(self.oracle, "/errors")]


def _run(command: str) -> subprocess.CompletedProcess[str]:
    """Run the script to its end; at Ctrl+C to this process alone it is told so, and ends what it has started."""
    script = [sys.executable, str(ROOT / "scripts" / "standin.py"), command]
    with subprocess.Popen(script, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        try:
            out, err = process.communicate(timeout=LONGEST_S)
        except BaseException:
            process.terminate()
            process.communicate(timeout=STOPS_WITHIN_S)
            raise
    return subprocess.CompletedProcess(script, process.returncode, out, err)


@pytest.fixture(scope="session")
def standin() -> Iterator[Standin]:
    """Return the stand-in, up for the session; one that was up before stays up.

    A machine that lacks what it needs skips the test and says how to get it; with CI set, that is a failure.
    """
    was_up = _run("status").returncode == 0
    done = _run("up")
    reason = (done.stderr.strip().splitlines() or ["standin.py up said nothing"])[-1]
    if done.returncode == 2 and not os.environ.get("CI"):
        pytest.skip(reason)
    if done.returncode != 0:
        pytest.fail(reason)
    said = json.loads(done.stdout)
    left = psutil.Process(said["pids"]["keeper"]).children(recursive=True)
    yield Standin(said["display"], said["window_title"], said["oracle"], Path(said["font"]), Path(said["profile"]))
    if was_up:
        return
    assert _run("down").returncode == 0
    assert psutil.wait_procs(left, timeout=1)[1] == []
