"""The camera: pictures of the desktop through mss, and the monitors that it lists."""

import importlib
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import cv2
import mss
import numpy as np
from mss.exception import ScreenShotError

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.display import Camera
from mc_nested.live.desktop.window import is_within
from mc_nested.live.devices import DesktopArea, Frame


@contextmanager
def open_camera(screen: Callable[[], DesktopArea] | None = None) -> Iterator[Camera]:
    """Yield a camera over all screens; a picture raises DesktopError where a part of its area is on no screen.

    Args:
        screen: gives the area of all screens together, where pictures of anything else come without an error, as on
            Windows; default: this system's.
    """
    if sys.platform == "darwin":
        picture_every_pixel(importlib.import_module("mss.darwin"))
    if sys.platform == "win32":
        from mc_nested.live.desktop.win32 import virtual_screen

        screen = screen or virtual_screen
    with mss.MSS() as shots:

        def picture(area: DesktopArea) -> Frame:
            if screen is not None and not is_within(area, screen()):
                raise _off_the_screen()
            bounds = {"left": area.left, "top": area.top, "width": area.width, "height": area.height}
            try:
                shot = shots.grab(bounds)
            except ScreenShotError as error:
                raise _off_the_screen() from error
            pixels = np.frombuffer(shot.raw, np.uint8).reshape(shot.height, shot.width, 4)
            return np.asarray(cv2.cvtColor(pixels, cv2.COLOR_BGRA2BGR), np.uint8)

        yield picture


def picture_every_pixel(mss_darwin: Any) -> None:
    """Let mss picture a Retina screen at its own size; by itself it takes one pixel a point, too few to read text by.

    Args:
        mss_darwin: the module mss.darwin, which reads its options at each picture.
    """
    mss_darwin.IMAGE_OPTIONS &= ~mss_darwin.kCGWindowImageNominalResolution


def _off_the_screen() -> DesktopError:
    return DesktopError("the game's window can't be pictured: move it so that all of it is on the screen")


def monitors() -> tuple[DesktopArea, ...]:
    """Return where each monitor is on the desktop; none where the system names none. It needs a display."""
    try:
        with mss.MSS() as shots:
            each_alone = shots.monitors[1:]  # the first is all of them together
    except ScreenShotError:
        return ()
    return tuple(DesktopArea(each["left"], each["top"], each["width"], each["height"]) for each in each_alone)
