"""A real window under Xvfb, driven in a process of its own (x11_probe.py, glfw_probe.py)."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any


def probed(environment: dict[str, str], part: str) -> dict[str, Any]:
    """What that part of the X probe reports of the display in this environment."""
    return _report("x11_probe.py", environment, part)


def glfw_probed(environment: dict[str, str], part: str, argument: object = None) -> dict[str, Any]:
    """What that part of the GLFW probe reports of the display in this environment."""
    return _report("glfw_probe.py", environment, part, json.dumps(argument))


def _report(probe: str, environment: dict[str, str], *arguments: str) -> dict[str, Any]:
    command = [sys.executable, str(Path(__file__).with_name(probe)), *arguments]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    return report
