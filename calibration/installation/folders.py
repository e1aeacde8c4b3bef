"""Find the games that launchers keep: the folders with an ``options.txt``, and the plain game's client jars.

Each launcher's folders are data, relative to the home and the environment of a ``System``, so that any system can be
examined on any other (FACTS: Launchers' folders).
"""

import json
import os
import re
import stat
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from mc_nested.live.model.versions import version_numbers

Platform = Literal["linux", "macos", "windows"]

OPTIONS = "options.txt"
LOG = Path("logs", "latest.log")
"""A file that the game writes to while it runs."""

Layout = Literal["official", "instances", "profiles", "curseforge"]

_PLAIN = re.compile(r"\d+\.\d+(?:\.\d+)?")
_VERSIONED = re.compile(rf"({_PLAIN.pattern})(?:-.*)?")


@dataclass(frozen=True)
class System:
    """A computer as launchers see it: its platform, the user's home, and the environment's variables."""

    platform: Platform
    home: Path
    environment: Mapping[str, str]

    @classmethod
    def here(cls) -> "System":
        """Return this computer."""
        platforms: dict[str, Platform] = {"win32": "windows", "darwin": "macos"}
        return cls(platforms.get(sys.platform, "linux"), Path.home(), os.environ)

    def folder(self, base: str) -> Path:
        """Return the folder for ``~``, or for ``data``, where programs keep their data."""
        if base == "~":
            return self.home
        if base == "data" and self.platform == "macos":
            return self.home / "Library" / "Application Support"
        variable, default = ("APPDATA", "AppData/Roaming") if self.platform == "windows" else _XDG_DATA
        # An empty variable counts as unset, and so, by XDG's rules, does a relative path.
        named = Path(self.environment.get(variable, ""))
        return named if named.is_absolute() else self.home / default


_XDG_DATA = ("XDG_DATA_HOME", ".local/share")


@dataclass(frozen=True)
class Launcher:
    """A launcher, and its roots on each platform: a base of ``System.folder`` and the path from there."""

    name: str
    layout: Layout
    roots: Mapping[Platform, tuple[tuple[str, str], ...]]


LAUNCHERS = (
    Launcher(
        "Minecraft Launcher",
        "official",
        {
            "windows": (("data", ".minecraft"),),
            "macos": (("data", "minecraft"),),
            "linux": (("~", ".minecraft"), ("~", ".var/app/com.mojang.Minecraft/.minecraft")),
        },
    ),
    Launcher(
        "Prism Launcher",
        "instances",
        {
            "windows": (("data", "PrismLauncher"),),
            "macos": (("data", "PrismLauncher"),),
            "linux": (
                ("data", "PrismLauncher"),
                ("~", ".var/app/org.prismlauncher.PrismLauncher/data/PrismLauncher"),
            ),
        },
    ),
    Launcher(
        # It is wherever it was unpacked: these are the usual folders.
        "MultiMC",
        "instances",
        {
            "windows": tuple(("~", f"{folder}MultiMC") for folder in ("", "Desktop/", "Documents/", "Downloads/")),
            "macos": (("~", "Applications/MultiMC.app/Data"), ("~", "Applications/MultiMC.app/Contents/MacOS")),
            "linux": (("data", "multimc"), ("~", "MultiMC"), ("~", ".config/local/multimc")),
        },
    ),
    Launcher(
        "Modrinth App",
        "profiles",
        {
            "windows": (("data", "ModrinthApp"), ("data", "com.modrinth.theseus")),
            "macos": (("data", "ModrinthApp"), ("data", "com.modrinth.theseus")),
            "linux": (
                ("data", "ModrinthApp"),
                ("data", "com.modrinth.theseus"),
                ("~", ".var/app/com.modrinth.ModrinthApp/data/ModrinthApp"),
            ),
        },
    ),
    Launcher(
        "CurseForge",
        "curseforge",
        {
            "windows": (("~", "curseforge/minecraft"),),
            "macos": (("~", "Documents/curseforge/minecraft"),),
            "linux": (("~", "Documents/curseforge/minecraft"),),
        },
    ),
)

_GAMES: Mapping[Layout, tuple[str, ...]] = {
    "official": (".",),
    "instances": ("instances/*/.minecraft", "instances/*/minecraft"),
    "profiles": ("profiles/*",),
    "curseforge": ("Instances/*",),
}
"""Where game folders lie below a launcher's root."""

_JARS: Mapping[Layout, str] = {
    "official": "versions/*/*.jar",
    "instances": "libraries/com/mojang/minecraft/*/minecraft-*-client.jar",
    "profiles": "meta/versions/*/*.jar",
    "curseforge": "Install/versions/*/*.jar",
}
"""Where client jars lie below it; the name of a jar's folder gives its version."""


@dataclass(frozen=True)
class GameFolder:
    """A folder that a game was played in; ``version`` is Minecraft's, None if the launcher doesn't say."""

    path: Path
    launcher: str
    version: str | None = None

    @property
    def options(self) -> Path:
        """Its options.txt."""
        return self.path / OPTIONS

    def last_used(self) -> float:
        """Return when the game last wrote into it, in seconds since 1970; 0 if unknown."""
        return max(file.st_mtime if (file := _stat(each)) else 0.0 for each in (self.options, self.path / LOG))


def game_folders(system: System, version: str | None = None) -> list[GameFolder]:
    """Return the launchers' game folders that hold an options.txt: those of the version first, then the last used ones.

    Unreadable folders are left out. Folders of unknown version come between those of the right and of a wrong one.
    """
    found: dict[Path, GameFolder] = {}
    for launcher, root in _roots(system):
        for pattern in _GAMES[launcher.layout]:
            for path in _matches(root, pattern):
                if _stat(path / OPTIONS):
                    folder = GameFolder(path, launcher.name, _version_of(path, launcher.layout))
                    found.setdefault(path.resolve(), folder)

    def rank(folder: GameFolder) -> tuple[int, float]:
        fits = 1 if version is None or folder.version is None else 2 if folder.version == version else 0
        return fits, folder.last_used()

    return sorted(found.values(), key=rank, reverse=True)


def client_jars(system: System, version: str | None = None) -> list[Path]:
    """Return the client jars of all launchers, the newest version first; with ``version`` the best ones for it first.

    Best is the plain game's jar of exactly that version, then a modified one's, then the nearest older versions, then
    the newer ones: the font seldom changes (FACTS: The bitmap font). Empty files, which some mod loaders leave, are
    left out.
    """
    jars = {
        jar.resolve(): (jar, found[1])
        for launcher, root in _roots(system)
        for jar in _matches(root, _JARS[launcher.layout])
        if (found := _VERSIONED.fullmatch(jar.parent.name)) and (file := _stat(jar)) and file.st_size
    }
    wanted = version_numbers(version) if version else None

    def distance(entry: tuple[Path, str]) -> tuple[int, tuple[int, ...], bool]:
        jar, named = entry
        numbers = version_numbers(named)
        older_first = tuple(-number for number in numbers)
        is_changed = jar.parent.name != named
        if wanted is None or numbers < wanted:
            return 1, older_first, is_changed
        return (0, older_first, is_changed) if numbers == wanted else (2, numbers, is_changed)

    return [jar for jar, _ in sorted(jars.values(), key=lambda entry: (distance(entry), str(entry[0])))]


def jar_version(jar: Path) -> str | None:
    """Return the Minecraft version of a jar of ``client_jars``, by its folder's name."""
    found = _VERSIONED.fullmatch(jar.parent.name)
    return found[1] if found else None


def _roots(system: System) -> Iterator[tuple[Launcher, Path]]:
    for launcher in LAUNCHERS:
        for base, path in launcher.roots[system.platform]:
            yield launcher, system.folder(base) / path


def _matches(root: Path, pattern: str) -> list[Path]:
    """Return what matches the pattern below the root, sorted by name; nothing if that can't be read."""
    try:
        return [root] if pattern == "." else sorted(root.glob(pattern))
    except OSError:
        return []


def _version_of(game: Path, layout: Layout) -> str | None:
    """Return the version that a launcher records in or beside a game folder."""
    if layout == "instances":
        pack = _json(game.parent / "mmc-pack.json")
        parts = pack.get("components")
        for part in parts if isinstance(parts, list) else ():
            if isinstance(part, dict) and part.get("uid") == "net.minecraft":
                return _text(part.get("version"))
    if layout == "curseforge":
        return _text(_json(game / "minecraftinstance.json").get("gameVersion"))
    return None


def _json(file: Path) -> dict[str, Any]:
    try:
        known = json.loads(file.read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    return known if isinstance(known, dict) else {}


def _text(value: object) -> str | None:
    return value if isinstance(value, str) and value else None


def _stat(file: Path) -> os.stat_result | None:
    """Return the status of a readable regular file, else None."""
    try:
        found = file.stat()
    except OSError:
        return None
    return found if stat.S_ISREG(found.st_mode) else None
