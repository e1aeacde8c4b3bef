"""Profiles on disk: found by name, read with one-line errors, written without losing a user's comments."""

import itertools
import json
import shutil
from pathlib import Path
from typing import Any

import tomlkit
from pydantic import BaseModel
from tomlkit.items import Table

from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import ProfileError
from mc_nested.live.profile.folder import profile_folder
from mc_nested.live.profile.tables import FORMAT, Profile
from mc_nested.toml_file import parse_document, parse_toml, read_toml_text, table_of_key


def profile_path(name_or_file: str | Path) -> Path:
    """Return the file of a profile: what ends in .toml is a path, any other name lies in the profile folder.

    Raise ProfileError if the name is empty.
    """
    path = Path(name_or_file)
    if not path.name.strip():
        raise ProfileError(f"{str(name_or_file)!r} names no profile: give a name, or a file that ends in .toml")
    return path.expanduser() if path.suffix == ".toml" else profile_folder() / f"{path}.toml"


def load_profile(name_or_file: str | Path) -> Profile:
    """Return the profile of that name or in that file; raise ProfileError, one line, if it can't be used."""
    path = profile_path(name_or_file)
    if not path.is_file():
        known = ", ".join(sorted(file.stem for file in profile_folder().glob("*.toml"))) or "none yet"
        raise ProfileError(
            f"no profile {str(name_or_file)!r}: looked for {path}; known are: {known}; "
            "mc-nested calibrate all makes one"
        )
    return parse_profile(read_toml_text(path, ProfileError), str(path))


def parse_profile(text: str, source: str) -> Profile:
    """Return the profile in a TOML text; ``source`` names it in errors."""
    _check_format(parse_document(text, source, ProfileError).unwrap(), source)
    return parse_toml(Profile, text, source, ProfileError)


def save_profile(profile: Profile, path: Path) -> None:
    """Write the profile whole or not at all, keeping the comments and the order of the file it replaces.

    A replaced profile that says something else is kept beside it (``earlier_path``).

    Raise ProfileError if the file there isn't TOML or can't be written; it is left unchanged then.
    """
    known = read_toml_text(path, ProfileError) if path.exists() else ""
    document = parse_document(known, str(path), ProfileError)
    _merge(document, json.loads(profile.model_dump_json()), Profile)
    text = tomlkit.dumps(document)
    with refused_as(ProfileError, path, "choose another file"):
        path.parent.mkdir(parents=True, exist_ok=True)
        if text != known and path.exists() and _is_profile(known):
            _replace(earlier_path(path), known)
        _replace(path, text)


def earlier_path(path: Path) -> Path:
    """Return where the profile is kept that the one in ``path`` replaced."""
    return path.with_name(f"{path.name}.before")


def undo_profile(path: Path) -> Path | None:
    """Swap a profile with the earlier one: undone twice, both are as before.

    A file that can't be read as a profile is kept as a new file beside it, whose path is returned. The earlier profile
    then stays where it is too.

    Raise ProfileError if there is no earlier profile that can be used, or a file can't be written; nothing is lost
    then.
    """
    earlier = earlier_path(path)
    if not earlier.is_file():
        raise ProfileError(f"{path}: there is no earlier profile ({earlier.name}): calibrate again instead")
    text = read_toml_text(earlier, ProfileError)
    parse_profile(text, str(earlier))
    broken = None
    with refused_as(ProfileError, path, "make room, and try again"):
        if path.exists() and _holds_profile(path):
            _replace(beside := path.with_name(f"{path.name}.undone"), path.read_text("utf-8-sig"))
            _replace(path, text)
            beside.replace(earlier)
        else:
            broken = _keep_broken(path) if path.exists() else None
            _replace(path, text)
    return broken


def _check_format(tables: dict[str, Any], source: str) -> None:
    """Raise ProfileError if another version of this program wrote it, before its keys are reported as unknown."""
    calibrated = tables.get("calibrated")
    written = calibrated.get("format") if isinstance(calibrated, dict) else None
    if isinstance(written, int) and written != FORMAT:
        raise ProfileError(
            f"{source}: a profile of format {written}, by another version of mc-nested, and this one knows format "
            f"{FORMAT}: update mc-nested, or make a new one with mc-nested calibrate all --profile another-name"
        )


def _is_profile(text: str) -> bool:
    try:
        parse_profile(text, "")
    except ProfileError:
        return False
    return True


def _holds_profile(path: Path) -> bool:
    try:
        return _is_profile(read_toml_text(path, ProfileError))
    except ProfileError:
        return False


def _keep_broken(path: Path) -> Path:
    """Copy a file, byte for byte, to a new one beside it; no file is overwritten."""
    names = (f"{path.name}.broken{number or ''}" for number in itertools.count())
    broken = next(each for each in map(path.with_name, names) if not each.exists())
    shutil.copyfile(path, broken)
    return broken


def _replace(path: Path, text: str) -> None:
    with atomic_write(path) as unfinished:
        unfinished.write_text(text, encoding="utf-8", newline="\n")


def _merge(table: tomlkit.TOMLDocument | Table, values: dict[str, Any], kind: type[BaseModel] | None) -> None:
    """Write ``values`` into a TOML table, without those that are None; leave equal ones untouched."""
    for key in [key for key in table if values.get(key) is None]:
        table.remove(key)
    for key, value in values.items():
        note = _meaning(kind, key)
        if isinstance(value, dict):
            if value and not isinstance(table.get(key), Table):
                table[key] = tomlkit.table().comment(note)
            inner = table.get(key)
            if isinstance(inner, Table):
                _merge(inner, value, table_of_key(kind, key) if kind else None)
        elif key not in table:
            if note and note not in table.as_string():
                table.add(tomlkit.comment(note if value is not None else f"{key}: {note}"))
            if value is not None:
                table.add(key, value)
        elif tomlkit.item(table[key]).unwrap() != value:
            table[key] = value


def _meaning(kind: type[BaseModel] | None, key: str) -> str:
    """Return what a key is for: the comment above it in the file."""
    if kind is None:
        return ""
    description = kind.model_fields[key].description
    inner = table_of_key(kind, key)
    if description or inner is None:
        return description or ""
    return (inner.__doc__ or "").rstrip(".")
