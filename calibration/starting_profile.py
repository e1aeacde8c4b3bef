"""The profile that a calibration starts from: the existing one, or a new one in a folder that can be written to."""

import tempfile
from pathlib import Path

from mc_nested.errors import ProfileError
from mc_nested.live.profile.store import load_profile, profile_path
from mc_nested.live.profile.tables import Profile


def starting_profile(name_or_file: str | Path) -> tuple[Path, Profile]:
    """The profile's file and its contents. If the file doesn't exist, a new profile, not written yet.

    ProfileError if the existing file can't be used, or no file can be written there.
    """
    path = profile_path(name_or_file)
    check_writable(path)
    return path, load_profile(name_or_file) if path.is_file() else Profile()


def check_writable(path: Path) -> None:
    """ProfileError unless the file can be written. Creates its folder, and leaves nothing else behind."""
    if path.is_dir():
        raise ProfileError(f"{path}: is a folder: name the profile otherwise, with --profile")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise ProfileError(
            f"{path}: can't be written ({error.strerror or error}): mend its folder, or name another --profile"
        ) from error
