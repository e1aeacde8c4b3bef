"""Profile: what is known of one user's game and screen, as a commented TOML file that calibration writes.

A key that is left out takes its default, or is found on the screen. Profiles are found by name, read with one-line
errors, and written without losing a user's comments.
"""

import itertools
import json
import os
import shutil
import tempfile
from pathlib import Path
from typing import Any

import platformdirs
import tomlkit
from pydantic import BaseModel, Field
from tomlkit.items import Table

from mc_nested.errors import ProfileError
from mc_nested.live.profile_tables import (
    FORMAT,
    Arena,
    Blocks,
    Body,
    Calibrated,
    Fraction,
    GameVersion,
    Input,
    Keys,
    ProfileTable,
    Screen,
    Walk,
    Window,
    World,
)
from mc_nested.toml_file import parse_document, parse_toml, read_toml_text, table_of_key


class Profile(ProfileTable):
    """A user's calibrated facts, table by table as in the file."""

    window: Window = Window()
    game: GameVersion = GameVersion()
    keys: Keys = Keys()
    screen: Screen = Screen()
    arena: Arena | None = None
    world: World | None = None
    blocks: Blocks = Blocks()
    input: Input = Input()
    body: Body = Body()
    walk: Walk = Walk()
    points: dict[str, tuple[Fraction, Fraction]] = Field(
        default_factory=dict,
        description="places to click, as fractions of the window's size; their pictures lie beside this file",
    )
    calibrated: Calibrated | None = None

    def marked_arena(self) -> Arena:
        """The arena; ProfileError where none is marked yet."""
        if self.arena is None:
            raise ProfileError("the profile has no arena: stand where it shall be and run mc-nested calibrate arena")
        return self.arena

    def block_name(self, block: str) -> str:
        """This game's name, without namespace, of a scenario's block (a name of Minecraft 1.13 and later)."""
        older = {"oak_planks": "planks"} if self.game.dialect == "1.12" else {}
        return self.blocks.names.get(block, older.get(block, block))

    def shown_id(self, block: str) -> str:
        """What the debug screen shows for a scenario's block."""
        return self.blocks.shown_prefix + self.block_name(block)


def profile_folder() -> Path:
    """Where a user's named profiles lie, on each system in its own place."""
    return platformdirs.user_config_path("mc-nested", appauthor=False) / "profiles"


def profile_path(name_or_file: str | Path) -> Path:
    """The file of a profile: a name lies in the profile folder; whatever ends in .toml is a path.

    ProfileError where it is no name at all.
    """
    path = Path(name_or_file)
    if not path.name.strip():
        raise ProfileError(f"{str(name_or_file)!r} names no profile: give a name, or a file that ends in .toml")
    return path.expanduser() if path.suffix == ".toml" else profile_folder() / f"{path}.toml"


def load_profile(name_or_file: str | Path) -> Profile:
    """The profile of that name or in that file; ProfileError, one line, where it can't be used."""
    path = profile_path(name_or_file)
    if not path.is_file():
        known = ", ".join(sorted(file.stem for file in profile_folder().glob("*.toml"))) or "none yet"
        raise ProfileError(
            f"no profile {str(name_or_file)!r}: looked for {path}; known are: {known}; "
            "mc-nested calibrate all makes one"
        )
    return parse_profile(read_toml_text(path, ProfileError), str(path))


def parse_profile(text: str, source: str) -> Profile:
    """The profile that a TOML text describes; ``source`` names it in errors."""
    _check_format(parse_document(text, source, ProfileError).unwrap(), source)
    return parse_toml(Profile, text, source, ProfileError)


def save_profile(profile: Profile, path: Path) -> None:
    """Write the profile whole or not at all, keeping the comments and the order of a file that is there.

    What is replaced, if it was a profile and says something else, stays beside it (``earlier_path``).

    ProfileError where the file that is there isn't TOML or can't be written; it is left as it is then.
    """
    known = read_toml_text(path, ProfileError) if path.exists() else ""
    document = parse_document(known, str(path), ProfileError)
    _merge(document, json.loads(profile.model_dump_json()), Profile)
    text = tomlkit.dumps(document)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if text != known and path.exists() and _is_profile(known):
            _replace(earlier_path(path), known)
        _replace(path, text)
    except OSError as error:
        raise ProfileError(f"{path}: can't be written ({error}): choose another file") from error


def earlier_path(path: Path) -> Path:
    """Where the profile lies that the one in ``path`` took the place of."""
    return path.with_name(f"{path.name}.before")


def undo_profile(path: Path) -> Path | None:
    """Put the earlier profile back, and the one in its place where that was: undone twice, both are as before.

    What stood in its place and is no profile that can be read is kept in a new file beside it, whose path is returned;
    the earlier profile then stays where it is too.

    ProfileError where there is no earlier one that can be used, or a file can't be written; nothing is lost then.
    """
    earlier = earlier_path(path)
    if not earlier.is_file():
        raise ProfileError(f"{path}: there is no earlier profile ({earlier.name}): calibrate again instead")
    text = read_toml_text(earlier, ProfileError)
    parse_profile(text, str(earlier))
    broken = None
    try:
        if path.exists() and _holds_profile(path):
            _replace(beside := path.with_name(f"{path.name}.undone"), path.read_text("utf-8-sig"))
            _replace(path, text)
            beside.replace(earlier)
        else:
            broken = _kept_beside(path) if path.exists() else None
            _replace(path, text)
    except OSError as error:
        raise ProfileError(f"{path}: can't be written ({error}): make room, and try again") from error
    return broken


def _check_format(tables: dict[str, Any], source: str) -> None:
    """ProfileError where another version of this program wrote it: before its keys are found to be wrong ones."""
    calibrated = tables.get("calibrated")
    written = calibrated.get("format") if isinstance(calibrated, dict) else None
    if isinstance(written, int) and written != FORMAT:
        which, remedy = ("newer", "update mc-nested") if written > FORMAT else ("older", "keep it for that version")
        raise ProfileError(
            f"{source}: a profile of format {written}, by {which} mc-nested, and this one knows format {FORMAT}: "
            f"{remedy}, or make a new one with mc-nested calibrate all --profile another-name"
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


def _kept_beside(path: Path) -> Path:
    """A new file beside it that holds the same, byte for byte; no other is overwritten."""
    names = (f"{path.name}.broken{number or ''}" for number in itertools.count())
    broken = next(each for each in map(path.with_name, names) if not each.exists())
    shutil.copyfile(path, broken)
    return broken


def _replace(path: Path, text: str) -> None:
    handle, beside = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=".part")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        Path(beside).replace(path)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise


def _merge(table: tomlkit.TOMLDocument | Table, values: dict[str, Any], kind: type[BaseModel] | None) -> None:
    """Make a TOML table say what ``values`` say, None being left out, and touch nothing that says it already."""
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
    """What a key is for, as the comment above it says."""
    if kind is None:
        return ""
    inner = table_of_key(kind, key)
    description = kind.model_fields[key].description
    return (inner.__doc__ or "").rstrip(".") if inner and not description else description or ""
