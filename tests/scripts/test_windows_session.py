"""A program's output and end, where another one keeps its pipe open."""

import os
import sys
from pathlib import Path

import pytest

from scripts.windows_session import SessionError, printing

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Wine is for Linux")

LEAVES_ONE_BEHIND = "import subprocess; print('x' * 300_000 + 'end'); subprocess.Popen(['sleep', '6'])"
STAYS = "import time; print('here', flush=True); time.sleep(60)"


def test_whole_output_has_arrived_at_a_programs_end_although_its_pipe_stays_open(tmp_path: Path) -> None:
    with printing([sys.executable, "-c", LEAVES_ONE_BEHIND], cwd=tmp_path, env=os.environ) as program:
        assert program.wait(5) == 0
        assert len(program.printed()) == 300_004
        assert program.printed().endswith("xend\n")


def test_a_program_that_takes_too_long_is_ended_and_its_last_words_are_in_the_error(tmp_path: Path) -> None:
    with printing([sys.executable, "-c", STAYS], cwd=tmp_path, env=os.environ) as program:
        with pytest.raises(SessionError, match="took more than 1 s; it said last: here"):
            program.wait(1)
        assert not program.has_ended
    assert program.has_ended
