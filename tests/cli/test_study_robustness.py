"""``mc-nested study robustness``: its folder, its files, and a resume."""

import json
from pathlib import Path

import pytest

from mc_nested.learn.agents import AGENT_SPECS
from mc_nested.studies.change import Change
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.robustness import STUDY, open_choices
from mc_nested.studies.study import StudyOptions
from tests.cli.running import check_one_at_a_time, run, table, write_study
from tests.learn.made_experiments import BAR, DOT, small_preset

FILES = STUDY.files
GAMMA = Change(choice="γ", value="0.5", preset={"update": {"gamma": 0.5}})
START = Change(choice="start", value="beside", start=[6, 13])


def config(*choices: Change) -> StudyConfig:
    options = StudyOptions(trials=2, scenarios=[DOT, BAR])
    arms = [
        choice.arm(f"{choice.name}, {agent}", agent, options, small_preset(20))
        for choice in (Change(), *choices)
        for agent in AGENT_SPECS
    ]
    return config_of("robustness", arms, trials=2, seed=0, jobs=1)


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study that the command began, and --resume went on with."""
    out = tmp_path_factory.mktemp("robust") / "run"
    StudyFolder.new(out, config(GAMMA, START)).begin()
    assert run("study", "robustness", "--resume", out, "--quiet") == 0
    return out


def test_a_stopped_study_is_resumed_and_leaves_its_files(done: Path) -> None:
    assert {*FILES.values()} <= {path.name for path in done.iterdir()}
    rows = table(done / "robustness.csv")
    assert list(dict.fromkeys((row["choice"], row["value"]) for row in rows)) == [
        ("", ""),
        ("γ", "0.5"),
        ("start", "beside"),
    ]
    assert {row["line"] for row in rows if row["claim"] == "c1"} == {"dot, final score", "bar, final score"}
    assert "| start: beside |" in (done / "robustness.md").read_text("utf-8")


def test_resuming_a_finished_study_writes_the_same_files(done: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = {name: (done / name).read_bytes() for name in FILES.values()}
    assert run("study", "robustness", "--resume", done, "--json") == 0
    assert {name: (done / name).read_bytes() for name in FILES.values()} == before
    found = json.loads(capsys.readouterr().out)
    assert found["files"]["table"] == str(done / "robustness.md")
    claim = next(each for each in found["claims"] if each["letter"] == "e1")
    assert claim["verdict"] == "holds"
    assert claim["choices"] == {"γ: 0.5": "holds", "start: beside": "holds"}
    check_one_at_a_time(["study", "robustness"], done, capsys)


@pytest.mark.slow
def test_the_command_trains_every_choice_for_every_agent(tmp_path: Path) -> None:
    out = tmp_path / "out"
    assert run("study", "robustness", *write_study(tmp_path, DOT), "--episodes", "10", "--out", out) == 0
    expected = open_choices(small_preset(10), [DOT])
    found = {(row["choice"], row["value"]) for row in table(out / "robustness.csv")}
    assert found == {(choice.choice, choice.value) for choice in expected}
