"""Points to click that a calibration recorded, each recognised by a small picture of what was there.

A point is clicked only where its picture is seen, before the mouse goes there and once it is there; so nothing is
clicked on a screen that has changed, or on another one. The pattern is compared, not its brightness: a button is
brighter under the mouse, and its label greyer where it can't be pressed.

A profile's pictures are files: beside ``default.toml``, ``default-points/singleplayer.png``.
"""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from urllib.parse import quote

import cv2
import numpy as np

from mc_nested.errors import PictureError
from mc_nested.live.devices import Display, Frame
from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.timing import MENU_LOOK_S
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import decoded

WIDTH, HEIGHT = 96, 10
"""GUI pixels that a picture shows, around its point: a label's height and most of its length, and nothing outside any
button that is clicked (FACTS: Screens and their buttons)."""

LEAST_ALIKE = 0.8
"""The least correlation with its picture. The same button gave 0.97 under the mouse or not, and 0.88 greyed; another
button, or another screen, at most 0.32."""

MOST_OFF = 0.4
"""How far any pixel may differ from the picture's, as a part of the picture's range from dark to bright. Brightness and
contrast are taken out first. The same button gave 0.16, greyed 0.32; another letter gives about 1."""

SLACK = 2
"""Pixels that it may have moved by: a fraction of the window leads back to within one."""

_FLAT = 4.0
"""Grey levels: what varies less, such as a bare wall, could be anywhere."""


@dataclass(frozen=True)
class ClickPoint:
    """A named point, as fractions of the window, and the picture (height, width, 3) of what is around it."""

    name: str
    at: tuple[float, float]
    picture: Frame

    def position(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return where it is in a window of that width and height, in framebuffer pixels."""
        return min(round(self.at[0] * size[0]), size[0] - 1), min(round(self.at[1] * size[1]), size[1] - 1)


ClickPoints = Mapping[str, ClickPoint]
"""By their names."""


def record_point(name: str, frame: Frame, pixel: tuple[int, int], scale: int) -> ClickPoint:
    """Return a point at a pixel of a frame of the whole window, at that GUI scale."""
    (x, y), half_width, half_height = pixel, WIDTH * scale // 2, HEIGHT * scale // 2
    top, left = max(0, y - half_height), max(0, x - half_width)
    picture = frame[top : y + half_height, left : x + half_width].copy()
    height, width = frame.shape[:2]
    return ClickPoint(name, (round(x / width, 4), round(y / height, 4)), picture)


def has_pattern(picture: Frame) -> bool:
    """Return whether a picture shows anything that it could be recognised by."""
    return _varies(_grey(picture))


def looks_the_same(point: ClickPoint, frame: Frame) -> bool:
    """Return whether a frame of the whole window shows at the point what its picture shows."""
    wanted, part = _grey(point.picture), _grey(_part_around(point, frame))
    height, width = wanted.shape
    if part.shape[0] < height or part.shape[1] < width or not _varies(wanted):
        return False
    alike = cv2.matchTemplate(part, wanted, cv2.TM_CCOEFF_NORMED)
    y, x = (int(each) for each in np.unravel_index(int(alike.argmax()), alike.shape))
    seen = part[y : y + height, x : x + width]
    if not _varies(seen) or float(alike[y, x]) < LEAST_ALIKE:
        return False
    gain, offset = np.polyfit(seen.ravel().astype(float), wanted.ravel().astype(float), 1)
    return bool(np.abs(seen * gain + offset - wanted).max() <= MOST_OFF * np.ptp(wanted))


def hover_over(point: ClickPoint, controller: InputController, display: Display) -> bool:
    """Move the mouse to a point that looks like its picture, and look again; return whether it looked so both times.

    Nothing is pressed, and where it doesn't look like its picture at first, the mouse stays where it is.

    Raises what the input controller raises.
    """
    if not looks_the_same(point, display.grab()):
        return False
    controller.confirm_screen("menu")
    controller.hover(*point.position(display.size()))
    controller.wait(MENU_LOOK_S)
    return looks_the_same(point, display.grab())


def click_on(point: ClickPoint, controller: InputController, display: Display) -> bool:
    """Click on a point that looks like its picture before and under the mouse; return whether it did.

    Raise as above.
    """
    if not hover_over(point, controller, display):
        return False
    controller.confirm_screen("menu")
    controller.click_at(*point.position(display.size()))
    return True


def _part_around(point: ClickPoint, frame: Frame) -> Frame:
    """Return what a frame shows where the picture was taken, and a little around it."""
    size = (int(frame.shape[1]), int(frame.shape[0]))
    (x, y), (height, width) = point.position(size), point.picture.shape[:2]
    top, left = y - height // 2 - SLACK, x - width // 2 - SLACK
    return frame[max(0, top) : top + height + 2 * SLACK, max(0, left) : left + width + 2 * SLACK]


def _varies(grey: Frame) -> bool:
    return grey.size > 0 and float(grey.std()) >= _FLAT


def _grey(picture: Frame) -> Frame:
    """Return one channel of a picture."""
    return np.asarray(cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY), np.uint8) if picture.size else picture[..., 0]


def pictures_folder(profile: Path) -> Path:
    """Return the folder of the pictures that belong to the profile in that file."""
    return profile.with_name(f"{profile.stem}-points")


def picture_file(profile: Path, point: str) -> Path:
    """Return the file of a point's picture, directly in that folder, whatever letters the point's name has."""
    return pictures_folder(profile) / f"{quote(point, safe=' ')}.png"


def picture_bytes(picture: Frame) -> bytes:
    """Return a picture as a PNG file holds it."""
    return cv2.imencode(".png", picture)[1].tobytes()


def load_click_points(profile: Profile, path: Path) -> dict[str, ClickPoint]:
    """Return the points of the profile in the file ``path`` that have a picture: without one, none is ever clicked."""
    points = {}
    for name, at in profile.points.items():
        with suppress(OSError, PictureError):
            points[name] = ClickPoint(name, at, decoded(picture_file(path, name).read_bytes()))
    return points
