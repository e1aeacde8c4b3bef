"""One run's folder in the hands of several verbs."""

import json
from pathlib import Path

import pytest

from mc_nested.learn.runs.checkpoint import FILE
from tests.cli.running import TRAIN, run


def test_studies_refuse_a_training_folder_and_name_its_verb(trained: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for verb in ("reproduce", "study sweep", "study benchmark"):
        assert run(*verb.split(), "--resume", trained) == 2
        said = capsys.readouterr().err
        assert f"the folder of mc-nested train, not of {verb}" in said
        assert f"mc-nested train --resume {trained}" in said


@pytest.mark.parametrize(("agent", "networks"), [("hierarchical", 3), ("single", 1)])
def test_the_other_agents_train_evaluate_and_play(
    agent: str, networks: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / agent
    assert run(*TRAIN, "--agent", agent, "--out", out) == 0
    summary = json.loads((out / "summary.json").read_text())
    assert (summary["agent"], summary["networks"]) == (agent, networks)
    capsys.readouterr()
    assert run("runs", "evaluate", out, "--json") == 0
    assert json.loads(capsys.readouterr().out)["scores"] == summary["final_scores"]
    assert run("play", out, "--trial", "1") == 0
    assert f"score {summary['final_scores'][1]:g} of 21" in capsys.readouterr().out


def test_a_checkpoint_of_another_scenario_is_refused(
    trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    other = tmp_path / "other"
    assert run("train", "--episodes", "1", "--scenario", "zigzag", "--out", other) == 0
    (other / "checkpoint" / FILE).write_bytes((trained / "checkpoint" / FILE).read_bytes())
    verbs: list[list[str | Path]] = [["runs", "evaluate", other], ["play", other], ["train", "--resume", other]]
    for verb in verbs:
        capsys.readouterr()
        assert run(*verb) == 2
        assert "belongs to another scenario" in capsys.readouterr().err
