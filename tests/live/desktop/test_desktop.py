"""The real devices together, as far as no game is needed: what is missing, and a real window under Xvfb.

What its keyboard, its pointer and its camera do is in files of their own.
"""

import gc
import os
import re
import subprocess
import sys
import warnings

import pytest

from mc_nested.errors import DesktopError
from mc_nested.live.desktop import open_camera, open_desktop, this_system
from mc_nested.live.devices import DesktopArea
from mc_nested.live.model.versions import GAME_TITLE
from tests.live.desktop.real_windows.moving_window import MovingWindow
from tests.live.desktop.real_windows.probed import probed

MINECRAFT = r"^Minecraft\*? \d"


def error_of_opening() -> str:
    with pytest.raises(DesktopError) as raised, open_desktop(MINECRAFT):
        pass
    return str(raised.value)


if sys.platform.startswith("linux"):

    @pytest.mark.parametrize(
        ("environment", "message"),
        [
            ({}, "no display \\(DISPLAY is not set\\)"),
            ({"WAYLAND_DISPLAY": "wayland-0"}, "this Wayland session has no X server"),
            ({"XDG_SESSION_TYPE": "wayland"}, "this Wayland session has no X server"),
            ({"DISPLAY": ":9999"}, "no display \\(DISPLAY=:9999 can't be reached\\)"),
            ({"DISPLAY": "nonsense"}, "no display \\(DISPLAY=nonsense can't be reached\\)"),
        ],
        ids=["nothing", "Wayland", "Wayland by its session", "no server", "no name of a display"],
    )
    def test_a_missing_display_is_an_error_of_one_line(
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
                this_system().session_kind()
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


@pytest.mark.standin
def test_a_window_is_found_and_watched_without_a_window_manager(x_server: dict[str, str]) -> None:
    report = probed(x_server, "window")
    assert report["title"] == "Minecraft* 1.20.1 - Singleplayer"
    assert report["size"] == [320, 240]
    assert (report["in front"], report["other in front"], report["again in front"]) == (True, False, True)
    # A window manager gives the focus back to a window by itself, sooner or later.
    assert (report["keys go to the pointer's window"], report["keys go elsewhere"]) == (True, False)
    assert "no window's title" in report["no such window"]
    assert "2 windows" in report["several"]
    assert "minimised" in report["minimised"]
    assert "has closed" in report["closed"]


COMING_AND_GOING = """
from Xlib.display import Display
display = Display()
while True:
    window = display.screen().root.create_window(0, 0, 5, 5, 0, display.screen().root_depth)
    window.map()
    display.sync()
    window.destroy()
    display.sync()
"""
"""A program whose windows close as soon as they are shown."""

LOOKS = 100

if sys.platform.startswith("linux"):

    @pytest.mark.window
    def test_the_game_is_found_while_other_windows_open_and_close(
        x_screen: dict[str, str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        from Xlib.display import Display

        from mc_nested.live.desktop.x11 import open_window

        monkeypatch.setenv("DISPLAY", x_screen["DISPLAY"])
        display = Display(x_screen["DISPLAY"])
        window = display.screen().root.create_window(10, 10, 300, 200, 0, display.screen().root_depth)
        window.set_wm_name("Minecraft 1.20.1")
        window.map()
        display.sync()
        with subprocess.Popen([sys.executable, "-c", COMING_AND_GOING], env=x_screen) as busy:
            try:
                for _ in range(LOOKS):
                    with open_window(MINECRAFT) as found:
                        assert found.title() == "Minecraft 1.20.1"
            finally:
                busy.kill()
        display.close()

    @pytest.mark.window
    def test_a_browser_window_is_told_from_the_game_by_its_class(
        x_screen: dict[str, str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        from Xlib.display import Display

        from mc_nested.live.desktop.x11 import open_window

        monkeypatch.setenv("DISPLAY", x_screen["DISPLAY"])
        display = Display(x_screen["DISPLAY"])
        for title, names in (
            ("Minecraft 1.20.1 - a page", ("Navigator", "firefox")),
            ("Minecraft 26.3", ("Minecraft 26.3",) * 2),
        ):
            window = display.screen().root.create_window(10, 10, 300, 200, 0, display.screen().root_depth)
            window.set_wm_name(title)
            window.set_wm_class(*names)
            window.map()
        display.sync()
        with open_window(GAME_TITLE) as found:
            assert found.title() == "Minecraft 26.3"
        display.close()


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="X11's module")
def test_on_linux_the_system_is_x11() -> None:
    code = (
        "from mc_nested.live.desktop import this_system\n"
        "system = this_system()\n"
        "print(system.__name__.rpartition('.')[2], type(system.open_clipboard()).__name__)"
    )
    environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "x11 X11Clipboard\n"), done.stderr


def test_the_camera_of_a_window_that_pictures_itself_is_that_window() -> None:
    window = MovingWindow(DesktopArea(10, 5, 40, 30))
    with open_camera(window) as camera:
        assert camera(window.client_area()).shape == (30, 40, 3)
    assert window.asked == [window.client_area()]
