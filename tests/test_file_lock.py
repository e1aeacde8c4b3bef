"""A lock by a file: one at a time, free again after the block, and after the process that held it is killed."""

import subprocess
import sys
from pathlib import Path

from mc_nested.file_lock import file_lock

HOLD = """
import sys
from pathlib import Path
from mc_nested.file_lock import file_lock
with file_lock(Path(sys.argv[1])) as is_mine:
    print(is_mine, flush=True)
    sys.stdin.read()
"""


def test_one_at_a_time_has_it_and_then_it_is_free(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    with file_lock(path) as is_mine:
        assert is_mine
        with file_lock(path) as is_mine_too:
            assert not is_mine_too
        with file_lock(path) as is_still_taken:
            assert not is_still_taken
    with file_lock(path) as is_mine_again:
        assert is_mine_again


def test_locks_of_other_names_are_others(tmp_path: Path) -> None:
    with file_lock(tmp_path / "one.lock") as one, file_lock(tmp_path / "other.lock") as other:
        assert one
        assert other


def test_a_killed_process_holds_it_no_longer(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    command = [sys.executable, "-c", HOLD, str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "True\n"
        with file_lock(path) as is_mine:
            assert not is_mine
        process.kill()
        process.wait()
        with file_lock(path) as is_mine:
            assert is_mine
