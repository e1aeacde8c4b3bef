"""Reads and mends the game's ``debug-profile.json``, which says from 1.21.9 on what the debug screen shows.

It stands beside options.txt. Without it the game has its default entries (FACTS: debug-profile.json).
"""

import json
import zipfile
import zlib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mc_nested.errors import ProfileError
from mc_nested.live.model.debug_entries import (
    ASSUMED_DATA,
    DATA_OF_1_21_11,
    DEFAULT_ENTRIES,
    PERFORMANCE_ENTRIES,
    POSITION,
    target_entry,
)
from mc_nested.live.model.versions import version_numbers

FILE = "debug-profile.json"

_ALWAYS, _NEVER = "alwaysOn", "never"
_SHOWN, _SHOWN_TO_1_21_10 = "inOverlay", "inF3"
"""The word for an entry that is shown with the rest of the debug screen."""

_NAMESPACE = "minecraft:"

_FIRST_DATA, _MOST_DATA = 4554, 20_000
"""The data version of 1.21.9, and one that no version reaches soon: it grows by a few hundred a year."""

_VERSION_JSON, _MOST_BYTES = "version.json", 1 << 16


@dataclass(frozen=True)
class DebugProfile:
    """The contents of the file, in the ids and words of the version that it was read for.

    Args:
        path: the file.
        version: the version that it was read for.
        data: its bytes; None where there is no file.
        statuses: the word of each entry that has one, by its whole id.
        data_version: the version that the file says to be in.
        problem: why the game can't read it, and will replace it by its default entries; None if it can.
    """

    path: Path
    version: str
    data: bytes | None
    statuses: Mapping[str, str]
    data_version: int | None = None
    problem: str | None = None

    @property
    def needed(self) -> tuple[str, str]:
        """The ids of the entries that are needed to play, without the game's namespace."""
        return POSITION, target_entry(self.version)

    @property
    def off(self) -> list[str]:
        """The ids of the needed entries that are off."""
        on = {_ALWAYS, _shown(self.version)}
        return [each for each in self.needed if self.statuses.get(_NAMESPACE + each) not in on]

    def mended(self, data_version: int | None) -> bytes:
        """Return the file's bytes with what is needed on, and every other entry as it is.

        ``data_version`` is written where the file has none: the game's own, None where that isn't known.
        """
        written = self.data_version or data_version
        if written is None:
            written = DATA_OF_1_21_11 if version_numbers(self.version) >= (1, 21, 11) else ASSUMED_DATA
        custom = {**self.statuses, **{_NAMESPACE + each: _shown(self.version) for each in self.off}}
        return json.dumps({"DataVersion": written, "custom": custom}, separators=(",", ":")).encode()


def load_debug_profile(folder: Path, version: str) -> DebugProfile:
    """Return what the file in a game's folder says, for a version that has it; ProfileError if it can't be read."""
    path = folder / FILE
    try:
        data = path.read_bytes() if path.exists() else None
    except OSError as error:
        raise ProfileError(f"{path}: can't be read ({error.strerror or error}): mend its permissions") from error
    if data is None:
        return DebugProfile(path, version, None, _of_profile("default", version))
    try:
        known = json.loads(data)
        if not isinstance(known, dict):
            raise ValueError("it is no JSON object")
        data_version = _data_version(known.get("DataVersion"))
        return DebugProfile(path, version, data, _statuses(known, version, data_version), data_version)
    except (ValueError, RecursionError) as error:
        problem = "it is no JSON" if isinstance(error, (UnicodeError, json.JSONDecodeError, RecursionError)) else error
        return DebugProfile(path, version, data, _of_profile("default", version), problem=str(problem))


def version_of_data(data_version: int) -> str:
    """Return a version with the same ids and words as the one whose options.txt says this data version."""
    if data_version > DATA_OF_1_21_11:
        return "26.1"
    if data_version == DATA_OF_1_21_11:
        return "1.21.11"
    return "1.21.9" if data_version >= _FIRST_DATA else "1.21.8"


def data_version_in(jar: Path) -> int | None:
    """Return the data version that a client's jar says to be of; None if it can't be read, or says no likely one."""
    try:
        with zipfile.ZipFile(jar) as file, file.open(_VERSION_JSON) as entry:
            known = json.loads(entry.read(_MOST_BYTES))
    except (OSError, KeyError, ValueError, EOFError, RuntimeError, zipfile.BadZipFile, zlib.error):
        return None
    return _data_version(known.get("world_version")) if isinstance(known, dict) else None


def _data_version(value: object) -> int | None:
    is_likely = isinstance(value, int) and not isinstance(value, bool) and _FIRST_DATA <= value <= _MOST_DATA
    return value if isinstance(value, int) and is_likely else None


def _statuses(known: Mapping[str, Any], version: str, data_version: int | None) -> dict[str, str]:
    """Return each entry's word, as the game would read them; ValueError where it couldn't."""
    if "profile" in known:
        return _of_profile(known["profile"], version)
    custom = known.get("custom", {})
    if not isinstance(custom, dict):
        raise ValueError("its entries are no JSON object")
    is_older = (data_version or ASSUMED_DATA) < DATA_OF_1_21_11
    shown, statuses = _shown(version), dict[str, str]()
    for name, word in custom.items():
        is_former = word == _SHOWN_TO_1_21_10 and is_older
        if word not in (_ALWAYS, _NEVER, shown) and not is_former:
            raise ValueError(f"{name} can't be {word!r}")
        statuses[name if ":" in name else _NAMESPACE + name] = shown if is_former else word
    # The game gives the entries of an older file their names of today.
    former, today = (_NAMESPACE + target_entry(each) for each in ("1.21.9", version))
    if former != today and former in statuses and (data_version or ASSUMED_DATA) <= DATA_OF_1_21_11:
        statuses.setdefault(today, statuses.pop(former))
    return statuses


def _of_profile(name: object, version: str) -> dict[str, str]:
    """Return what one of the game's own profiles means; ValueError if it has none of that name."""
    shown = _shown(version)
    if name == "default":
        return {_NAMESPACE + each: shown for each in DEFAULT_ENTRIES}
    if name == "performance":
        return {f"{_NAMESPACE}fps": _ALWAYS, **{_NAMESPACE + each: shown for each in PERFORMANCE_ENTRIES}}
    raise ValueError(f"it names a profile {name!r}, which the game hasn't")


def _shown(version: str) -> str:
    return _SHOWN if version_numbers(version) >= (1, 21, 11) else _SHOWN_TO_1_21_10
