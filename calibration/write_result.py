"""Writes a step's result: the pictures of its click points, then the profile. Each write is atomic."""

from pathlib import Path

import cv2

from calibration.context import StepResult
from mc_nested.atomic_file import atomic_write
from mc_nested.errors import ProfileError
from mc_nested.live.devices import Frame
from mc_nested.live.menus.point_pictures import picture_bytes, picture_file
from mc_nested.live.profile.store import save_profile


def write_result(result: StepResult, path: Path) -> None:
    """Write the profile's file, and beside it the pictures of the recorded click points.

    The pictures are written first: a point whose picture is newer than the point is not clicked, like a point without a
    picture. ProfileError if the disk refuses.
    """
    for point in result.points:
        write_picture(point.picture, picture_file(path, point.name))
    save_profile(result.profile, path)


def write_picture(frame: Frame, file: Path) -> None:
    """Write a picture (height, width, 3), and create its folder if needed. ProfileError if the disk refuses."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with atomic_write(file) as unfinished:
            unfinished.write_bytes(picture_bytes(frame))
    except (OSError, cv2.error) as error:
        raise ProfileError(f"{file}: the picture can't be written ({error}): make room, or mend its folder") from error
