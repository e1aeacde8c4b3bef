"""Readings of picture files, as ``mc-nested read`` prints them."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import cv2
import numpy as np

from mc_nested.errors import PictureError
from mc_nested.live.model.reading import XYZ, Reading, Target
from mc_nested.live.vision.debug_screen import nothing_seen, read_found
from mc_nested.live.vision.font import Font, decoded
from mc_nested.live.vision.layout import Overlay
from mc_nested.live.vision.overlay import find_debug_screen
from mc_nested.live.vision.whole_window import shows_more_than_window

_JPEG = b"\xff\xd8\xff"
"""How every JPEG file begins."""

_ALONE = "and the picture has to be of the game's window alone, as F2 takes it"
_MORE = "the picture shows more than the game's window: cut off the window's frame and the desktop, or take it with F2"


@dataclass(frozen=True)
class PictureReading:
    """What a picture file says, each with its meaning; None where it isn't there."""

    file: Annotated[Path, "the picture"]
    xyz: Annotated[XYZ | None, "position of the feet"]
    yaw: Annotated[float | None, "degrees"]
    pitch: Annotated[float | None, "degrees"]
    target: Annotated[Target | None, "id and pos of the block that is looked at"]
    problem: Annotated[str | None, "why it can't be read"]


def read_picture(path: Path, font: Font, overlay: Overlay | None = None) -> PictureReading:
    """A picture file's reading.

    Without ``overlay`` the GUI scale, the colour and the layout are found. PictureError for a file that is no picture.
    """
    reading = _read(path, font, overlay)
    return PictureReading(path, reading.xyz, reading.yaw, reading.pitch, reading.target, reading.problem)


def _read(path: Path, font: Font, overlay: Overlay | None) -> Reading:
    try:
        data = path.read_bytes()
    except OSError as error:
        raise PictureError(
            f"{path} can't be read ({error.strerror or error}): give a picture of the game's window"
        ) from error
    picture = decoded(data, cv2.IMREAD_COLOR)
    if picture is None:
        raise PictureError(f"{path} is not a picture: give a PNG of the game's window, as F2 takes it")
    found = find_debug_screen(np.asarray(picture, np.uint8), font, overlay)
    if found is None:
        reading = Reading(problem=f"{nothing_seen(overlay).problem}; {_ALONE}")
    else:
        reading = read_found(found, font)
        is_blurred = data.startswith(_JPEG)
        if reading.problem is not None and not is_blurred and shows_more_than_window(found, font):
            reading = Reading(problem=_MORE)  # whatever else is said of it would mislead
    if reading.problem is not None and data.startswith(_JPEG):
        return Reading(
            problem=f"a JPEG blurs the text: give a PNG of the game's window, as F2 takes it; {reading.problem}"
        )
    return reading
