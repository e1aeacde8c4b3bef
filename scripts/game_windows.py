"""The libraries of the game's windows beside GLFW, fetched once: SDL 3 (26.3 on) with pip, LWJGL 2 (to 1.12) with apt.

Standard library only, and Linux only. What pip fetches is pinned with its sha256, and only unpacked; apt's versions
are the distribution's.
"""

import os
import subprocess
import sys
import tempfile
import zipfile
from dataclasses import dataclass
from pathlib import Path

from scripts.cache_lock import alone
from scripts.standin_parts import MissingError, Program, Say, apt_install, is_installed, run_logged

CACHE = Path(__file__).resolve().parent.parent / ".game-windows"
JAVA = Program(("java",), "default-jre")
JAVAC = Program(("javac",), "default-jdk-headless")
LWJGL_2 = ("liblwjgl-java", "liblwjgl-java-jni", "default-jre")
"""Debian's packages; LWJGL 2 needs AWT with its windows, which a headless JRE lacks."""
LWJGL_2_JAR, NATIVES = "/usr/share/java/lwjgl.jar", "/usr/lib/jni"


@dataclass(frozen=True)
class Sdl:
    """A release of SDL 3, as it lies in a wheel of tcod."""

    release: str
    platform: str
    wheel: str
    sha256: str
    member: str

    @property
    def library(self) -> Path:
        """Where it is once it is fetched."""
        return CACHE / f"sdl-{self.release}-{self.platform}" / Path(self.member).name


SDL_3_2 = Sdl(
    "3.2.16",
    "manylinux_2_28_x86_64",
    "tcod==21.0.0",
    "5f36db2a37a791623455ac9a2a9710c96d23ddf56a03d16fbd40df44c25d564b",
    "tcod.libs/libSDL3-3473f499.so.0.2.16",
)
SDL_3_4 = Sdl(
    "3.4.18",
    "manylinux_2_28_x86_64",
    "tcod==21.2.2",
    "be0ae2b75ff49c033f5f1ad274e5716c05dcee016ec983ee5f9382c739e78564",
    "tcod.libs/libSDL3-3fa10a58.so.0.4.18",
)
SDL_3_4_WINDOWS = Sdl(
    "3.4.18",
    "win_amd64",
    "tcod==21.2.2",
    "96e255a781fe943e3276313fd5c5b7f47a308f60d065d06f168129cc008e9986",
    "tcod/x64/SDL3.dll",
)


def fetch_sdl(sdl: Sdl, say: Say) -> Path:
    """The library, fetched unless it is there; MissingError where that is impossible."""
    CACHE.mkdir(exist_ok=True)
    with alone(CACHE, say, "fetching of a window's library"):
        if not sdl.library.exists():
            say(f"fetching SDL {sdl.release} with pip")
            with tempfile.TemporaryDirectory(dir=CACHE, prefix="fetching-") as scratch:
                _unpack(sdl, _download(sdl, Path(scratch)), Path(scratch))
    return sdl.library


def _download(sdl: Sdl, scratch: Path) -> Path:
    log, wanted = CACHE / "pip.log", scratch / "wanted.txt"
    wanted.write_text(f"{sdl.wheel} --hash=sha256:{sdl.sha256}\n", encoding="utf-8")
    kind = ["--platform", sdl.platform, "--python-version", "3.12", "--only-binary", ":all:", "--no-deps"]
    command = [sys.executable, "-m", "pip", "download", *kind, "--require-hashes", "-r", str(wanted)]
    if not run_logged([*command, "--dest", str(scratch)], log):
        raise MissingError(f"pip could not fetch {sdl.wheel} (see {log}): can the package index be reached?")
    return next(scratch.glob("*.whl"))


def _unpack(sdl: Sdl, wheel: Path, scratch: Path) -> None:
    """Into its place in one step, so that half a library is never taken for one."""
    part = scratch / "library"
    with zipfile.ZipFile(wheel) as members:
        part.write_bytes(members.read(sdl.member))
    sdl.library.parent.mkdir(exist_ok=True)
    part.replace(sdl.library)


def install_lwjgl_2(say: Say, log: Path) -> None:
    """Install LWJGL 2 and what compiles a program for it; MissingError where that is impossible."""
    packages = {package for package in LWJGL_2 if not is_installed(package)}
    packages |= {JAVAC.package} if JAVAC.path() is None else set()
    if packages:
        apt_install("a window of LWJGL 2", sorted(packages), say, log)


def compiled(source: Path, folder: Path) -> list[str]:
    """Compile a program for LWJGL 2 into a folder; the command that starts it, without its arguments."""
    command = [JAVAC.required(), "-cp", LWJGL_2_JAR, "-d", str(folder), str(source)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)  # noqa: S603 - fixed
    if done.returncode != 0:
        raise MissingError(f"{source.name} can't be compiled: {done.stderr}")
    classes = os.pathsep.join((LWJGL_2_JAR, str(folder)))
    return [JAVA.required(), f"-Djava.library.path={NATIVES}", "-cp", classes, source.stem]
