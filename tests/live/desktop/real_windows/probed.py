"""A real window under Xvfb, driven in a process of its own (x11_probe.py, window_probe.py)."""

import json
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any


def probed(environment: dict[str, str], part: str) -> dict[str, Any]:
    """Return what that part of the X probe reports of the display in this environment."""
    return _report("x11_probe.py", environment, part)


def glfw_probed(environment: dict[str, str], part: str, argument: object = None) -> dict[str, Any]:
    """Return what that part of the window's probe reports of a GLFW window on the display in this environment."""
    return _report("window_probe.py", environment, part, json.dumps(argument))


def window_probed(
    environment: dict[str, str], part: str, argument: object, title: str, program: Sequence[str]
) -> dict[str, Any]:
    """Return the same, of the window that this program shows."""
    return _report("window_probe.py", environment, part, json.dumps(argument), title, *program)


def _report(probe: str, environment: dict[str, str], *arguments: str) -> dict[str, Any]:
    command = [sys.executable, str(Path(__file__).with_name(probe)), *arguments]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    return report
