"""Where a verb writes: the folder that is named, or a new one with the date; an empty one isn't left behind."""

import datetime
import os
from pathlib import Path

import pytest

from mc_nested.cli.completion import RUNS
from mc_nested.cli.output_folder import output_folder
from mc_nested.errors import RunError

NOW = datetime.datetime(2026, 11, 23, 9, 45, 1)


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_folder_without_a_name_is_named_after_what_is_trained_and_when() -> None:
    with output_folder(None, "line-nested", NOW) as path:
        assert path == Path("runs/line-nested-2026-11-23-094501")
        (path / "config.toml").touch()
    assert [entry.name for entry in path.iterdir()] == ["config.toml"]


def test_folders_made_in_the_same_second_have_different_names() -> None:
    with (
        output_folder(None, "sweep", NOW) as first,
        output_folder(None, "sweep", NOW) as second,
        output_folder(None, "sweep", NOW) as third,
    ):
        dated = "sweep-2026-11-23-094501"
        assert [path.name for path in (first, second, third)] == [dated, f"{dated}-2", f"{dated}-3"]


@pytest.mark.parametrize(
    ("name", "folder"),
    [
        ("my house/of: cards-single", "my-house-of-cards-single"),
        ("../../up-nested", "up-nested"),
        ("дом-nested", "дом-nested"),
        ("???", "run"),
        ("x" * 70, "x" * 50),
    ],
)
def test_design_name_becomes_a_folder_name_that_every_system_accepts(name: str, folder: str) -> None:
    with output_folder(None, name, NOW) as path:
        assert path == RUNS / f"{folder}-2026-11-23-094501"


def test_a_folder_into_which_nothing_was_written_is_removed(here: Path) -> None:
    for out in (None, Path("deep/er/one")):
        with pytest.raises(ValueError, match="no game"), output_folder(out, "line", NOW):
            raise ValueError("no game")
    assert list(here.iterdir()) == []


def test_empty_folder_that_existed_before_is_kept(here: Path) -> None:
    (here / "mine").mkdir()
    with output_folder(Path("mine"), "line"):
        pass
    assert list((here / "mine").iterdir()) == []


def test_folder_that_is_not_empty_is_refused_and_left_alone(here: Path) -> None:
    (here / "mine").mkdir()
    (here / "mine" / "letter.txt").touch()
    with pytest.raises(RunError, match="not empty"), output_folder(Path("mine"), "line"):
        pytest.fail("it was let in")
    assert [entry.name for entry in (here / "mine").iterdir()] == ["letter.txt"]


def test_a_folder_that_another_process_uses_is_refused_with_its_process_id() -> None:
    with (
        output_folder(Path("mine"), "line"),
        pytest.raises(RunError, match=f"^mine: process {os.getpid()} is writing there"),
        output_folder(Path("mine"), "line"),
    ):
        pytest.fail("it was let in")


def test_file_in_the_place_of_the_folder_runs_is_an_error(here: Path) -> None:
    (here / RUNS).touch()
    with (
        pytest.raises(RunError, match=r"can't be made, .*: name a new folder with --out DIR"),
        output_folder(None, "line"),
    ):
        pytest.fail("it was let in")
