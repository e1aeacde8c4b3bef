"""One run at a time: a second waits, and says so."""

import subprocess
import sys
from pathlib import Path

import pytest

from scripts.cache_lock import BusyError, alone

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the locked scripts are for Linux")

HOLDS = (
    "import sys; from pathlib import Path; from scripts.cache_lock import alone\n"
    "with alone(Path(sys.argv[1]), print, 'x'): print('mine', flush=True); sys.stdin.read()"
)


def test_a_second_run_waits_for_the_first_and_gives_up_in_one_line(tmp_path: Path) -> None:
    said: list[str] = []
    command = [sys.executable, "-c", HOLDS, str(tmp_path)]
    root = Path(__file__).parents[2]
    with subprocess.Popen(command, cwd=root, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "mine\n"
        with (
            pytest.raises(BusyError, match=r"another x\.py is still running"),
            alone(tmp_path, said.append, "x.py", 0.1),
        ):
            pytest.fail("two at a time")
        other.kill()
    assert said == ["waiting for another x.py to end"]
    with alone(tmp_path, said.append, "x.py", 0.1):
        assert len(said) == 1
