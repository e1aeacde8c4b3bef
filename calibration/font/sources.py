"""Find the files that may hold a game's font: enabled resource packs first, then the launchers' client jars.

The game runs here, or was recorded, perhaps on another computer.
"""

import json
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

from calibration.installation.folders import GameFolder, System, client_jars, game_folders
from mc_nested.errors import FontError, ProfileError
from mc_nested.live.model.versions import version_in
from mc_nested.live.profile.tables import ScreenTable
from mc_nested.live.recording.recording_file import facts_of
from mc_nested.live.recording.replayed_run import profile_of
from mc_nested.live.vision.font import load_font

_LINE = re.compile(r"^(\w+):(.*)$", re.MULTILINE)


@dataclass(frozen=True)
class FontSources:
    """Files and folders to try, the likeliest first, and the options of the game's options.txt, if it was found."""

    paths: tuple[Path, ...]
    options: Mapping[str, str] = field(default_factory=dict)


def font_sources(system: System, version: str | None) -> FontSources:
    """Return where a game of that version may have its font from; None is an unknown version."""
    folders = game_folders(system, version)
    options = _options_of(folders[0]) if folders else {}
    packs = _packs(folders[0], options) if folders else ()
    return FontSources((*packs, *client_jars(system, version)), options)


def _packs(folder: GameFolder, options: Mapping[str, str]) -> Sequence[Path]:
    """Return the enabled resource packs that exist, the uppermost first."""
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


def font_of_recording(path: Path, system: System) -> Path:
    """Return the font that a recording's profile names, or the client jar here that is nearest to its version.

    Raises:
        RecordingError: the recording can't be used, or says nothing of its profile.
        FontError: there is no font here that can be used.
    """
    facts = facts_of(path)
    sources = [*_own(profile_of(path, facts).screen), *client_jars(system, version_in(facts.get("title", "")))]
    for source in sources:
        with suppress(FontError):
            load_font(source)
            return source
    raise FontError(
        f"{path}: the font of the game that was recorded isn't on this computer: name its client jar with --font"
    )


def _own(screen: ScreenTable) -> list[Path]:
    with suppress(ProfileError):  # none is named, or one of another computer
        return [screen.font_path()]
    return []
