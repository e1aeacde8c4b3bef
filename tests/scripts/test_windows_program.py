"""A program's output and end, where another one keeps its pipe open."""

import subprocess
import sys
from contextlib import closing

import pytest

from scripts.windows_program import SessionError, WindowsProgram

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="Wine is for Linux")

LEAVES_ONE_BEHIND = "import subprocess; print('x' * 300_000 + 'end'); subprocess.Popen(['sleep', '6'])"
STAYS = "import time; print('here', flush=True); time.sleep(60)"


def started(code: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen([sys.executable, "-c", code], stdin=subprocess.PIPE, stdout=subprocess.PIPE)


def test_all_that_it_printed_has_come_at_its_end_though_the_pipe_stays_open() -> None:
    with started(LEAVES_ONE_BEHIND) as process, closing(WindowsProgram(process)) as program:
        assert program.wait(5) == 0
        assert program.size() == 300_004
        assert program.printed(300_000) == "end\n"


def test_one_that_takes_too_long_is_an_error_with_its_last_words_and_is_ended() -> None:
    with started(STAYS) as process, closing(WindowsProgram(process)) as program:
        with pytest.raises(SessionError, match="took more than 1 s; it said last: here"):
            program.wait(1)
        assert not program.has_ended
    assert process.returncode is not None
