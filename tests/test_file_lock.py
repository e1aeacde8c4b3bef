"""A lock by a file: one at a time, free again after the block, and after the process that held it is killed."""

import ctypes
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from mc_nested.file_lock import Lock, file_lock

HOLD = """
import sys
from pathlib import Path
from mc_nested.file_lock import file_lock
with file_lock(Path(sys.argv[1])) as lock:
    print(lock.is_mine, flush=True)
    sys.stdin.read()
"""


@contextmanager
def held_elsewhere(path: Path) -> Iterator["subprocess.Popen[str]"]:
    """Yield another process, which has the lock until its input ends."""
    command = [sys.executable, "-c", HOLD, str(path)]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "True\n"
        yield process


def test_the_lock_is_held_once_at_a_time_and_free_after_the_block(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    with file_lock(path) as first:
        assert first == Lock(True, os.getpid())
        for _ in range(2):
            with file_lock(path) as other:
                assert not other.is_mine
    with file_lock(path) as again:
        assert again.is_mine


def test_locks_of_different_names_are_independent(tmp_path: Path) -> None:
    with file_lock(tmp_path / "one.lock") as one, file_lock(tmp_path / "other.lock") as other:
        assert one.is_mine
        assert other.is_mine


def test_the_process_that_has_the_lock_is_named_by_its_id(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    path.write_text("4000000000, or whatever was there before")
    with held_elsewhere(path) as process, file_lock(path) as lock:
        assert lock == Lock(False, process.pid)


def test_a_killed_process_no_longer_holds_the_lock(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    with held_elsewhere(path) as process:
        process.kill()
        process.wait()
        with file_lock(path) as lock:
            assert lock.is_mine


def test_the_lock_file_is_removed_after_the_block_and_after_an_error(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    with file_lock(path):
        assert path.exists()
    assert not path.exists()
    with pytest.raises(KeyboardInterrupt), file_lock(path):
        raise KeyboardInterrupt
    assert not path.exists()


def test_a_refused_process_leaves_the_lock_file_alone(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    with file_lock(path):
        with file_lock(path):
            pass
        assert path.read_text() == str(os.getpid())


@pytest.mark.skipif(sys.platform != "win32", reason="only Windows refuses to open a file that is being removed")
def test_opening_waits_while_another_process_removes_the_lock_file(tmp_path: Path) -> None:
    path = tmp_path / "one.lock"
    path.touch()
    kernel = ctypes.WinDLL("kernel32")  # type: ignore[attr-defined,unused-ignore]  # there is none elsewhere
    delete, shared_with_nobody, existing = 0x10000, 0, 3
    removing = kernel.CreateFileW(str(path), delete, shared_with_nobody, None, existing, 0, None)
    with pytest.raises(PermissionError):
        path.read_bytes()
    threading.Timer(0.2, kernel.CloseHandle, [removing]).start()
    with file_lock(path) as lock:
        assert lock.is_mine


@pytest.mark.skipif(sys.platform != "win32", reason="elsewhere, root may write everywhere")
def test_a_lock_file_that_can_not_be_opened_raises(tmp_path: Path) -> None:
    (tmp_path / "folder").mkdir()
    with pytest.raises(PermissionError), file_lock(tmp_path / "folder"):
        pass


def test_no_two_of_many_threads_hold_the_lock_together(tmp_path: Path) -> None:
    path, inside, most, taken = tmp_path / "one.lock", [0], [0], [0]

    def take_often() -> None:
        for _ in range(300):
            with file_lock(path) as lock:
                if lock.is_mine:
                    inside[0] += 1
                    most[0] = max(most[0], inside[0])
                    taken[0] += 1
                    inside[0] -= 1

    threads = [threading.Thread(target=take_often) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert most == [1]
    assert taken[0] > 8
