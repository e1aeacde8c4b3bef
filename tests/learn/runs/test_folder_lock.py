"""One process at a time writes to a run's folder."""

import errno
import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.file_lock import Lock
from mc_nested.learn.runs import folder_lock as module
from mc_nested.learn.runs.folder_lock import FILE, folder_lock, holder_of


def test_a_second_process_is_refused_and_told_the_folder_and_who_holds_it(tmp_path: Path) -> None:
    run = tmp_path / "runs" / "one"
    with (
        folder_lock(run),
        pytest.raises(RunError, match=f"^{run}: process {os.getpid()} is writing there"),
        folder_lock(run),
    ):
        pytest.fail("it was let in")
    with folder_lock(run):
        assert [path.name for path in run.iterdir()] == [FILE]
    assert list(run.iterdir()) == []


def test_a_patient_process_waits_until_the_folder_is_free(tmp_path: Path) -> None:
    is_held, may_end = threading.Event(), threading.Event()

    def hold() -> None:
        with folder_lock(tmp_path):
            is_held.set()
            may_end.wait(10)

    holder = threading.Thread(target=hold)
    holder.start()
    is_held.wait(10)
    threading.Timer(0.2, may_end.set).start()
    with folder_lock(tmp_path, patience_s=10):
        assert may_end.is_set()
    holder.join()


def test_a_lock_is_seen_without_being_taken(tmp_path: Path) -> None:
    assert holder_of(tmp_path / "nothing") is None
    with folder_lock(tmp_path):
        assert holder_of(tmp_path) == f"process {os.getpid()}"
        assert (tmp_path / FILE).exists()
    (tmp_path / FILE).write_text("1234")
    assert holder_of(tmp_path) is None, "that process was killed"


def test_a_disk_without_locks_lets_every_process_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    @contextmanager
    def no_locks(path: Path) -> Iterator[Lock]:
        raise OSError(errno.ENOLCK, "No locks available", str(path))
        yield

    monkeypatch.setattr(module, "file_lock", no_locks)
    with folder_lock(tmp_path), folder_lock(tmp_path):
        assert holder_of(tmp_path) is None


def test_a_file_in_the_folders_place_is_refused_in_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    with (
        pytest.raises(RunError, match="can't be written, File exists: name another folder"),
        folder_lock(tmp_path / "file"),
    ):
        pytest.fail("it was let in")


def test_an_error_of_the_block_is_passed_on(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No locks"), folder_lock(tmp_path):
        raise OSError(errno.ENOLCK, "No locks available")
