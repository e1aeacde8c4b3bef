"""A note beside a profile of a copy that the profile doesn't know yet: however a calibration ends, it can be undone.

mine.toml           the profile, written once all is good
mine.toml.ground    the profile as it would have the arena, written before anything is built; gone once mine.toml has it
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mc_nested.errors import McNestedError, ProfileError
from mc_nested.learn.whole_file import written_whole
from mc_nested.live.profile import Profile, parse_profile, profile_path, save_profile
from mc_nested.toml_file import read_toml_text


def note_path(profile: Path) -> Path:
    """Where the note of a profile's file lies."""
    return profile.with_name(f"{profile.name}.ground")


def noted_copy(profile: Path) -> Profile | None:
    """The profile, its arena's copy included, that the note says; None without one, ProfileError where it's broken."""
    file = note_path(profile)
    return parse_profile(read_toml_text(file, ProfileError), str(file)) if file.is_file() else None


def note_copy(known: Profile, profile: Path) -> None:
    """Write the note, whole, in the place of one that is there; ProfileError where the disk refuses."""
    file = note_path(profile)
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with written_whole(file) as unfinished:
            unfinished.unlink(missing_ok=True)
            save_profile(known, unfinished)
    except OSError as error:
        raise ProfileError(
            f"{file}: can't be written ({error}): nothing was built; make room, and try again"
        ) from error


def forget_copy(profile: Path) -> None:
    """Remove the note, if there is one; ProfileError where that fails."""
    try:
        note_path(profile).unlink(missing_ok=True)
    except OSError as error:
        raise ProfileError(f"{note_path(profile)}: can't be removed ({error}): remove it by hand") from error


def forget_known_copy(saved: Profile, profile: Path) -> None:
    """Remove the note if the profile that was saved says the same of its arena."""
    noted = noted_copy(profile)
    if noted is not None and noted.arena == saved.arena:
        forget_copy(profile)


def undo_command(profile: Path) -> str:
    """The command by which what stood there comes back."""
    name = profile.stem if profile == profile_path(profile.stem) else str(profile)
    quoted = f'"{name}"' if " " in name else name
    return f"mc-nested calibrate arena --undo --profile {quoted}"


@contextmanager
def saying_how_to_undo(profile: Path) -> Iterator[None]:
    """Where the block fails and leaves a note, the same error says also how to undo what was built."""
    try:
        yield
    except McNestedError as error:
        if not note_path(profile).is_file():
            raise
        raise type(error)(f"{error}; what stood where the arena is comes back with {undo_command(profile)}") from error
