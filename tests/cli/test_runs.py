"""``mc-nested runs`` lists, shows, renames and deletes runs, and leaves other folders alone."""

import json
import os
import shutil
from pathlib import Path

import pytest
import typer

from mc_nested.learn.runs.folder_lock import folder_lock
from tests.cli.running import run


@pytest.fixture(autouse=True)
def here(trained: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a folder with two runs in runs/, one of them damaged, and one beside it."""
    monkeypatch.chdir(tmp_path)
    shutil.copytree(trained, tmp_path / "runs" / "whole")
    shutil.copytree(trained, tmp_path / "runs" / "torn")
    (tmp_path / "runs" / "torn" / "config.toml").write_text("agent = [")
    (tmp_path / "runs" / "notes").mkdir()
    shutil.copytree(trained, tmp_path / "elsewhere")
    return tmp_path


def test_runs_are_listed_with_design_agent_state_and_damage(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs") == 0
    lines = capsys.readouterr().out.splitlines()
    assert " ".join(lines[0].split()) == "run what design agent preset trials episodes score state size begun"
    assert lines[1].startswith("torn ")
    assert "damaged" in lines[1]
    whole = [cell.strip() for cell in lines[2].split("  ") if cell.strip()]
    assert whole[:7] == ["whole", "train", "line", "nested", "paper", "2", "80 of 80"]
    assert whole[8] == "finished"
    assert lines[3].startswith("runs/torn: runs/torn/config.toml: not TOML")
    assert len(lines) == 4


@pytest.mark.parametrize("words", [["runs"], ["runs", "list"], ["runs", "list", "runs"]])
def test_json_lists_one_object_for_each_run(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(*words, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["folder"] == "runs"
    torn, whole = found["runs"]
    assert (torn["folder"], torn["state"], torn["verb"]) == (str(Path("runs/torn")), "damaged", None)
    summary = json.loads(Path("runs/whole/summary.json").read_text())
    assert whole["score"] == sum(summary["final_scores"]) / 2
    assert (whole["episodes_done"], whole["optimum"], whole["why"]) == (80, 21.0, None)


def test_without_any_run_the_list_says_how_to_make_one(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs", "list", here / "nothing") == 0
    assert capsys.readouterr().out == f"no runs in {here / 'nothing'}: mc-nested train makes one\n"


def test_a_run_is_shown_by_its_name_or_its_folder(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs", "show", "whole") == 0
    shown = capsys.readouterr().out
    assert "config.toml, curve.png" in shown
    assert "why" not in shown
    assert run("runs", "show", "elsewhere", "--json") == 0
    assert json.loads(capsys.readouterr().out)["folder"] == "elsewhere"


def test_a_run_is_renamed_from_inside_its_own_folder(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(here / "elsewhere")
    assert run("runs", "rename", ".", "renamed") == 0
    assert (here / "renamed" / "config.toml").exists()


def test_a_run_is_renamed(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("runs", "rename", "whole", "better") == 0
    assert capsys.readouterr().out == f"renamed to {Path('runs/better')}\n"
    assert (here / "runs" / "better" / "config.toml").exists()
    assert run("runs", "evaluate", "runs/better") == 0


@pytest.mark.parametrize(("answer", "is_gone"), [(True, True), (False, False)])
def test_a_run_is_deleted_after_a_question(
    answer: bool, is_gone: bool, here: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []

    def confirm(question: str) -> bool:
        asked.append(question)
        return answer

    monkeypatch.setattr(typer, "confirm", confirm)
    assert run("runs", "delete", "whole") == 0
    assert asked[0].startswith(f"Delete {Path('runs/whole')} (train, line, finished, ")
    assert (here / "runs" / "whole").exists() is not is_gone


def test_nothing_is_deleted_if_nobody_can_be_asked(here: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with Path(os.devnull).open() as nobody:
        monkeypatch.setattr("sys.stdin", nobody)
        assert run("runs", "delete", "whole") == 130
    assert (here / "runs" / "whole" / "config.toml").exists()


def test_several_runs_and_damaged_ones_can_be_deleted_at_once(here: Path) -> None:
    assert run("runs", "delete", "torn", "elsewhere", "--yes") == 0
    assert sorted(path.name for path in here.iterdir()) == ["runs"]
    assert sorted(path.name for path in (here / "runs").iterdir()) == ["notes", "whole"]


@pytest.mark.parametrize("name", ["notes", "nothing", "", "..", "/"])
def test_folder_without_a_run_is_refused_and_no_run_named_with_it_is_deleted(
    name: str, here: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("runs", "delete", "whole", name, "--yes") == 2
    said = capsys.readouterr().err
    assert "mc-nested runs lists them" in said
    assert said.count("\n") == 1
    assert (here / "runs" / "whole").exists(), "one mistake, and nothing is begun"


def test_run_in_use_is_listed_as_in_use_and_left_alone(here: Path, capsys: pytest.CaptureFixture[str]) -> None:
    with folder_lock(here / "runs" / "whole"):
        for words in (["delete", "whole", "--yes"], ["rename", "whole", "better"]):
            assert run("runs", *words) == 2
            assert f"process {os.getpid()} is writing there" in capsys.readouterr().err
        assert run("runs", "--json") == 0
    assert json.loads(capsys.readouterr().out)["runs"][1]["state"] == "in use"
    assert (here / "runs" / "whole" / "config.toml").exists()
