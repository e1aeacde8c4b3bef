"""The virtual client and a real GLFW window do the same with the same keys, clicks and text."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from scripts.rehearsal_window import open_rehearsal
from tests.live import devices_contract
from tests.live.devices_contract import virtual_answers

WANTED: dict[str, Any] = {
    "title": "Minecraft 1.20.1 - Singleplayer",
    "size": [854, 480],
    "picture": [480, 854, 3],
    "down": ["w"],
    "walked on": True,
    "aside": 0.0,
    "view after clicks": [0.0, 40.0],
    "after t": "chat",
    "sent": ["world", 8.5, 90.0, 40.0],
    "in hand": "stone",
    "second slot": None,
    "copied": "/execute in minecraft:overworld",
    "after esc": "pause",
    "mouse": [120, 80],
    "after another": "world",
    "up": [],
}


def test_the_virtual_client_keeps_the_devices_contract() -> None:
    assert virtual_answers() == WANTED


@pytest.mark.window
def test_a_real_window_keeps_the_devices_contract(display: dict[str, str], tmp_path: Path) -> None:
    with open_rehearsal(display, tmp_path) as rehearsal:
        command = [sys.executable, devices_contract.__file__, str(rehearsal.truth_file)]
        done = subprocess.run(command, env=display, capture_output=True, text=True, check=False, timeout=120)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == WANTED
