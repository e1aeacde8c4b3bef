"""The system's own module is chosen without a display."""

import os
import subprocess
import sys

import pytest

from mc_nested.live.desktop.system import open_camera
from mc_nested.live.devices import DesktopArea
from tests.live.desktop.real_windows.moving_window import MovingWindow


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="X11's module")
def test_on_linux_the_system_is_x11() -> None:
    code = (
        "from mc_nested.live.desktop.system import this_system\n"
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
