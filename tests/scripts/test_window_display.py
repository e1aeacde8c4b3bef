"""Programs left behind by others are ended, and those that ignore the request are killed."""

import subprocess
import sys
import time
from pathlib import Path

import pytest

from scripts.window_display import running, wait_until

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Linux only")

ROOT = Path(__file__).parents[2]
SLEEP = "import time; time.sleep(60)"
DEAF = f"import signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); print('deaf', flush=True); {SLEEP}"
LEAVES_ONE_BEHIND = f"import subprocess, sys; print(subprocess.Popen([sys.executable, '-c', {SLEEP!r}]).pid)"
ADOPTS = f"""
import subprocess, sys
from scripts import window_display
window_display.PATIENCE_S = 0.1
with window_display.adopting(eval(sys.argv[1])):
    subprocess.run([sys.executable, '-c', {LEAVES_ONE_BEHIND!r}], check=True)
sys.stdin.read()
"""


def is_there(pid: int) -> bool:
    return Path(f"/proc/{pid}").exists()


@pytest.mark.parametrize(("names", "is_ended"), [("lambda name: True", True), ("lambda name: False", False)])
def test_process_that_a_program_leaves_behind_is_ended_only_if_its_name_matches(*, names: str, is_ended: bool) -> None:
    command = [sys.executable, "-c", ADOPTS, names]
    with subprocess.Popen(command, cwd=ROOT, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as adopting:
        assert adopting.stdout is not None
        left = int(adopting.stdout.readline())
        assert wait_until(lambda: not is_there(left), 10 if is_ended else 1) is is_ended
        subprocess.run(["kill", "-KILL", str(left)], check=False, stderr=subprocess.DEVNULL)
        adopting.communicate("")


def test_process_that_does_not_end_on_request_is_killed_at_the_end_of_the_block(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("scripts.window_display.PATIENCE_S", 0.2)
    log = tmp_path / "log"
    with running([sys.executable, "-c", DEAF], log=log) as process:
        assert wait_until(lambda: "deaf" in log.read_text(), 10)
    assert process.returncode == -9


def test_wait_until_returns_once_the_condition_holds_or_the_time_is_over() -> None:
    began = time.monotonic()
    assert wait_until(lambda: time.monotonic() > began + 0.1, 10)
    assert not wait_until(lambda: False, 0.1)
    assert time.monotonic() < began + 5
