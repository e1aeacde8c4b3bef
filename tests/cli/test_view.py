"""``mc-nested view`` where there is no terminal: plain lines."""

import re
from pathlib import Path

import pytest

from mc_nested.view.board import Board
from mc_nested.view.files import StatusFiles
from mc_nested.view.publisher import Publisher
from tests.cli.running import run
from tests.view.shown import LIVE


def test_view_prints_an_ended_run_with_its_arena(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    StatusFiles(tmp_path).write(LIVE.model_copy(update={"ended": "finished"}))

    assert run("view", tmp_path) == 0

    lines = capsys.readouterr().out.splitlines()
    assert re.fullmatch(r"ended at \d\d:\d\d:\d\d: finished", lines[0])
    assert lines[1:3] == ["12 of at most 41 episodes", "last score 18, best 24, of 26"]
    assert [line.rstrip() for line in lines[5:9]] == [". . . x", ". . o .", ". # o .", "^ . . ."]


def test_view_of_a_killed_run_says_that_its_process_is_gone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    StatusFiles(tmp_path).write(LIVE)

    assert run("view", tmp_path) == 0
    assert capsys.readouterr().out.startswith("the run's process is gone")


def test_view_of_a_folder_without_a_view_is_refused_with_advice(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "config.toml").write_text("")

    assert run("view", tmp_path) == 2
    assert "it is an experiment: mc-nested runs show" in capsys.readouterr().err
    assert run("view", tmp_path / "config.toml") == 2
    assert "name the folder of a training" in capsys.readouterr().err


def test_a_training_is_found_by_its_name_in_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    with Publisher(Board("train", "a title"), Path("runs/mine")):
        pass

    assert run("view", "mine") == 0
    assert "finished" in capsys.readouterr().out


@pytest.mark.parametrize("name", ["nothing", "runs"])
def test_folder_without_a_run_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    (tmp_path / "runs").mkdir()

    assert run("view", tmp_path / name) == 2

    said = capsys.readouterr().err
    assert said.startswith("mc-nested: ")
    assert "there is nothing to view" in said
    assert said.count("\n") == 1
