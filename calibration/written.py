"""What a step found, written: the pictures of its points, then the profile. Each file is the old one or the new one."""

from pathlib import Path

import cv2

from calibration.step import Found
from mc_nested.errors import ProfileError
from mc_nested.learn.whole_file import written_whole
from mc_nested.live.devices import Frame
from mc_nested.live.point_pictures import picture_bytes, picture_file
from mc_nested.live.profile import save_profile


def write_found(found: Found, path: Path) -> None:
    """Write what was found to the profile's file, and beside it the pictures of the points that were recorded.

    The pictures come first: a point whose picture is newer than itself is clicked nowhere, as one without a picture.
    ProfileError where the disk refuses.
    """
    for point in found.points:
        write_picture(point.picture, picture_file(path, point.name))
    save_profile(found.profile, path)


def write_picture(frame: Frame, file: Path) -> None:
    """Write a picture (height, width, 3), and its folder where there is none; ProfileError where the disk refuses."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with written_whole(file) as unfinished:
            unfinished.write_bytes(picture_bytes(frame))
    except (OSError, cv2.error) as error:
        raise ProfileError(f"{file}: the picture can't be written ({error}): make room, or mend its folder") from error
