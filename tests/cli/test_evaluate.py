"""``mc-nested runs evaluate``: the scores of a training's greedy policies."""

import json
import shutil
from importlib import resources
from pathlib import Path

import pytest

from mc_nested.learn.runs.checkpoint import FILE
from tests.cli.running import run
from tests.learn.runs.changed_arrays import change_arrays


@pytest.mark.parametrize("name", ["trained", "with_objectives"])
def test_evaluate_prints_the_scores_of_the_summary(
    name: str, request: pytest.FixtureRequest, capsys: pytest.CaptureFixture[str]
) -> None:
    """test_without_torch.py does the same in a separate process."""
    folder: Path = request.getfixturevalue(name)
    capsys.readouterr()
    assert run("runs", "evaluate", folder, "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["scores"] == json.loads((folder / "summary.json").read_text())["final_scores"]
    assert found["optimum"] == 21.0


def test_names_with_brackets_and_dollars_are_printed_unchanged(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (resources.files("mc_nested.arena") / "designs" / "line.toml").read_text("utf-8")
    odd = text.replace('"line"', '"[/b] $x_{$"').replace('"wood"', '"[/w]"').replace('name = "stone"', 'name = "[/s]"')
    (tmp_path / "odd.toml").write_text(odd)
    assert run("train", "--episodes", "1", "--scenario", tmp_path / "odd.toml", "--out", tmp_path / "run") == 0
    assert run("runs", "evaluate", tmp_path / "run") == 0
    printed = capsys.readouterr().out
    assert "[/b] $x_{$, greedy" in printed
    assert "[/s]" in printed or "[/w]" in printed


@pytest.mark.parametrize(
    "words", [["play", "RUN"], ["runs", "evaluate", "RUN"], ["train", "--from", "RUN", "--out", "NEW"]]
)
def test_checkpoint_without_a_policys_array_is_refused_in_one_line(
    words: list[str], trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    copy, new = tmp_path / "copy", tmp_path / "new"
    shutil.copytree(trained, copy)
    file = copy / "checkpoint" / FILE
    change_arrays(file, lambda state: state.pop("policies.low"))
    assert run(*(word.replace("RUN", str(copy)).replace("NEW", str(new)) for word in words)) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"mc-nested: {file}: holds networks of another shape than its preset's: ")
    assert printed.err.count("\n") == 1
    assert not new.exists()
