"""An experiment's folder: what makes it, what it refuses, and that its config is all that is needed to go on."""

from pathlib import Path

import pytest

from mc_nested.errors import RunError, UserError
from mc_nested.studies.arm import Arm
from mc_nested.studies.config import StudyConfig, config_of
from mc_nested.studies.folder import CONFIG, StudyFolder
from tests.learn.made_experiments import BAR, DOT, small_preset


def config(trials: int = 2, jobs: int = 2) -> StudyConfig:
    arms = [Arm(agent, small_preset(), [DOT, BAR], trials, agent, "small") for agent in ("nested", "single")]
    return config_of("reproduce", arms, trials=trials, seed=7, jobs=jobs)


def begun(path: Path) -> StudyFolder:
    folder = StudyFolder.new(path, config())
    folder.begin()
    return folder


def opened(path: Path) -> StudyFolder:
    return StudyFolder.open(path, ["reproduce"])


def test_a_begun_study_is_opened_with_the_same_config_and_jobs(tmp_path: Path) -> None:
    folder = begun(tmp_path / "new")
    assert opened(tmp_path / "new").config == folder.config
    assert opened(tmp_path / "new").jobs == folder.jobs
    assert [outcome for _, outcome in folder.outcomes()] == [None] * len(folder.jobs)
    assert folder.resume_command == f"mc-nested reproduce --resume {tmp_path / 'new'}"


def test_a_new_study_folder_writes_nothing_before_begin(tmp_path: Path) -> None:
    StudyFolder.new(tmp_path / "new", config())
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_holds_anything_is_refused(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(RunError, match="not empty: name a new folder, nothing was overwritten"):
        StudyFolder.new(tmp_path, config())


def test_a_folder_without_a_config_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"no config.toml there: name a folder of mc-nested reproduce \(its --out\)"):
        opened(tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("seed = 7\n", "seed = 8\n", "was changed after the study began"),
        ("gamma = 0.95", "gamma = 0.9", "was changed after the study began"),
        ("jobs = 2", "jobs = 3", "was changed after the study began"),
        ("jobs = 2", "jobs = 0", "jobs: Input should be greater than or equal to 1, not 0"),
        (
            "gamma = 0.95",
            "gamma = 0.95\ngama = 0.95",
            r"small\.update\.gama: unknown key: did you mean gamma\?",
        ),
        ('name = "bar"', 'name = "dot"', "two scenarios are named 'dot'"),
        ('name = "single"', 'name = "nested"', "two arms are named 'nested'"),
        ('agent = "single"', 'agent = "double"', "arms.1.agent: must be one of nested, hierarchical, single, sb3"),
        ("seed = 7\n", "seed = \n", "not TOML"),
    ],
)
def test_a_changed_config_is_refused_in_one_line(tmp_path: Path, old: str, new: str, says: str) -> None:
    begun(tmp_path)
    text = (tmp_path / CONFIG).read_text("utf-8")
    assert text.count(old) == 1
    (tmp_path / CONFIG).write_text(text.replace(old, new), "utf-8")
    with pytest.raises(UserError, match=says) as caught:
        opened(tmp_path)
    assert "\n" not in str(caught.value)


def test_a_comment_added_to_the_config_is_accepted(tmp_path: Path) -> None:
    folder = begun(tmp_path)
    (tmp_path / CONFIG).write_text("# on the old laptop\n" + (tmp_path / CONFIG).read_text("utf-8"), "utf-8")
    assert opened(tmp_path).jobs == folder.jobs


def test_a_full_disk_is_reported_with_the_command_to_resume(tmp_path: Path) -> None:
    folder = begun(tmp_path / "new")
    with (
        pytest.raises(RunError, match=r"No space left.*make room, then mc-nested reproduce --resume"),
        folder.writing(),
    ):
        raise OSError(28, "No space left on device")


def test_a_folder_that_can_not_be_made_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(RunError, match="name another folder"):
        StudyFolder.new(tmp_path / "file" / "new", config()).begin()
