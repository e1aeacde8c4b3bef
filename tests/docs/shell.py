"""A shell in an empty folder, with a home in which a game was started once."""

import os
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from pathlib import Path

from scripts.rehearsal_window import write_font
from tests.docs.pages import ROOT, Step
from tests.docs.rules import FILES
from tests.docs.virtual_desktop import YES

LONGEST_S = 360.0
"""A command that takes longer, even on a busy machine, needs smaller sizes (rules.py)."""

OPTIONS = {"lang": "en_us", "guiScale": "2", "autoJump": "false", "pauseOnLostFocus": "false", "fullscreen": "false"}
"""The game's options.txt."""

VERSION = "1.20.1"

OF_THIS_MACHINE = ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME", "WAYLAND_DISPLAY", "COLUMNS")
"""Variables that would lead out of the home or to another display, or change what is printed."""


class StepError(AssertionError):
    """A step of a page did not do what the page says."""

    def __init__(self, step: Step, why: str) -> None:
        super().__init__(f"{step}\n{why}")


class Shell:
    """Runs programs in ``work``; ``home`` and ``env`` are theirs."""

    def __init__(self, folder: Path) -> None:
        self.home, self.work = folder / "home", folder / "work"
        for each in (self.home, self.work):
            each.mkdir()
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        kept = {name: value for name, value in os.environ.items() if name not in OF_THIS_MACHINE}
        self.env = {**kept, "HOME": str(self.home), "PATH": path, "PYTHONPATH": str(ROOT)}
        _start_game_once(self.home)
        for name, content in FILES.items():
            (self.work / name).write_bytes(content())

    def run(
        self,
        step: Step,
        command: Sequence[str | Path],
        folder: Path | None = None,
        *,
        limit_s: float = LONGEST_S,
        may_end_with: Sequence[int] = (0,),
    ) -> str:
        """Return what a program prints, whose user says yes to everything; StepError if it fails, or takes too long."""
        try:
            done = subprocess.run(
                [str(word) for word in command],
                cwd=folder or self.work,
                env=self.env,
                input=YES,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                timeout=limit_s,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            raise StepError(step, f"takes more than {limit_s:.0f} s: give it smaller sizes in rules.py") from error
        if done.returncode not in may_end_with:
            raise StepError(step, f"exit code {done.returncode}:\n{done.stdout}")
        return done.stdout


def _start_game_once(home: Path) -> None:
    """Leave in the home what a launcher leaves: a game's options and its jar, here with the project's own font."""
    game, font = home / ".minecraft", home / ".local" / "share" / "mc-nested" / "rehearsal-font.png"
    jar = game / "versions" / VERSION / f"{VERSION}.jar"
    for folder in (jar.parent, font.parent):
        folder.mkdir(parents=True)
    write_font(font)
    (game / "options.txt").write_text("".join(f"{name}:{value}\n" for name, value in OPTIONS.items()), "utf-8")
    with zipfile.ZipFile(jar, "w") as packed:
        packed.write(font, "assets/minecraft/textures/font/ascii.png")
