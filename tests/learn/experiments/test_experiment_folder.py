"""An experiment's folder: what makes it, what it refuses, and that its config is all that is needed to go on."""

from pathlib import Path

import pytest

from mc_nested.arena.scenario_file import table_of
from mc_nested.errors import RunError, UserError
from mc_nested.learn.experiments.experiment_folder import CONFIG, ExperimentFolder
from mc_nested.learn.experiments.reproduction import ReproduceConfig
from tests.learn.made_experiments import BAR, DOT, small_preset


def config(trials: int = 2, jobs: int = 2) -> ReproduceConfig:
    return ReproduceConfig(
        agents=["nested", "single"],
        trials=trials,
        seed=7,
        jobs=jobs,
        longer=0,
        preset_name="small",
        preset=small_preset(),
        scenarios=[table_of(DOT), table_of(BAR)],
    )


def begun(path: Path) -> ExperimentFolder[ReproduceConfig]:
    folder = ExperimentFolder.new(path, config(), "reproduce")
    folder.begin()
    return folder


def opened(path: Path) -> ExperimentFolder[ReproduceConfig]:
    return ExperimentFolder.open(path, ReproduceConfig, "reproduce")


def test_what_was_begun_is_opened_with_the_same_jobs(tmp_path: Path) -> None:
    folder = begun(tmp_path / "new")
    assert opened(tmp_path / "new").config == folder.config
    assert opened(tmp_path / "new").jobs == folder.jobs
    assert [outcome for _, outcome in folder.outcomes()] == [None] * len(folder.jobs)
    assert folder.resume_command == f"mc-nested reproduce --resume {tmp_path / 'new'}"


def test_nothing_is_written_before_it_begins(tmp_path: Path) -> None:
    ExperimentFolder.new(tmp_path / "new", config(), "reproduce")
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_holds_anything_is_refused(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("mine")
    with pytest.raises(RunError, match="not empty: name a new folder, nothing was overwritten"):
        ExperimentFolder.new(tmp_path, config(), "reproduce")


def test_a_folder_without_a_config_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RunError, match=r"no config.toml there: name the folder of a reproduce \(its --out\)"):
        opened(tmp_path)


@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("trials = 2", "trials = 3", "was changed after the reproduce began"),
        ("gamma = 0.95", "gamma = 0.9", "was changed after the reproduce began"),
        ("jobs = 2", "jobs = 3", "was changed after the reproduce began"),
        ("trials = 2", "trials = 0", "trials: Input should be greater than or equal to 1, not 0"),
        ("gamma = 0.95", "gamma = 0.95\ngama = 0.95", r"preset\.update\.gama: unknown key: did you mean gamma\?"),
        ('name = "bar"', 'name = "dot"', "two scenarios are named 'dot'"),
        ('["nested", "single"]', '["nested", "nested"]', "agents: must be some of nested, hierarchical, single"),
        ("seed = 7", "seed = ", "not TOML"),
    ],
)
def test_a_config_that_was_changed_is_one_line(tmp_path: Path, old: str, new: str, says: str) -> None:
    begun(tmp_path)
    text = (tmp_path / CONFIG).read_text("utf-8")
    assert text.count(old) == 1
    (tmp_path / CONFIG).write_text(text.replace(old, new), "utf-8")
    with pytest.raises(UserError, match=says) as caught:
        opened(tmp_path)
    assert "\n" not in str(caught.value)


def test_a_comment_in_the_config_is_no_change(tmp_path: Path) -> None:
    folder = begun(tmp_path)
    (tmp_path / CONFIG).write_text("# on the old laptop\n" + (tmp_path / CONFIG).read_text("utf-8"), "utf-8")
    assert opened(tmp_path).jobs == folder.jobs


def test_a_disk_that_is_full_is_one_line_that_says_how_to_resume(tmp_path: Path) -> None:
    folder = begun(tmp_path / "new")
    with (
        pytest.raises(RunError, match=r"No space left.*make room, then mc-nested reproduce --resume"),
        folder.writing(),
    ):
        raise OSError(28, "No space left on device")


def test_a_folder_that_cannot_be_made_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(RunError, match="name another folder"):
        ExperimentFolder.new(tmp_path / "file" / "new", config(), "reproduce").begin()
