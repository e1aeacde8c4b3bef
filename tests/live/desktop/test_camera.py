"""Pictures of the desktop: as a made-up mss gives them, and of a real window under Xvfb.

Where the monitors are: as a made-up mss lists them, and on a real X server with two.
"""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from mss.exception import ScreenShotError

from mc_nested.errors import DesktopError
from mc_nested.live.desktop import camera
from mc_nested.live.desktop import camera as module
from mc_nested.live.desktop.camera import monitors, open_camera, picture_every_pixel
from mc_nested.live.devices import DesktopArea
from scripts.window_display import XRANDR
from tests.live.desktop.real_windows.probed import probed


class Shots:
    """A desktop whose pixels say where they are; blue is the column, green the row."""

    def __init__(self) -> None:
        self.is_open = True
        self.grabbed = 0

    def grab(self, bounds: dict[str, int]) -> Any:
        assert self.is_open
        self.grabbed += 1
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
        frame = picture(DesktopArea(20, 50, 4, 3))
    assert frame.shape == (3, 4, 3)
    assert frame.dtype == np.uint8
    assert frame[0, 0].tolist() == [20, 50, 7]
    assert frame[2, 3].tolist() == [23, 52, 7]
    assert not shots.is_open


def test_picturing_an_area_partly_off_the_screen_is_an_error(shots: Shots) -> None:
    with open_camera() as picture, pytest.raises(DesktopError, match="all of it is on the screen"):
        picture(DesktopArea(-1, 0, 4, 3))
    assert not shots.is_open


@pytest.mark.parametrize("area", [DesktopArea(-1, 0, 4, 3), DesktopArea(97, 0, 4, 3), DesktopArea(0, 58, 4, 3)])
def test_an_area_partly_outside_the_given_screens_is_refused_before_a_picture_is_taken(
    area: DesktopArea, shots: Shots
) -> None:
    with open_camera(lambda: DesktopArea(0, 0, 100, 60)) as picture:
        with pytest.raises(DesktopError, match="all of it is on the screen"):
            picture(area)
        assert picture(DesktopArea(96, 57, 4, 3)).shape == (3, 4, 3)
    assert shots.grabbed == 1


def test_the_screens_area_is_asked_for_again_at_each_picture(shots: Shots) -> None:
    screens = [DesktopArea(0, 0, 100, 60), DesktopArea(20, 0, 100, 60)]
    with open_camera(lambda: screens.pop(0)) as picture:
        picture(DesktopArea(0, 0, 4, 3))
        with pytest.raises(DesktopError, match="all of it is on the screen"):
            picture(DesktopArea(0, 0, 4, 3))
    assert shots.grabbed == 1


def test_on_a_retina_screen_every_pixel_is_pictured_and_the_other_options_stay() -> None:
    framing, opaque, nominal = 1 << 0, 1 << 1, 1 << 4
    module = SimpleNamespace(IMAGE_OPTIONS=framing | opaque | nominal, kCGWindowImageNominalResolution=nominal)
    for _ in range(2):
        picture_every_pixel(module)
        assert framing | opaque == module.IMAGE_OPTIONS


@pytest.mark.standin
def test_a_real_window_is_pictured_wherever_it_is(x_server: dict[str, str]) -> None:
    report = probed(x_server, "camera")
    red, blue = [0x10, 0x20, 0xFF], [0xFF, 0x20, 0x10]
    assert report["shape"] == [240, 320, 3]
    assert report["corners"] == [red, red, blue, blue]
    assert report["seam"] == [[red, blue]]
    assert report["moved"] == [red, blue]
    assert "all of it is on the screen" in report["off the screen"]


ALL = {"left": -1920, "top": 0, "width": 3200, "height": 1080}
LEFT = {"left": -1920, "top": 0, "width": 1920, "height": 1080, "is_primary": False, "name": "a maker's name"}
RIGHT = {"left": 0, "top": 56, "width": 1280, "height": 1024, "is_primary": True}

PRINTS = "from mc_nested.live.desktop.camera import monitors; print(monitors())"


def test_monitors_lists_each_monitor_and_leaves_out_the_area_of_all_together(monkeypatch: pytest.MonkeyPatch) -> None:
    @contextmanager
    def opened() -> Iterator[SimpleNamespace]:
        yield SimpleNamespace(monitors=[ALL, LEFT, RIGHT])

    monkeypatch.setattr(module, "mss", SimpleNamespace(MSS=opened))
    assert monitors() == (DesktopArea(-1920, 0, 1920, 1080), DesktopArea(0, 56, 1280, 1024))


def test_no_monitors_are_listed_where_the_system_reports_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> None:
        raise ScreenShotError("no RandR")

    monkeypatch.setattr(module, "mss", SimpleNamespace(MSS=refuse))
    assert monitors() == ()


@pytest.mark.window
def test_a_real_display_lists_its_monitor_and_then_the_two_it_is_split_into(display: dict[str, str]) -> None:
    def listed() -> str:
        return subprocess.run(
            [sys.executable, "-c", PRINTS], env=display, capture_output=True, text=True, check=True
        ).stdout

    def add(name: str, place: str, output: str) -> None:
        subprocess.run([XRANDR.required(), "--setmonitor", name, place, output], env=display, check=True)

    assert listed() == f"({DesktopArea(0, 0, 1400, 1000)},)\n"
    add("left", "800/200x1000/250+0+0", "screen")
    add("right", "600/150x900/225+800+100", "none")
    assert listed() == f"{(DesktopArea(0, 0, 800, 1000), DesktopArea(800, 100, 600, 900))}\n"
