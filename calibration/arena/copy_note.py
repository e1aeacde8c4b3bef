"""A note beside a profile about an arena's copy that the profile doesn't have yet: any interrupted build can be undone.

mine.toml           the profile, written once all steps are done
mine.toml.ground    the profile with the new arena, written before anything is built; removed once mine.toml has it
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.errors import McNestedError, ProfileError
from mc_nested.live.profile.store import parse_profile, profile_path, save_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.toml_file import read_toml_text


def note_path(profile: Path) -> Path:
    """The file of the note beside a profile's file."""
    return profile.with_name(f"{profile.name}.ground")


def read_copy_note(profile: Path) -> Profile | None:
    """The profile in the note, including its arena's copy; None without a note, ProfileError if it is broken."""
    file = note_path(profile)
    return parse_profile(read_toml_text(file, ProfileError), str(file)) if file.is_file() else None


def write_copy_note(known: Profile, profile: Path) -> None:
    """Write the note atomically, replacing an old one. ProfileError if the disk refuses."""
    file = note_path(profile)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(file) as unfinished:
            unfinished.unlink(missing_ok=True)
            save_profile(known, unfinished)
    except OSError as error:
        raise ProfileError(
            f"{file}: can't be written ({error}): nothing was built; make room, and try again"
        ) from error


def remove_copy_note(profile: Path) -> None:
    """Remove the note, if there is one. ProfileError if that fails."""
    try:
        note_path(profile).unlink(missing_ok=True)
    except OSError as error:
        raise ProfileError(f"{note_path(profile)}: can't be removed ({error}): remove it by hand") from error


def remove_saved_copy_note(saved: Profile, profile: Path) -> None:
    """Remove the note if the saved profile has the same arena."""
    noted = read_copy_note(profile)
    if noted is not None and noted.arena == saved.arena:
        remove_copy_note(profile)


def undo_command(profile: Path) -> str:
    """The shell command that undoes the arena."""
    name = profile.stem if profile == profile_path(profile.stem) else str(profile)
    quoted = f'"{name}"' if " " in name else name
    return f"mc-nested calibrate arena --undo --profile {quoted}"


@contextmanager
def undo_hint_on_error(profile: Path) -> Iterator[None]:
    """If the block fails and a note is there, the error's message also says how to undo the arena."""
    try:
        yield
    except McNestedError as error:
        if not note_path(profile).is_file():
            raise
        raise type(error)(f"{error}; what stood where the arena is comes back with {undo_command(profile)}") from error
