"""The real devices as far as no game is needed: which window, its pictures, key names, the clock, what is missing.

The X11 part drives a real window under Xvfb, in a process of its own (x11_probe.py), without a window manager.
"""

import gc
import json
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.errors import DesktopError, NoWindowError, ProfileError
from mc_nested.live.desktop import open_desktop, session_kind
from mc_nested.live.desktop.clock import MonotonicClock
from mc_nested.live.desktop.connection import LOST, told_when_lost
from mc_nested.live.desktop.keys import WORDS, check_key
from mc_nested.live.desktop.screen import WindowDisplay
from mc_nested.live.desktop.window import Place, checked, pick
from mc_nested.live.devices import Frame, Region
from mc_nested.live.panic import CORNER_REASON, KEY_REASON

MINECRAFT = r"^Minecraft\*? \d"


@pytest.mark.parametrize(
    "title", ["Minecraft 1.12.2", "Minecraft* 1.20.1 - Singleplayer", "Minecraft 26.1 - Multiplayer (LAN)"]
)
def test_the_game_is_found_among_other_windows_whatever_its_state(title: str) -> None:
    assert pick(MINECRAFT, ["Minecraft Wiki - Firefox", title, "Minecraft Launcher"]) == 1


def test_a_missing_window_is_told_with_titles_that_exist() -> None:
    with pytest.raises(NoWindowError, match=r"start the game.*'Minecraft Launcher', 'Terminal'"):
        pick(MINECRAFT, ["Terminal", "", "Minecraft Launcher"])


def test_an_error_names_no_more_titles_than_fit_into_a_line() -> None:
    with pytest.raises(DesktopError, match=r"'tab 07' and 22 more$"):
        pick(MINECRAFT, [f"tab {number:02}" for number in range(30)])


def test_two_windows_of_the_title_are_told_apart_by_the_user() -> None:
    with pytest.raises(DesktopError, match=r"2 windows.*'Minecraft 1\.20\.1', 'Minecraft 1\.21'") as raised:
        pick(MINECRAFT, ["Minecraft 1.21", "Terminal", "Minecraft 1.20.1"])
    assert not isinstance(raised.value, NoWindowError)


def test_a_display_that_closes_under_the_game_is_told() -> None:
    assert LOST or not sys.platform.startswith("linux")
    for error in LOST:
        with pytest.raises(DesktopError, match="display has closed"), told_when_lost():
            raise error("broken pipe")


@pytest.mark.parametrize("size", [(0, 480), (854, 0)])
def test_a_window_without_area_counts_as_minimised(size: tuple[int, int]) -> None:
    with pytest.raises(DesktopError, match="minimised"):
        checked(Place(0, 0, *size), "Minecraft 1.21")


class MovingWindow:
    """A window on a desktop of one picture, of which each point is drawn as ``ratio`` x ``ratio`` pixels."""

    def __init__(self, place: Place, ratio: int = 1) -> None:
        self.at = place
        self.asked: list[Place] = []
        rows, columns = np.mgrid[0 : 60 * ratio, 0 : 80 * ratio]
        self.pixels = np.stack([rows, columns, rows + columns], axis=2).astype(np.uint8)
        self.ratio = ratio

    def title(self) -> str:
        return "Minecraft 1.21"

    def place(self) -> Place:
        return self.at

    def is_in_front(self) -> bool:
        return True

    def picture(self, place: Place) -> Frame:
        self.asked.append(place)
        top, left = place.top * self.ratio, place.left * self.ratio
        return self.pixels[top : top + place.height * self.ratio, left : left + place.width * self.ratio]


@st.composite
def regions(draw: st.DrawFn, width: int, height: int) -> Region:
    left, top = draw(st.integers(0, width - 1)), draw(st.integers(0, height - 1))
    return Region(left, top, draw(st.integers(1, width - left)), draw(st.integers(1, height - top)))


@pytest.mark.parametrize("ratio", [1, 2], ids=["points are pixels", "two pixels to a point"])
@given(data=st.data())
def test_a_region_is_that_part_of_the_whole_picture_wherever_the_window_is(ratio: int, data: st.DataObject) -> None:
    window = MovingWindow(Place(5, 7, 40, 30), ratio)
    display = WindowDisplay(window, window.picture)
    window.at = Place(data.draw(st.integers(0, 40)), data.draw(st.integers(0, 30)), 40, 30)
    width, height = display.size()
    region = data.draw(regions(width, height))
    whole = display.grab()
    expected = whole[region.top : region.top + region.height, region.left : region.left + region.width]
    np.testing.assert_array_equal(display.grab(region), expected)


def test_only_the_asked_region_is_pictured_where_points_are_pixels() -> None:
    window = MovingWindow(Place(5, 7, 40, 30))
    WindowDisplay(window, window.picture).grab(Region(1, 2, 10, 4))
    assert window.asked[-1] == Place(6, 9, 10, 4)


def test_the_size_is_in_pixels_of_the_screen_that_the_window_is_on() -> None:
    window = MovingWindow(Place(5, 7, 40, 30), ratio=2)
    display = WindowDisplay(window, window.picture)
    assert (display.size(), display.points()) == ((80, 60), (40, 30))


def test_nothing_beside_the_window_is_ever_pictured() -> None:
    window = MovingWindow(Place(5, 7, 40, 30))
    display = WindowDisplay(window, window.picture)
    assert display.grab(Region(30, -3, 500, 500)).shape == (30, 10, 3)
    with pytest.raises(DesktopError, match="shrunk"):
        display.grab(Region(40, 0, 5, 5))


@pytest.mark.parametrize("key", ["w", "/", "1", "é", *WORDS])
def test_every_character_and_every_word_of_the_table_names_a_key(key: str) -> None:
    check_key(key)


@pytest.mark.parametrize("key", ["", "shift", "f33", "ctrl+a", "Enter"])
def test_an_unknown_key_is_told(key: str) -> None:
    with pytest.raises(ProfileError, match="no key is named"):
        check_key(key)


def test_a_wait_ends_at_its_time_and_never_before() -> None:
    clock = MonotonicClock()
    at = clock.now() + 0.005
    clock.sleep_until(at)
    assert at <= clock.now() < at + 0.5
    clock.sleep_until(at - 10)
    assert clock.now() < at + 0.5


def error_of_opening() -> str:
    with pytest.raises(DesktopError) as raised, open_desktop(MINECRAFT):
        pass
    return str(raised.value)


if sys.platform.startswith("linux"):

    @pytest.mark.parametrize(
        ("environment", "message"),
        [
            ({}, "no display \\(DISPLAY is not set\\)"),
            ({"WAYLAND_DISPLAY": "wayland-0"}, "this is a Wayland session"),
            ({"XDG_SESSION_TYPE": "wayland"}, "this is a Wayland session"),
            ({"DISPLAY": ":9999"}, "no display \\(DISPLAY=:9999 can't be reached\\)"),
            ({"DISPLAY": "nonsense"}, "no display \\(DISPLAY=nonsense can't be reached\\)"),
        ],
        ids=["nothing", "Wayland", "Wayland by its session", "no server", "no name of a display"],
    )
    def test_a_missing_display_is_told_in_one_line(
        environment: dict[str, str], message: str, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        for name in ("DISPLAY", "WAYLAND_DISPLAY", "XDG_SESSION_TYPE"):
            monkeypatch.delenv(name, raising=False)
        for name, value in environment.items():
            monkeypatch.setenv(name, value)
        with warnings.catch_warnings():
            # python-xlib leaves the socket of a connection that failed to the garbage collector.
            warnings.simplefilter("ignore", ResourceWarning)
            text = error_of_opening()
            with pytest.raises(DesktopError, match=message):
                session_kind()
            gc.collect()
        assert re.match(message, text)
        assert "\n" not in text


def test_importing_the_desktop_needs_no_display_and_loads_no_device() -> None:
    code = (
        "import sys, mc_nested.live.desktop as desktop\n"
        "print(*{'pynput', 'pyautogui', 'mss', 'Xlib'} & set(sys.modules))"
    )
    environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "\n"), done.stderr


def probed(environment: dict[str, str], left: int, top: int) -> dict[str, Any]:
    probe = Path(__file__).with_name("x11_probe.py")
    command = [sys.executable, str(probe), str(left), str(top)]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    return report


def check_report(report: dict[str, Any]) -> None:
    red, blue = [0x10, 0x20, 0xFF], [0xFF, 0x20, 0x10]
    assert report["title"] == "Minecraft* 1.20.1 - Singleplayer"
    assert (report["size"], report["shape"]) == ([320, 240], [240, 320, 3])
    assert (report["in front"], report["other in front"], report["again in front"]) == (True, False, True)
    assert report["corners"] == [red, red, blue, blue]
    assert report["seam"] == [[red, blue]]
    assert report["moved"] == [red, blue]
    keys = [(event[0], event[2]) for event in report["keys"]]
    assert keys == [("press", False), ("release", False)] * 4, "as a keyboard's own, not as synthetic events"
    assert [event[1] for event in report["keys"] if event[0] == "press"] == [ord("w"), 0xFFC0, 0xFFE1, ord("/")]
    assert "no key 'é'" in report["no such key"]
    assert report["typed"] == "/Tp @s"
    assert report["pointer"] == [200, 50]
    assert report["clicks"] == [["down", 3, False, 200, 50], ["up", 3, False, 200, 50]]
    assert report["hotkeys"] == ["f9", "k", "f9"]
    assert [reason for reason, _ in report["stopped by"]] == [KEY_REASON, CORNER_REASON, CORNER_REASON]
    assert max(seconds for _, seconds in report["stopped by"]) <= 0.1
    assert "means stop" in report["in the corner"]
    assert "no window's title" in report["no such window"]
    assert "2 windows" in report["several"]
    assert "all of it is on the screen" in report["off the screen"]
    assert "minimised" in report["minimised"]
    assert "has closed" in report["closed"]


@pytest.mark.standin
def test_a_window_is_seen_and_driven_without_a_window_manager(x_server: dict[str, str]) -> None:
    report = probed(x_server, 60, 40)
    check_report(report)
    # A window manager gives the focus back to a window by itself, sooner or later.
    assert (report["keys go to the pointer's window"], report["keys go elsewhere"]) == (True, False)
