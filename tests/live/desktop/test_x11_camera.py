"""Pictures of one window, with the X server's answers made up; test_xwayland.py has a real one."""

import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import pytest

from mc_nested.errors import DesktopError

if not sys.platform.startswith("linux"):
    pytest.skip("windows of an X server", allow_module_level=True)

from Xlib.error import BadDrawable, BadMatch

from mc_nested.live.desktop.x11_camera import BAND_BYTES, WindowCamera
from mc_nested.live.devices import DesktopArea

if TYPE_CHECKING:
    from Xlib.display import Display
    from Xlib.xobject.drawable import Window

Part = tuple[int, int, int, int]


class FakeDrawable:
    """A window or a pixmap, of which each picture is asked for by its left, top, width and height."""

    def __init__(self, pixels: Any) -> None:
        self.pixels = pixels
        self.asked: list[Part] = []
        self.depth = 24
        self.error: Exception | None = None
        self.is_free = False

    def get_geometry(self) -> Any:
        return SimpleNamespace(width=self.pixels.shape[1], height=self.pixels.shape[0], depth=self.depth)

    def get_image(self, left: int, top: int, width: int, height: int, *_: int) -> Any:
        if self.error:
            raise self.error
        self.asked.append((left, top, width, height))
        return SimpleNamespace(data=self.pixels[top : top + height, left : left + width].tobytes())

    def create_gc(self, **_: object) -> Any:
        return SimpleNamespace(free=lambda: None)

    def copy_area(
        self, _: object, source: Any, left: int, top: int, width: int, height: int, *to: int, onerror: Any
    ) -> None:
        assert to == (0, 0)
        if source.error:
            onerror(source.error, None)
        else:
            self.pixels[:] = source.pixels[top : top + height, left : left + width]

    def free(self) -> None:
        self.is_free = True


class Server:
    """An X server without a screen's picture: its window is at 60, 40, and its pixels say where they are."""

    def __init__(self, width: int = 320, height: int = 240) -> None:
        rows, columns = np.mgrid[0:height, 0:width]
        pixels = np.stack([columns % 256, rows % 256, 0 * rows + 7, 0 * rows + 255], axis=2).astype(np.uint8)
        self.window = FakeDrawable(pixels)
        self.copies: list[FakeDrawable] = []

    def screen(self) -> Any:
        return SimpleNamespace(root=self)

    def translate_coords(self, *_: object) -> Any:
        return SimpleNamespace(x=60, y=40)

    def create_pixmap(self, width: int, height: int, depth: int) -> FakeDrawable:
        assert depth == self.window.depth
        self.copies.append(FakeDrawable(np.zeros((height, width, 4), np.uint8)))
        return self.copies[-1]

    def camera(self) -> WindowCamera:
        return WindowCamera(cast("Display", self), cast("Window", self.window))


def test_a_part_of_the_desktop_is_that_part_of_the_window() -> None:
    server = Server()
    frame = server.camera()(DesktopArea(60 + 20, 40 + 50, 4, 3))
    assert frame.shape == (3, 4, 3)
    assert frame.dtype == np.uint8
    assert frame[0, 0].tolist() == [20, 50, 7]
    assert frame[2, 3].tolist() == [23, 52, 7]
    assert not server.copies


def test_a_large_picture_is_copied_once_and_fetched_in_bands() -> None:
    server = Server(1280, 720)
    frame = server.camera()(DesktopArea(60, 40, 1280, 720))
    assert np.array_equal(frame, server.window.pixels[:, :, :3])
    (copy,) = server.copies
    assert not server.window.asked  # what it shows may change between two bands
    assert len(copy.asked) > 1
    assert all(width * height * 4 <= BAND_BYTES for _, _, width, height in copy.asked)
    assert copy.is_free


@pytest.mark.parametrize("area", [(59, 40, 9, 9), (60, 39, 9, 9), (372, 40, 9, 9), (60, 272, 9, 9)])
def test_nothing_outside_the_window_is_pictured(area: Part) -> None:
    with pytest.raises(DesktopError, match="hidden or resized"):
        Server().camera()(DesktopArea(*area))


def test_a_window_that_is_hidden_meanwhile_is_an_error() -> None:
    server = Server()
    server.window.error = BadMatch(cast("Any", None), b"\0" * 32)
    with pytest.raises(DesktopError, match="hidden or resized"):
        server.camera()(DesktopArea(60, 40, 4, 3))


def test_a_window_that_closes_before_it_is_copied_is_the_x_servers_error() -> None:
    server = Server(1280, 720)
    server.window.error = BadDrawable(cast("Any", SimpleNamespace(get_resource_class=lambda _: None)), b"\0" * 32)
    with pytest.raises(BadDrawable):
        server.camera()(DesktopArea(60, 40, 1280, 720))
    assert server.copies[0].is_free


def test_other_colours_than_eight_bits_each_are_refused() -> None:
    server = Server()
    server.window.depth = 16
    with pytest.raises(DesktopError, match="colours of 16 bits"):
        server.camera()(DesktopArea(60, 40, 4, 3))
