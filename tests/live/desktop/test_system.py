"""The system's own module is chosen without a display."""

import os
import subprocess
import sys

import pytest


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="X11's module")
def test_on_linux_it_is_x11s() -> None:
    code = (
        "from mc_nested.live.desktop.system import this_system\n"
        "system = this_system()\n"
        "print(system.__name__.rpartition('.')[2], type(system.open_clipboard()).__name__)"
    )
    environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
    done = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "x11 X11Clipboard\n"), done.stderr
