"""An input method in front of typed text: a line that it changes is never sent, and the keys of the world arrive."""

import subprocess
import sys
from pathlib import Path

import pytest

if not sys.platform.startswith("linux"):
    pytest.skip("windows on an X server", allow_module_level=True)

from scripts.programs import ROOT
from scripts.rehearsal_window import open_rehearsal
from scripts.window_display import open_display
from tests.found_or_skipped import found_or_skipped
from tests.live.desktop.real_windows.input_method import input_method, install_input_method
from tests.live.desktop.real_windows.probed import glfw_probed

pytestmark = [pytest.mark.window, pytest.mark.usefixtures("window_programs")]

PROBE = Path(__file__).parent / "real_windows" / "chat_probe.py"
LINE = "/tp @s 3.5 64 2.5"


def test_a_line_that_an_input_method_changes_is_refused_in_one_line_and_never_sent(tmp_path: Path) -> None:
    found_or_skipped(lambda: install_input_method(print, tmp_path / "apt.log"))
    with open_display(has_window_manager=True) as display, input_method(display, tmp_path / "bus") as env:
        assert glfw_probed(env, "text", LINE)["text"] != LINE, "the input method is in the way"
        assert glfw_probed(env, "keys", ["w"]) == {"w": [[ord("W"), 1], [ord("W"), 0]]}
        with open_rehearsal(env, tmp_path) as rehearsal:
            before = rehearsal.truth.now()["feet"]
            said = subprocess.run(
                [sys.executable, str(PROBE), str(rehearsal.font), LINE],
                env={**env, "PYTHONPATH": str(ROOT)},
                capture_output=True,
                text=True,
                check=True,
                timeout=60,
            ).stdout.strip()
            truth = rehearsal.truth.now()
    assert "input method" in said
    assert "\n" not in said
    assert (truth["feet"], truth["screen"], truth["keys_down"]) == (before, "world", [])
