"""What the scripts need that pip doesn't install: Debian's programs, and wheels of other systems; one run at a time.

Linux only. apt's versions are the distribution's; what pip fetches is pinned with its sha256, and only unpacked.
"""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_lock import folder_lock

ROOT = Path(__file__).resolve().parent.parent
"""The checkout."""

INSTALL_S = 600.0
PATIENCE_S = 1800.0
"""Seconds to wait for another run: it may be fetching everything over a slow connection."""
APT = Path("/var/lib/apt")
"""Where apt keeps its lists: only one process at a time can update them."""

Say = Callable[[str], None]


class MissingError(Exception):
    """The machine lacks something; the message says in one line what, and how to get it."""


@dataclass(frozen=True)
class Program:
    """A program under any of its names, and the Debian package that has it."""

    names: tuple[str, ...]
    package: str

    def path(self) -> str | None:
        """Return its path; None when it isn't installed."""
        return next((path for path in map(shutil.which, self.names) if path), None)

    def required(self) -> str:
        """Return its path; MissingError when it isn't installed."""
        path = self.path()
        if path is None:
            raise MissingError(f"{self.names[0]} is missing: install the package {self.package}")
        return path


XVFB = Program(("Xvfb",), "xvfb")
XDOTOOL = Program(("xdotool",), "xdotool")
OPENGL = ("libgl1", "libgl1-mesa-dri")
"""Debian's packages of OpenGL without a graphics card."""


def install(who: str, programs: Sequence[Program], libraries: Sequence[str], say: Say, log: Path) -> None:
    """Install what is missing with apt; MissingError, which says ``who`` needs it, where that is impossible."""
    packages = {program.package for program in programs if program.path() is None}
    packages |= {library for library in libraries if not _is_installed(library)}
    if packages:
        _apt_install(who, sorted(packages), say, log)


def _apt_install(who: str, packages: Sequence[str], say: Say, log: Path) -> None:
    by_hand = f"sudo apt-get install --no-install-recommends {' '.join(packages)}"
    if shutil.which("apt-get") is None:
        raise MissingError(f"{who} needs programs that it can only get with apt; on Debian or Ubuntu: {by_hand}")
    if os.geteuid() != 0:
        raise MissingError(f"{who} needs programs that only root can install: {by_hand}")
    say(f"installing with apt: {' '.join(packages)}")
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    with alone(APT, say, "installation with apt"):
        for arguments in (["update"], ["install", "-y", "--no-install-recommends", *packages]):
            if not run_logged(["apt-get", *arguments], log, env=quiet):
                raise MissingError(f"apt-get {arguments[0]} failed (see {log}); run it by hand: {by_hand}")


def _is_installed(package: str) -> bool:
    """Return whether Debian's package is installed. Other systems aren't checked: a missing one shows in the window."""
    if shutil.which("dpkg-query") is None:
        return True
    asked = ["dpkg-query", "--show", "--showformat", "${Status}", package]
    answer = subprocess.run(asked, capture_output=True, text=True, timeout=30, check=False)  # noqa: S603 - fixed
    return answer.stdout == "install ok installed"


def fetch_wheels(pins: Path, platform: str, folder: Path, log: Path) -> list[Path]:
    """Fetch the wheels for another system that a file pins; MissingError where that is impossible."""
    kind = ["--platform", platform, "--python-version", "3.12", "--only-binary", ":all:", "--no-deps"]
    pinned = ["--require-hashes", "-r", str(pins), "--dest", str(folder)]
    if not run_logged([sys.executable, "-m", "pip", "download", *kind, *pinned], log):
        raise MissingError(f"pip could not fetch all of {pins.name} (see {log}): can the package index be reached?")
    return sorted(folder.glob("*.whl"))


def run_logged(
    command: Sequence[str],
    log: Path,
    *,
    cwd: Path | None = None,
    env: Mapping[str, str] | None = None,
    timeout_s: float = INSTALL_S,
) -> bool:
    """Run a command, its output into ``log``; return whether it succeeded in time."""
    with log.open("a", encoding="utf-8") as output:
        print("$", *command, file=output, flush=True)
        try:
            done = subprocess.run(  # noqa: S603 - fixed commands of the scripts
                command,
                cwd=cwd,
                env=env,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                timeout=timeout_s,
                check=False,
            )
        except subprocess.TimeoutExpired:
            print(f"stopped after {timeout_s:.0f} s", file=output)
            return False
    return done.returncode == 0


@contextmanager
def alone(folder: Path, say: Say, what: str, patience_s: float = PATIENCE_S) -> Iterator[None]:
    """Let one at a time use the folder: a second waits, and says so; RunError where that takes too long."""
    with ExitStack() as held:
        try:
            held.enter_context(folder_lock(folder))
        except RunError:
            say(f"waiting for another {what} to end")
            held.enter_context(folder_lock(folder, patience_s))
        yield
