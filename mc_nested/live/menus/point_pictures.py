"""The pictures of a profile's points, as files: beside ``default.toml``, ``default-points/singleplayer.png``."""

from pathlib import Path
from urllib.parse import quote

import cv2
import numpy as np

from mc_nested.live.devices import Frame
from mc_nested.live.menus.click_points import ClickPoint
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import decoded


def pictures_folder(profile: Path) -> Path:
    """The folder of the pictures that belong to the profile in that file."""
    return profile.with_name(f"{profile.stem}-points")


def picture_file(profile: Path, point: str) -> Path:
    """The file of a point's picture; a name of any letters is one file, in that folder."""
    return pictures_folder(profile) / f"{quote(point, safe=' ')}.png"


def picture_bytes(picture: Frame) -> bytes:
    """A picture as a PNG file holds it."""
    return cv2.imencode(".png", picture)[1].tobytes()


def load_click_points(profile: Profile, path: Path) -> dict[str, ClickPoint]:
    """The points of the profile in the file ``path`` that have a picture: without one, none is ever clicked."""
    points = {}
    for name, at in profile.points.items():
        try:
            picture = decoded(picture_file(path, name).read_bytes(), cv2.IMREAD_COLOR)
        except OSError:
            continue
        if picture is not None:
            points[name] = ClickPoint(name, at, np.asarray(picture, np.uint8))
    return points
