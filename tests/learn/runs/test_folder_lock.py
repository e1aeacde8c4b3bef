"""One process at a time writes to a run's folder; nobody renames or deletes it meanwhile."""

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
from mc_nested.learn.runs.folder_lock import FILE, delete_folder, folder_lock, holder_of, rename_folder
from mc_nested.learn.runs.folder_lock import FILE as LOCK


def test_a_second_process_is_refused_with_the_folder_and_the_holders_process_id(tmp_path: Path) -> None:
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


def test_the_holder_of_a_lock_is_found_without_taking_the_lock(tmp_path: Path) -> None:
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


def test_an_error_raised_inside_the_lock_is_passed_on(tmp_path: Path) -> None:
    with pytest.raises(OSError, match="No locks"), folder_lock(tmp_path):
        raise OSError(errno.ENOLCK, "No locks available")


@pytest.fixture
def run(tmp_path: Path) -> Path:
    folder = tmp_path / "runs" / "one"
    (folder / "checkpoint").mkdir(parents=True)
    (folder / "checkpoint" / "state.npz").touch()
    (folder / "config.toml").touch()
    return folder


def test_a_renamed_run_stays_in_its_parent_folder(run: Path) -> None:
    assert rename_folder(run, "two") == run.with_name("two")
    assert not run.exists()
    assert (run.with_name("two") / "checkpoint" / "state.npz").exists()


@pytest.mark.parametrize("name", ["", " ", "../two", "a/b", "/two", ".", ".."])
def test_a_new_name_can_not_lead_into_another_folder(run: Path, name: str) -> None:
    with pytest.raises(RunError, match="is no name: it stays in"):
        rename_folder(run, name)
    assert run.exists()


def test_a_name_that_is_taken_is_refused(run: Path) -> None:
    run.with_name("two").symlink_to(run.parent / "missing")
    for name in ("one", "two"):
        with pytest.raises(RunError, match="exists already"):
            rename_folder(run, name)


def test_a_folder_in_use_is_not_changed(run: Path) -> None:
    with folder_lock(run):
        for change in (lambda: rename_folder(run, "two"), lambda: delete_folder(run)):
            with pytest.raises(RunError, match=f"process {os.getpid()} is writing there"):
                change()
    assert (run / "checkpoint" / "state.npz").exists()


def test_a_run_is_deleted_with_all_it_holds_and_nothing_else(run: Path) -> None:
    (run.parent / "other").mkdir()
    (run / LOCK).write_text("1")
    delete_folder(run)
    assert [path.name for path in run.parent.iterdir()] == ["other"]


def test_deleting_a_run_deletes_links_inside_but_not_their_targets(run: Path, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").touch()
    (run / "folder").symlink_to(tmp_path / "mine")
    (run / "checkpoint" / "deep").symlink_to(tmp_path / "mine")
    (run / "file").symlink_to(tmp_path / "mine" / "letter.txt")
    delete_folder(run)
    assert not run.exists()
    assert (tmp_path / "mine" / "letter.txt").exists()


def test_deleting_a_link_to_a_run_is_refused(run: Path, tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(run)
    with pytest.raises(RunError, match=f"is a link to {run}"):
        delete_folder(tmp_path / "link")
    assert (run / "config.toml").exists()


def test_an_interrupted_deletion_leaves_the_runs_config(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuses(path: Path) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr("shutil.rmtree", refuses)
    with pytest.raises(RunError, match="checkpoint: can't be deleted, Permission denied: the rest is still there"):
        delete_folder(run)
    assert (run / "config.toml").exists()
