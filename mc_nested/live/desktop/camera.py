"""The camera: pictures of the desktop through mss."""

from collections.abc import Iterator
from contextlib import contextmanager

import cv2
import mss
import numpy as np
from mss.exception import ScreenShotError

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.display import Camera
from mc_nested.live.desktop.window import ClientArea
from mc_nested.live.devices import Frame


@contextmanager
def open_camera() -> Iterator[Camera]:
    """A camera over all screens; a picture raises DesktopError where a part of its area is on no screen."""
    with mss.MSS() as shots:

        def picture(area: ClientArea) -> Frame:
            bounds = {"left": area.left, "top": area.top, "width": area.width, "height": area.height}
            try:
                shot = shots.grab(bounds)
            except ScreenShotError as error:
                raise DesktopError(
                    "the game's window can't be pictured: move it so that all of it is on the screen"
                ) from error
            pixels = np.frombuffer(shot.raw, np.uint8).reshape(shot.height, shot.width, 4)
            return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGRA2BGR), np.uint8)

        yield picture
