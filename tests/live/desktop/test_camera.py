"""Pictures of the desktop: as a made-up mss gives them, and of a real window under Xvfb."""

from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from mss.exception import ScreenShotError

from mc_nested.errors import DesktopError
from mc_nested.live.desktop import camera
from mc_nested.live.desktop.camera import open_camera
from mc_nested.live.desktop.window import ClientArea
from tests.live.desktop.probed import probed


class Shots:
    """A desktop whose pixels say where they are; blue is the column, green the row."""

    def __init__(self) -> None:
        self.is_open = True

    def grab(self, bounds: dict[str, int]) -> Any:
        assert self.is_open
        left, top, width, height = (bounds[name] for name in ("left", "top", "width", "height"))
        if left < 0:
            raise ScreenShotError("XGetImage() failed")
        rows, columns = np.mgrid[top : top + height, left : left + width]
        pixels = np.stack([columns, rows, 0 * rows + 7, 0 * rows + 255], axis=2).astype(np.uint8)
        return SimpleNamespace(raw=bytearray(pixels.tobytes()), width=width, height=height)


@pytest.fixture
def shots(monkeypatch: pytest.MonkeyPatch) -> Shots:
    shots = Shots()

    @contextmanager
    def opened() -> Iterator[Shots]:
        yield shots
        shots.is_open = False

    monkeypatch.setattr(camera, "mss", SimpleNamespace(MSS=opened))
    return shots


def test_a_picture_is_blue_green_red_without_the_fourth_channel(shots: Shots) -> None:
    with open_camera() as picture:
        frame = picture(ClientArea(20, 50, 4, 3))
    assert frame.shape == (3, 4, 3)
    assert frame.dtype == np.uint8
    assert frame[0, 0].tolist() == [20, 50, 7]
    assert frame[2, 3].tolist() == [23, 52, 7]
    assert not shots.is_open


def test_an_area_that_is_not_all_on_the_screen_is_an_error(shots: Shots) -> None:
    with open_camera() as picture, pytest.raises(DesktopError, match="all of it is on the screen"):
        picture(ClientArea(-1, 0, 4, 3))
    assert not shots.is_open


@pytest.mark.standin
def test_a_real_window_is_pictured_wherever_it_is(x_server: dict[str, str]) -> None:
    report = probed(x_server, "camera")
    red, blue = [0x10, 0x20, 0xFF], [0xFF, 0x20, 0x10]
    assert report["shape"] == [240, 320, 3]
    assert report["corners"] == [red, red, blue, blue]
    assert report["seam"] == [[red, blue]]
    assert report["moved"] == [red, blue]
    assert "all of it is on the screen" in report["off the screen"]
