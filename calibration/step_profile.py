"""The profile that a step starts from, an earlier one or a new one, and what it leaves: a profile and pictures.

Each write is atomic.
"""

import tempfile
from collections.abc import Callable
from pathlib import Path

import cv2

from calibration.context import StepResult
from calibration.report.findings import save_findings_or_warn
from mc_nested.atomic_file import atomic_write, refused_as
from mc_nested.errors import ProfileError
from mc_nested.live.devices import Frame
from mc_nested.live.menus.click_points import picture_bytes, picture_file
from mc_nested.live.profile.store import load_profile, profile_path, save_profile
from mc_nested.live.profile.tables import Profile


def starting_profile(name_or_file: str | Path) -> tuple[Path, Profile]:
    """Return the profile's file and its contents. If the file doesn't exist, a new profile, not written yet.

    ProfileError if the existing file can't be used, or no file can be written there.
    """
    path = profile_path(name_or_file)
    check_writable(path)
    return path, load_profile(name_or_file) if path.is_file() else Profile()


def check_writable(path: Path) -> None:
    """Raise ProfileError unless the file can be written. Its folder is created; nothing else is left behind."""
    if path.is_dir():
        raise ProfileError(f"{path}: is a folder: name the profile otherwise, with --profile")
    with refused_as(ProfileError, path, "mend its folder, or name another --profile"):
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path.parent):
            pass


def write_result(result: StepResult, path: Path) -> None:
    """Write the profile's file, and beside it the pictures of the recorded click points.

    The pictures are written first: a point whose picture is newer than the point is not clicked, like a point without a
    picture. ProfileError if the disk refuses.
    """
    for point in result.points:
        write_picture(point.picture, picture_file(path, point.name))
    save_profile(result.profile, path)


def keep_result(result: StepResult, path: Path, picture: Path, say: Callable[[str], None]) -> tuple[StepResult, Path]:
    """Write the profile's file, the step's first picture, and what the report needs; return the result and the picture.

    ProfileError as for ``write_result`` and ``write_picture``; for want of a report there is only a warning.
    """
    write_result(result, path)
    save_findings_or_warn(say, path, [result])
    write_picture(result.pictures[0].frame, picture)
    return result, picture


def write_picture(frame: Frame, file: Path) -> None:
    """Write a picture (height, width, 3), and create its folder if needed. ProfileError if the disk refuses."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(file) as unfinished:
            unfinished.write_bytes(picture_bytes(frame))
    except (OSError, cv2.error) as error:
        raise ProfileError(f"{file}: the picture can't be written ({error}): make room, or mend its folder") from error
