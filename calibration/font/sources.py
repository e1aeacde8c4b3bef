"""Where the running game's font may be: enabled resource packs first, then the launchers' client jars."""

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from calibration.installation.folders import GameFolder, System, client_jars, game_folders

_LINE = re.compile(r"^(\w+):(.*)$", re.MULTILINE)


@dataclass(frozen=True)
class FontSources:
    """Files and folders to try, the likeliest first, and the options of the game's options.txt, if it was found."""

    paths: tuple[Path, ...]
    options: Mapping[str, str] = field(default_factory=dict)


def font_sources(system: System, version: str | None) -> FontSources:
    """Where a game of that version may have its font from; None is an unknown version."""
    folders = game_folders(system, version)
    options = _options_of(folders[0]) if folders else {}
    packs = _packs(folders[0], options) if folders else ()
    return FontSources((*packs, *client_jars(system, version)), options)


def _packs(folder: GameFolder, options: Mapping[str, str]) -> Sequence[Path]:
    """The enabled resource packs that exist, the uppermost first."""
    try:
        named = json.loads(options.get("resourcePacks", "[]"))
    except ValueError:
        return ()
    names = [name.removeprefix("file/") for name in named if isinstance(name, str)] if isinstance(named, list) else []
    packs = [folder.path / "resourcepacks" / name for name in reversed(names) if Path(name).name == name]
    return [pack for pack in packs if pack.exists()]


def _options_of(folder: GameFolder) -> Mapping[str, str]:
    try:
        return dict(_LINE.findall(folder.options.read_text("utf-8", "replace")))
    except OSError:
        return {}
