"""``mc-nested evaluate``: the scores of a training's greedy policies."""

import json
import subprocess
import sys
from importlib import resources
from pathlib import Path

import pytest

from tests.cli.running import check_mistake, run


def test_evaluate_prints_the_scores_of_the_summary_in_a_fresh_process(trained: Path) -> None:
    command = [sys.executable, "-m", "mc_nested.cli", "evaluate", str(trained), "--json"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True)
    found = json.loads(printed.stdout)
    assert found["scores"] == json.loads((trained / "summary.json").read_text())["final_scores"]
    assert found["optimum"] == 21.0


def test_names_are_shown_as_they_are_written(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = (resources.files("mc_nested.arena") / "designs" / "line.toml").read_text("utf-8")
    odd = text.replace('"line"', '"[/b] $x_{$"').replace('"wood"', '"[/w]"').replace('name = "stone"', 'name = "[/s]"')
    (tmp_path / "odd.toml").write_text(odd)
    assert run("train", "--episodes", "1", "--scenario", tmp_path / "odd.toml", "--out", tmp_path / "run") == 0
    assert run("evaluate", tmp_path / "run") == 0
    printed = capsys.readouterr().out
    assert "[/b] $x_{$, greedy" in printed
    assert "[/s]" in printed or "[/w]" in printed


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["evaluate", "NEW" + "x" * 300], "File name too long"),
        (["evaluate", "NEW"], "no config.toml there"),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(
    arguments: list[str], says: str, trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    check_mistake(arguments, says, trained, tmp_path, capsys)
