"""The real devices together, as far as no game is needed: what is missing, and a real window under Xvfb.

The window is driven in a process of its own (x11_probe.py), without a window manager.
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

import pytest

from mc_nested.errors import DesktopError
from mc_nested.live.desktop import open_desktop, session_kind
from mc_nested.live.input.panic import CORNER_REASON, KEY_REASON

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
            ({"WAYLAND_DISPLAY": "wayland-0"}, "this is a Wayland session"),
            ({"XDG_SESSION_TYPE": "wayland"}, "this is a Wayland session"),
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
