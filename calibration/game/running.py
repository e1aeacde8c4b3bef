"""Whether a game runs in a folder, by the processes of this computer: a second look beside that for the game's window.

A launcher starts Java in the game's folder, and names it on the command line or not (FACTS: Launchers' folders).
"""

import os
import re
import shutil
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from calibration.game.folders import Platform

_PROCESSES = Path("/proc")
_PATIENCE_S = 20.0
_JAVA = re.compile(r"(?:^|[\\/ \"])javaw?(?:\.exe)?(?:[\" ]|$)", re.IGNORECASE)
_GAME = re.compile(r"minecraft|prismlauncher|multimc|modrinth|curseforge", re.IGNORECASE)
_NAMED = re.compile(r"--gameDir[ =]+\"?(.+?)\"?(?= --|$)")


@dataclass(frozen=True)
class Process:
    """A running program: its command line, and the folder that it runs in where the system tells."""

    command: str
    folder: Path | None = None

    @property
    def is_game(self) -> bool:
        """Whether it is a Java that speaks of Minecraft."""
        return bool(_JAVA.search(self.command) and _GAME.search(self.command))

    @property
    def plays_in(self) -> Path | None:
        """The folder of the game, if it is one: as its command line says, else the one that it runs in."""
        named = _NAMED.search(self.command)
        return Path(named[1]) if named else self.folder


def running(platform: Platform, processes: Path = _PROCESSES) -> list[Process] | None:
    """The programs that run now, as far as this user may see them; None where the system can't be asked."""
    if platform == "linux":
        return _listed(processes)
    ask = (
        ("powershell", "-NoProfile", "-NonInteractive", "-Command", "(Get-CimInstance Win32_Process).CommandLine")
        if platform == "windows"
        else ("ps", "-axww", "-o", "command=")
    )
    told = _told(ask)
    return None if told is None else [Process(line.strip()) for line in told.splitlines() if line.strip()]


def may_hold(process: Process, folder: Path) -> bool:
    """Whether a program may be a game that has this folder open: it says so, or it doesn't say that it is elsewhere.

    Of two mistakes the smaller one: a game that plays elsewhere has to be closed too.
    """
    if not process.is_game:
        return False
    plays_in = process.plays_in
    return plays_in is None or is_same(plays_in, folder)


def played_now(processes: Iterable[Process]) -> list[Path]:
    """The folders that running games say they play in."""
    return [folder for each in processes if each.is_game and (folder := each.plays_in)]


def is_same(one: Path, other: Path) -> bool:
    """Whether two ways lead to one folder."""
    return os.path.normcase(one.resolve()) == os.path.normcase(other.resolve())


def _listed(processes: Path) -> list[Process] | None:
    """What Linux tells of each process: ``cmdline``, its words ending in a zero byte, and ``cwd``, a link."""
    try:
        entries = [each for each in processes.iterdir() if each.name.isdecimal()]
    except OSError:
        return None
    found = []
    for entry in entries:
        try:
            command = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode("utf-8", "replace").strip()
        except OSError:  # ended since it was listed, or another user's
            continue
        found.append(Process(command, _link(entry / "cwd")))
    return found


def _link(path: Path) -> Path | None:
    try:
        return path.readlink()
    except OSError:
        return None


def _told(ask: Sequence[str]) -> str | None:
    """What a program of the system prints; None where it isn't there, fails or takes too long."""
    program = shutil.which(ask[0])
    if program is None:
        return None
    try:
        done = subprocess.run(  # noqa: S603 - the system's own, with fixed words
            [program, *ask[1:]], capture_output=True, text=True, errors="replace", timeout=_PATIENCE_S, check=True
        )
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout
