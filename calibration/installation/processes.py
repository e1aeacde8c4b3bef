"""Check by this computer's processes if a game runs in a folder: a second check beside looking for its window.

A launcher starts Java in the game's folder, and may name it on the command line (FACTS: Launchers' folders).
"""

import os
import re
import shutil
import subprocess
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from calibration.installation.folders import Platform

_PROCESSES = Path("/proc")
_PATIENCE_S = 20.0
_JAVA = re.compile(r"(?:^|[\\/ \"])javaw?(?:\.exe)?(?:[\" ]|$)", re.IGNORECASE)
_GAME = re.compile(r"minecraft|prismlauncher|multimc|modrinth|curseforge", re.IGNORECASE)
_NAMED = re.compile(r"--gameDir[ =]+\"?(.+?)\"?(?= --|$)")


@dataclass(frozen=True)
class Process:
    """A running program: its command line, and its working directory, if known."""

    command: str
    folder: Path | None = None

    @property
    def is_game(self) -> bool:
        """Whether it is Java with Minecraft on its command line."""
        return bool(_JAVA.search(self.command) and _GAME.search(self.command))

    @property
    def game_folder(self) -> Path | None:
        """The game's folder, if this is a game: the one on its command line, else its working directory."""
        named = _NAMED.search(self.command)
        return Path(named[1]) if named else self.folder


def running_processes(platform: Platform, processes: Path = _PROCESSES) -> list[Process] | None:
    """Return the programs that are running, as far as this user may see them; None if the system can't be asked."""
    if platform == "linux":
        return _linux_processes(processes)
    query = (
        ("powershell", "-NoProfile", "-NonInteractive", "-Command", "(Get-CimInstance Win32_Process).CommandLine")
        if platform == "windows"
        else ("ps", "-axww", "-o", "command=")
    )
    output = _output_of(query)
    return None if output is None else [Process(line.strip()) for line in output.splitlines() if line.strip()]


def may_have_open(process: Process, folder: Path) -> bool:
    """Return whether a program may be a game that uses this folder: its own folder is this one, or unknown.

    An unknown folder counts as this one. That is the less harmful mistake: a game in another folder may have to be
    closed, too.
    """
    if not process.is_game:
        return False
    return process.game_folder is None or is_same_folder(process.game_folder, folder)


def folders_played(processes: Iterable[Process]) -> list[Path]:
    """Return the known folders of running games."""
    return [folder for each in processes if each.is_game and (folder := each.game_folder)]


def is_same_folder(one: Path, other: Path) -> bool:
    """Return whether two paths lead to the same folder."""
    return os.path.normcase(one.resolve()) == os.path.normcase(other.resolve())


def _linux_processes(processes: Path) -> list[Process] | None:
    """Return each process on Linux: ``cmdline``, words that end in a zero byte, and ``cwd``, a link."""
    try:
        entries = [each for each in processes.iterdir() if each.name.isdecimal()]
    except OSError:
        return None
    running = []
    for entry in entries:
        try:
            command = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode("utf-8", "replace").strip()
        except OSError:  # it has ended meanwhile, or is another user's
            continue
        running.append(Process(command, _link(entry / "cwd")))
    return running


def _link(path: Path) -> Path | None:
    try:
        return path.readlink()
    except OSError:
        return None


def _output_of(query: Sequence[str]) -> str | None:
    """Return what a system program prints; None if it is missing, fails or takes too long."""
    program = shutil.which(query[0])
    if program is None:
        return None
    try:
        done = subprocess.run(  # noqa: S603 - the system's own, with fixed words
            [program, *query[1:]], capture_output=True, text=True, errors="replace", timeout=_PATIENCE_S, check=True
        )
    except (OSError, subprocess.SubprocessError):
        return None
    return done.stdout
