"""A real window under Xvfb, driven in a process of its own (x11_probe.py)."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any


def probed(environment: dict[str, str], part: str) -> dict[str, Any]:
    """What that part of the probe reports of the display in this environment."""
    probe = Path(__file__).with_name("x11_probe.py")
    command = [sys.executable, str(probe), part]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False, timeout=60)
    assert done.returncode == 0, done.stderr
    report: dict[str, Any] = json.loads(done.stdout)
    return report
