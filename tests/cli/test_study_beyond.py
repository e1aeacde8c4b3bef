"""``mc-nested study beyond``: its folder, its files, a resume, and its refusals."""

import json
from dataclasses import replace
from pathlib import Path

import pytest

from mc_nested.studies.arm import Arm
from mc_nested.studies.beyond import STUDY, arms
from mc_nested.studies.config import config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.run_facts import facts_of
from mc_nested.studies.study import StudyOptions
from tests.cli.running import check_one_at_a_time, run, table
from tests.learn.made_experiments import small_preset

FILES = STUDY.files


def small_arms() -> list[Arm]:
    """Return all arms with small networks over numbers."""
    return [replace(arm, preset=small_preset(10)) for arm in arms(StudyOptions(trials=2))]


@pytest.fixture(scope="module")
def done(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a study that the command began, and --resume went on with."""
    out = tmp_path_factory.mktemp("beyond") / "run"
    StudyFolder.new(out, config_of("beyond", small_arms(), trials=2, seed=0, jobs=1)).begin()
    assert run("study", "beyond", "--resume", out, "--quiet") == 0
    return out


def test_a_stopped_study_is_resumed_and_leaves_its_files(done: Path) -> None:
    assert {*FILES.values()} <= {path.name for path in done.iterdir()}
    rows = table(done / "beyond.csv")
    found = {(row["topic"], row["scenario"], row["agent"]) for row in rows}
    assert found == {
        (arm.labels["topic"], scenario.name, arm.labels["agent"]) for arm in small_arms() for scenario in arm.scenarios
    }
    assert all(int(row["trained_steps"]) > 0 for row in rows)


def test_resuming_a_finished_study_writes_the_same_files(done: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = {name: (done / name).read_bytes() for name in FILES.values()}
    assert run("study", "beyond", "--resume", done, "--json") == 0
    assert {name: (done / name).read_bytes() for name in FILES.values()} == before
    found = json.loads(capsys.readouterr().out)
    assert found["files"]["report"] == str(done / "beyond.md")
    claim = next(each for each in found["claims"] if each["letter"] == "l7")
    assert (claim["verdict"], claim["trials"]) == ("holds", None)
    check_one_at_a_time(["study", "beyond"], done, capsys)


def test_folder_of_the_study_is_described_with_verb_state_designs_and_agents(done: Path) -> None:
    facts = facts_of(done)
    assert facts
    assert (facts.verb, facts.state, facts.trials) == ("study beyond", "finished", 2)
    assert {"line", "flag", "line, 8 materials"} <= set(facts.designs)
    assert {"images", "single", "2 builders, own"} <= set(facts.agents)


@pytest.mark.parametrize(
    ("option", "value"),
    [
        ("--scenario", "line"),
        ("--agent", "nested"),
        ("--preset", "tuned"),
        ("--engine", "torch"),
        ("--longer", "2"),
        ("--layer", "0"),
    ],
)
def test_options_that_the_study_sets_itself_are_refused(
    option: str, value: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "new"
    assert run("study", "beyond", "--out", out, option, value) == 2
    message = capsys.readouterr().err
    assert f"No such option: {option}" in message
    assert message.count("\n") == 1
    assert not out.exists()


def test_a_folder_without_a_study_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("study", "beyond", "--resume", tmp_path) == 2
    assert "no config.toml there" in capsys.readouterr().err
    (tmp_path / "config.toml").write_text("study = [\n", "utf-8")
    assert run("study", "beyond", "--resume", tmp_path) == 2
    assert "not TOML" in capsys.readouterr().err
