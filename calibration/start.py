"""What every calibration starts from: the profile as it is, or a new one, in a place that can be written to."""

import tempfile
from pathlib import Path

from mc_nested.errors import ProfileError
from mc_nested.live.profile import Profile, load_profile, profile_path


def profile_to_calibrate(name_or_file: str | Path) -> tuple[Path, Profile]:
    """The profile's file and what it says; a new profile, nothing written yet, where there is no such file.

    ProfileError where the file that is there can't be used, or none could be written there.
    """
    path = profile_path(name_or_file)
    check_writable(path)
    return path, load_profile(name_or_file) if path.is_file() else Profile()


def check_writable(path: Path) -> None:
    """ProfileError unless a file can be written there; its folder is made, and nothing else is left."""
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
