"""``mc-nested study ablation``: its folder, its files, and a resume."""

import json
from pathlib import Path

import pytest

from mc_nested.studies.ablation import arms
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.study import StudyOptions
from tests.cli.running import check_one_at_a_time, run, table
from tests.learn.made_experiments import BAR, DOT, scenario_text


def config(*names: str) -> StudyConfig:
    """Return the named parts on two designs, two trials of 20 episodes."""
    shipped = arms(StudyOptions(trials=2, episodes=20, scenarios=[DOT, BAR]))
    return config_of("ablation", [arm for arm in shipped if arm.name in names], trials=2, seed=0, jobs=1)


def test_a_stopped_ablation_is_resumed_and_leaves_its_files(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "out"
    names = "tuned as it is", "tuned, γ 0"
    StudyFolder.new(out, config(*names)).begin()
    assert run("study", "ablation", "--resume", out) == 0
    rows = table(out / "ablation.csv")
    assert [(row["part"], row["scenario"], row["trial"]) for row in rows] == [
        (part, scenario, trial) for part in names for scenario in ("dot", "bar") for trial in "01"
    ]
    written = {name: (out / name).read_bytes() for name in ("ablation.csv", "ablation.md", "ablation.png")}
    capsys.readouterr()
    assert run("study", "ablation", "--resume", out, "--json") == 0
    assert json.loads(capsys.readouterr().out)["files"]["table"] == str(out / "ablation.md")
    assert {name: (out / name).read_bytes() for name in written} == written
    check_one_at_a_time(["study", "ablation"], out, capsys)


@pytest.mark.slow
def test_an_ablation_has_a_row_for_each_trial_of_each_part(tmp_path: Path) -> None:
    (tmp_path / "dot.toml").write_text(scenario_text(DOT), "utf-8")
    words: list[str | Path] = ["study", "ablation", "--scenario", tmp_path / "dot.toml", "--trials", "2"]
    out = tmp_path / "out"
    assert run(*words, "--episodes", "3", "--out", out) == 0
    rows = table(out / "ablation.csv")
    expected = arms(StudyOptions(trials=2, scenarios=[DOT]))
    assert [(row["part"], row["trial"]) for row in rows] == [(arm.name, trial) for arm in expected for trial in "01"]
