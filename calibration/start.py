"""What every calibration starts from: the profile as it is, or a new one."""

from pathlib import Path

from mc_nested.live.profile import Profile, load_profile, profile_path


def profile_to_calibrate(name_or_file: str | Path) -> tuple[Path, Profile]:
    """The profile's file and what it says; a new profile, nothing written yet, where there is no such file.

    ProfileError where the file that is there can't be used.
    """
    path = profile_path(name_or_file)
    return path, load_profile(name_or_file) if path.is_file() else Profile()
