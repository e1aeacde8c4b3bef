"""Renaming and deleting a run's folder: only that folder, and never while somebody writes there."""

import os
from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.learn.runs.folder_changes import delete_folder, rename_folder
from mc_nested.learn.runs.folder_lock import FILE as LOCK
from mc_nested.learn.runs.folder_lock import folder_lock


@pytest.fixture
def run(tmp_path: Path) -> Path:
    folder = tmp_path / "runs" / "one"
    (folder / "checkpoint").mkdir(parents=True)
    (folder / "checkpoint" / "state.npz").touch()
    (folder / "config.toml").touch()
    return folder


def test_a_run_gets_another_name_where_it_is(run: Path) -> None:
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


def test_of_a_link_inside_only_the_link_is_deleted(run: Path, tmp_path: Path) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").touch()
    (run / "folder").symlink_to(tmp_path / "mine")
    (run / "checkpoint" / "deep").symlink_to(tmp_path / "mine")
    (run / "file").symlink_to(tmp_path / "mine" / "letter.txt")
    delete_folder(run)
    assert not run.exists()
    assert (tmp_path / "mine" / "letter.txt").exists()


def test_a_link_to_a_run_is_not_followed(run: Path, tmp_path: Path) -> None:
    (tmp_path / "link").symlink_to(run)
    with pytest.raises(RunError, match=f"is a link to {run}"):
        delete_folder(tmp_path / "link")
    assert (run / "config.toml").exists()


def test_what_was_interrupted_is_still_known_as_a_run(run: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuses(path: Path) -> None:
        raise PermissionError(13, "Permission denied", str(path))

    monkeypatch.setattr("shutil.rmtree", refuses)
    with pytest.raises(RunError, match="checkpoint: can't be deleted, Permission denied: the rest is still there"):
        delete_folder(run)
    assert (run / "config.toml").exists()
