"""A rehearsal window for tests and benchmarks, with the world's truth as its client writes it."""

import json
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mc_nested.live.model.reading import Block
from mc_nested.live.profile.arena import Arena
from scripts.programs import ROOT
from scripts.window_display import running, wait_until
from sim.client.game.world import AIR

START_S = 30.0

RELEASED_S = 5.0
"""How long a window on a busy machine may take until a frame of its takes a key's release."""


class TruthReader:
    """The world as the client says it is (sim/window/rehearsal.py)."""

    def __init__(self, path: Path) -> None:
        self._path = path

    def now(self) -> dict[str, Any]:
        """Return all that the client says."""
        found: dict[str, Any] = json.loads(self._path.read_text(encoding="utf-8"))
        return found

    def way(self) -> list[tuple[int, tuple[float, float, float]]]:
        """Return where the player was after each of the last ticks, by the tick's number."""
        return [(tick, (x, y, z)) for tick, (x, y, z) in self.now()["way"]]

    def feet(self) -> tuple[float, float, float]:
        """Return where the player is."""
        x, y, z = self.now()["feet"]
        return x, y, z

    def keys_left_down(self) -> list[str]:
        """Return the keys that stay down, or none once the window has taken every release."""
        wait_until(lambda: not self.now()["keys_down"], RELEASED_S)
        down: list[str] = self.now()["keys_down"]
        return down

    def built(self) -> dict[Block, str]:
        """Return every block that differs from the bare floor."""
        return {(x, y, z): name for x, y, z, name in self.now()["built"]}

    def standing(self, arena: Arena) -> dict[Block, str]:
        """Return the blocks in the region that a reset of the arena clears."""
        return standing_in(arena, self.built())


def standing_in(arena: Arena, built: Mapping[Block, str]) -> dict[Block, str]:
    """Return the blocks in the region that a reset of the arena clears."""
    low, high = arena.region
    return {
        at: name
        for at, name in built.items()
        if name != AIR and all(low[axis] <= at[axis] <= high[axis] for axis in range(3))
    }


@dataclass(frozen=True)
class RehearsalWindow:
    """A rehearsal that is open: the environment of programs that play in it, its process, and what its client says."""

    env: dict[str, str]
    process: "subprocess.Popen[bytes]"
    font: Path
    truth_file: Path
    log: Path

    @property
    def truth(self) -> TruthReader:
        """The world as it truly is."""
        return TruthReader(self.truth_file)


@contextmanager
def open_rehearsal(env: dict[str, str], folder: Path, *options: str) -> Iterator[RehearsalWindow]:
    """Open a rehearsal on the display of ``env``, in front, with ``mc-nested rehearse``'s options and seed 0.

    Its debug screen shows what the tutorial asks for. What it writes is in ``folder``. RuntimeError with what it said
    if it doesn't open.
    """
    truth, log, font = (folder / name for name in ("truth.json", "rehearsal.log", "font.png"))
    truth.unlink(missing_ok=True)
    write_font(font)
    command = [sys.executable, "-m", "mc_nested.cli", "rehearse", "--seed", "0"]
    command += ["--truth", str(truth), "--font", str(font), *_with_target(folder, options)]
    with running(command, env={**env, "PYTHONPATH": str(ROOT)}, log=log) as process:
        wait_until(lambda: truth.exists() or process.poll() is not None, START_S)
        if not truth.exists():
            raise RuntimeError(f"the rehearsal window didn't open: {log.read_text(encoding='utf-8')}")
        yield RehearsalWindow(env, process, font, truth, log)


def _with_target(folder: Path, options: tuple[str, ...]) -> tuple[str, ...]:
    """Return these options, and from 1.21.9 on a debug-profile.json that shows the block looked at, too."""
    if "--version" not in options or "--debug-profile" in options:
        return options
    from sim.client.game.debug_entries import TUTORIAL
    from sim.client.game.edition import Edition

    edition = Edition(options[options.index("--version") + 1])
    if not edition.since(1, 21, 9):
        return options
    status, written = ("inOverlay", 4671) if edition.since(1, 21, 11) else ("inF3", 4649)
    profile = folder / "debug-profile.json"
    custom = {f"minecraft:{entry}": status for entry in TUTORIAL}
    profile.write_text(json.dumps({"DataVersion": written, "custom": custom}), encoding="utf-8")
    return (*options, "--debug-profile", str(profile))


def write_font(path: Path) -> None:
    """Write the project's own font as a picture."""
    import cv2

    from sim.client.drawing.letters import drawn_atlas

    cv2.imwrite(str(path), drawn_atlas())


def mc_nested(*arguments: str | Path, env: dict[str, str], timeout_s: float = 600.0) -> str:
    """Return what the command prints; RuntimeError with what it says if it doesn't succeed."""
    command = [sys.executable, "-m", "mc_nested.cli", *map(str, arguments)]
    done = subprocess.run(  # noqa: S603 - our own
        command, env={**env, "PYTHONPATH": str(ROOT)}, capture_output=True, text=True, timeout=timeout_s, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stderr or done.stdout)
    return done.stdout
