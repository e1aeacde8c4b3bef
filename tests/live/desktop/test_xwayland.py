"""The X server of a Wayland session, in which a real window is pictured and driven; and what its errors say.

Pictures of one window, with the X server's answers made up; test_xwayland.py has a real one.
"""

import json
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, cast

import numpy as np
import pytest

from mc_nested.errors import DesktopError, NoWindowError

if not sys.platform.startswith("linux"):
    pytest.skip("Xwayland", allow_module_level=True)

from Xlib.error import BadDrawable, BadMatch

from mc_nested.live.desktop.xwayland import (
    ALLOW,
    BAND_BYTES,
    PANIC,
    WindowCamera,
    is_rootless,
    is_wayland_session,
    is_xwayland,
    no_x11_window_error,
    no_x_server_error,
)
from mc_nested.live.devices import DesktopArea
from tests.live.desktop.real_windows.probed import probed
from tests.live.desktop.real_windows.xwayland_fixtures import compositors, rootful, rootless

if TYPE_CHECKING:
    from Xlib.display import Display
    from Xlib.xobject.drawable import Window

__all__ = ["compositors", "rootful", "rootless"]

RED, GREEN, BLUE, YELLOW = [0, 0, 255], [0, 255, 0], [255, 0, 0], [0, 255, 255]
QUARTERS = [RED, GREEN, BLUE, YELLOW]
PRESSED, RELEASED = 1, 0
W, F3, SHIFT, SLASH = 87, 292, 340, 47
RIGHT = 1


def rootless_report(environment: dict[str, str], part: str) -> dict[str, Any]:
    command = [sys.executable, "-m", "tests.live.desktop.real_windows.xwayland_probe", part]
    root = Path(__file__).resolve().parents[3]
    done = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    return report


@pytest.mark.window
def test_the_games_own_window_is_pictured_whatever_covers_it(rootless: dict[str, str]) -> None:
    report = rootless_report(rootless, "camera")
    assert report["session"] == f"Xwayland, display {rootless['DISPLAY']}; {ALLOW}"
    assert (report["shape"], report["corners"]) == ([400, 640, 3], QUARTERS)
    assert (report["seam"], report["below"]) == ([[RED, GREEN]], [[RED], [BLUE]])
    assert report["covered"] == QUARTERS
    assert report["partly off the screen"] == QUARTERS
    assert report["large"] == [[640, 960, 3], QUARTERS]
    assert "minimised or hidden" in report["hidden"]
    if "XAUTHORITY" in rootless:  # weston minimises no X11 window
        assert "minimised or hidden" in report["minimised"]


@pytest.mark.window
def test_keys_text_motions_and_clicks_reach_the_game(rootless: dict[str, str]) -> None:
    report = rootless_report(rootless, "input")
    assert report["keys"] == [["key", key, action] for key in (W, F3, SHIFT, SLASH) for action in (PRESSED, RELEASED)]
    assert report["typed"] == "/Tp @s"
    assert report["pointer"] == [200, 50]
    clicks = [["button", RIGHT, PRESSED], ["button", RIGHT, RELEASED]]
    assert report["clicks"] == [["cursor", 200.0, 50.0], *clicks]
    assert report["in the world"] == clicks


@pytest.mark.window
def test_the_game_is_in_front_exactly_while_keys_reach_its_window(rootless: dict[str, str]) -> None:
    report = rootless_report(rootless, "focus")
    assert report["at first"] == [True, True]
    assert report["a Wayland window"] == [False, False]
    assert report["clicked"] == [True, True]
    assert report["another window"] == [False, False]
    assert "no window's title matches 'Wayland Terminal'" in report["not seen"]
    assert "start its launcher with env XDG_SESSION_TYPE=x11 SDL_VIDEO_DRIVER=x11" in report["not seen"]


@pytest.mark.window
def test_the_game_and_the_agent_share_one_clipboard(rootless: dict[str, str]) -> None:
    assert rootless_report(rootless, "clipboard") == {"pasted": "/tp @s 1 2 3", "copied": "F3+C's text"}


@pytest.mark.window
def test_the_panic_key_is_heard_while_the_game_is_in_front(rootless: dict[str, str]) -> None:
    report = rootless_report(rootless, "panic")
    assert report["in front"] == ["the panic key was pressed"]
    # With a Wayland window in front nothing is heard; nothing is pressed there either, as the test above has it.
    assert report["behind"] == []


@pytest.mark.window
def test_the_devices_work_on_an_xwayland_in_one_window_as_on_any_x_server(rootful: dict[str, str]) -> None:
    red, blue = [0x10, 0x20, 0xFF], [0xFF, 0x20, 0x10]
    pictured = probed(rootful, "camera")
    assert (pictured["corners"], pictured["moved"]) == ([red, red, blue, blue], [red, blue])
    watched = probed(rootful, "window")
    assert (watched["in front"], watched["other in front"], watched["again in front"]) == (True, False, True)
    assert "closed" in watched["closed"]
    pressed = probed(rootful, "keyboard")
    assert pressed["typed"] == "/Tp @s"
    assert [event[0] for event in pressed["keys"]] == ["press", "release"] * 4
    clicked = probed(rootful, "pointer")
    assert clicked["pointer"] == [200, 50]
    assert [event[:2] for event in clicked["clicks"]] == [["down", 3], ["up", 3]]


@pytest.mark.window
def test_the_session_kind_names_an_xwayland_in_one_window(rootful: dict[str, str]) -> None:
    code = "from mc_nested.live.desktop import this_system; print(this_system().session_kind())"
    done = subprocess.run([sys.executable, "-c", code], env=rootful, capture_output=True, text=True, check=True)
    assert done.stdout == f"Xwayland in one window, display {rootful['DISPLAY']}; {PANIC}\n"


class Server:
    """An X server with a screen that can be pictured or can't, and outputs of these names."""

    def __init__(self, *, extensions: tuple[str, ...] = (), has_picture: bool = True) -> None:
        self.extensions, self.has_picture = extensions, has_picture

    def query_extension(self, name: str) -> object | None:
        return object() if name in self.extensions else None

    def screen(self) -> Any:
        return SimpleNamespace(root=self)

    def get_image(self, *_: int) -> Any:
        if not self.has_picture:
            raise BadMatch(cast("Any", None), b"\0" * 32)
        return SimpleNamespace(data=b"\0" * 4)


def test_an_x_server_whose_screen_can_not_be_pictured_is_rootless() -> None:
    assert is_rootless(cast("Display", Server(has_picture=False)))
    assert not is_rootless(cast("Display", Server()))


def test_an_xwayland_is_known_by_its_extension_and_a_server_without_outputs_is_none() -> None:
    assert is_xwayland(cast("Display", Server(extensions=("XWAYLAND",))))
    assert not is_xwayland(cast("Display", Server()))


@pytest.mark.parametrize(
    ("environment", "is_one"),
    [({}, False), ({"WAYLAND_DISPLAY": "wayland-0"}, True), ({"XDG_SESSION_TYPE": "wayland"}, True)],
    ids=["neither", "its display", "its type"],
)
def test_a_wayland_session_is_known_by_its_environment(
    environment: dict[str, str], is_one: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("WAYLAND_DISPLAY", "XDG_SESSION_TYPE"):
        monkeypatch.delenv(name, raising=False)
    for name, value in environment.items():
        monkeypatch.setenv(name, value)
    assert is_wayland_session() == is_one


def test_each_error_is_one_line_that_says_what_to_do() -> None:
    without_x = str(no_x_server_error())
    assert "install your distribution's xwayland" in without_x
    unseen = no_x11_window_error(NoWindowError("no window's title matches 'M'"))
    assert isinstance(unseen, NoWindowError)
    assert str(unseen).startswith("no window's title matches 'M'; a game that uses Wayland itself isn't seen")
    assert "\n" not in without_x + str(unseen)


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


class PicturelessServer:
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


def test_picturing_an_area_of_the_desktop_gives_the_windows_pixels_there() -> None:
    server = PicturelessServer()
    frame = server.camera()(DesktopArea(60 + 20, 40 + 50, 4, 3))
    assert frame.shape == (3, 4, 3)
    assert frame.dtype == np.uint8
    assert frame[0, 0].tolist() == [20, 50, 7]
    assert frame[2, 3].tolist() == [23, 52, 7]
    assert not server.copies


def test_a_large_picture_is_copied_once_and_fetched_in_bands() -> None:
    server = PicturelessServer(1280, 720)
    frame = server.camera()(DesktopArea(60, 40, 1280, 720))
    assert np.array_equal(frame, server.window.pixels[:, :, :3])
    (copy,) = server.copies
    assert not server.window.asked  # what it shows may change between two bands
    assert len(copy.asked) > 1
    assert all(width * height * 4 <= BAND_BYTES for _, _, width, height in copy.asked)
    assert copy.is_free


@pytest.mark.parametrize("area", [(59, 40, 9, 9), (60, 39, 9, 9), (372, 40, 9, 9), (60, 272, 9, 9)])
def test_picturing_an_area_beyond_the_window_is_an_error(area: Part) -> None:
    with pytest.raises(DesktopError, match="hidden or resized"):
        PicturelessServer().camera()(DesktopArea(*area))


def test_picturing_a_window_that_the_x_server_refuses_is_an_error() -> None:
    server = PicturelessServer()
    server.window.error = BadMatch(cast("Any", None), b"\0" * 32)
    with pytest.raises(DesktopError, match="hidden or resized"):
        server.camera()(DesktopArea(60, 40, 4, 3))


def test_a_window_that_closes_before_its_copy_raises_the_x_servers_error() -> None:
    server = PicturelessServer(1280, 720)
    server.window.error = BadDrawable(cast("Any", SimpleNamespace(get_resource_class=lambda _: None)), b"\0" * 32)
    with pytest.raises(BadDrawable):
        server.camera()(DesktopArea(60, 40, 1280, 720))
    assert server.copies[0].is_free


def test_a_picture_without_eight_bits_a_colour_is_refused() -> None:
    server = PicturelessServer()
    server.window.depth = 16
    with pytest.raises(DesktopError, match="colours of 16 bits"):
        server.camera()(DesktopArea(60, 40, 4, 3))
