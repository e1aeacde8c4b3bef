"""Where the monitors are: as a made-up mss lists them, and on a real X server with two."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import SimpleNamespace

import pytest
from mss.exception import ScreenShotError

from mc_nested.live.desktop import monitors as module
from mc_nested.live.desktop.monitors import monitors
from mc_nested.live.devices import DesktopArea
from scripts.window_display import XRANDR

ALL = {"left": -1920, "top": 0, "width": 3200, "height": 1080}
LEFT = {"left": -1920, "top": 0, "width": 1920, "height": 1080, "is_primary": False, "name": "a maker's name"}
RIGHT = {"left": 0, "top": 56, "width": 1280, "height": 1024, "is_primary": True}

PRINTS = "from mc_nested.live.desktop.monitors import monitors; print(monitors())"


def test_each_monitor_is_listed_and_not_all_of_them_together(monkeypatch: pytest.MonkeyPatch) -> None:
    @contextmanager
    def opened() -> Iterator[SimpleNamespace]:
        yield SimpleNamespace(monitors=[ALL, LEFT, RIGHT])

    monkeypatch.setattr(module, "mss", SimpleNamespace(MSS=opened))
    assert monitors() == (DesktopArea(-1920, 0, 1920, 1080), DesktopArea(0, 56, 1280, 1024))


def test_a_desktop_that_names_none_has_none(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse() -> None:
        raise ScreenShotError("no RandR")

    monkeypatch.setattr(module, "mss", SimpleNamespace(MSS=refuse))
    assert monitors() == ()


@pytest.mark.window
def test_one_monitor_and_two_on_a_real_display(display: dict[str, str]) -> None:
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
