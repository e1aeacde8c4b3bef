"""Facts that a list of runs shows of each folder, in any state."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from mc_nested.errors import RunError
from mc_nested.learn.runs.checkpoint import FILE as STATE
from mc_nested.learn.runs.checkpoint import fingerprint
from mc_nested.learn.runs.folder_kind import FORMAT
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.studies.arm import Arm
from mc_nested.studies.benchmark import baseline
from mc_nested.studies.config import config_of
from mc_nested.studies.folder import StudyFolder
from mc_nested.studies.outcome import JobOutcome, RunOutcome, write_outcome
from mc_nested.studies.run_facts import RunFacts, facts_of, runs_in
from tests.learn.made_experiments import BAR, DOT, small_preset
from tests.learn.made_trainings import finish
from tests.learn.runs.changed_arrays import change_arrays
from tests.learn.runs.test_run_folder import begun, trainer_in


@pytest.fixture(scope="module")
def trained(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a finished training of two trials of ten episodes."""
    folder = begun(tmp_path_factory.mktemp("runs") / "done")
    folder.save(finish(trainer_in(folder)), 1.0)
    return folder.path


def known(folder: Path) -> RunFacts:
    facts = facts_of(folder)
    assert facts is not None
    return facts


def study(path: Path, name: str, arms: list[Arm], finished: bool) -> StudyFolder:
    """Return a study whose jobs, or all but the last one, are finished."""
    folder = StudyFolder.new(path, config_of(name, arms, trials=2, seed=7, jobs=1))
    folder.begin()
    for job in folder.jobs if finished else folder.jobs[:-1]:
        run = RunOutcome(evaluations=[], score=11.0, updates=1, env_steps=1)
        runs = [run] * len(job.trials)
        outcome = JobOutcome(identity=fingerprint(job.identity()), networks=1, parameters=1, seconds=1.0, runs=runs)
        write_outcome(folder.folder_of(job), outcome)
    return folder


def test_a_finished_training_has_the_mean_of_its_scores(trained: Path, tmp_path: Path) -> None:
    shutil.copytree(trained, tmp_path / "run")
    change_arrays(
        tmp_path / "run" / "checkpoint" / STATE,
        lambda state: state.update({"policies.scores": np.array([10.0, 11.0])}),
    )
    facts = known(tmp_path / "run")
    assert (facts.verb, facts.state, facts.why) == ("train", "finished", None)
    assert (facts.designs, facts.agents, facts.presets) == (["dot"], ["nested"], ["small"])
    assert (facts.trials, facts.episodes_done, facts.episodes) == (2, 20, 20)
    assert (facts.score, facts.optimum) == (10.5, 11.0)


def test_a_runs_size_counts_all_files_and_follows_no_links(tmp_path: Path) -> None:
    folder = begun(tmp_path / "run")
    (tmp_path / "large").write_bytes(bytes(10_000))
    (folder.path / "inside").mkdir()
    (folder.path / "inside" / "file").write_bytes(bytes(500))
    before = known(folder.path)
    (folder.path / "link").symlink_to(tmp_path / "large")
    after = known(folder.path)
    assert before.size == (folder.path / "config.toml").stat().st_size + 500
    assert after.size - before.size < 1000


def test_a_stopped_training_can_be_resumed(tmp_path: Path) -> None:
    folder = begun(tmp_path / "run")
    facts = known(folder.path)
    assert (facts.state, facts.episodes_done, facts.score) == ("can be resumed", 0, None)
    trainer = trainer_in(folder)
    while trainer.episodes_done.sum() < 6:
        trainer.tick()
    folder.save(trainer, 1.0)
    facts = known(folder.path)
    assert facts.state == "can be resumed"
    assert facts.episodes_done == trainer.episodes_done.sum()


def test_a_folder_where_a_process_writes_is_in_use(trained: Path) -> None:
    with folder_lock(trained):
        facts = known(trained)
    assert facts.state == "in use"
    assert (facts.why or "").startswith("process ")


@pytest.mark.parametrize(
    ("file", "content", "why"),
    [
        ("config.toml", "agent = [", "not TOML"),
        ("config.toml", f'format = {FORMAT}\nagent = "nested"', "missing: add it"),
        ("config.toml", 'agent = "nested"', "written by another version of mc-nested"),
        ("config.toml", "\0", "not TOML"),
        (f"checkpoint/{STATE}", "x", "damaged or cut short"),
        (f"checkpoint/{STATE}", None, "the checkpoint is gone"),
    ],
)
def test_a_damaged_folder_says_why(trained: Path, tmp_path: Path, file: str, content: str | None, why: str) -> None:
    run = tmp_path / "run"
    shutil.copytree(trained, run)
    (run / file).unlink()
    if content is not None:
        (run / file).write_text(content)
    facts = known(run)
    assert facts.state == "damaged"
    assert why in (facts.why or "")
    assert "\n" not in (facts.why or "")


BOTH = [Arm(agent, small_preset(), [DOT, BAR], 2, agent, "my/small.toml") for agent in ("nested", "single")]
SB3_TOO = [BOTH[0], Arm("sb3, dqn", baseline(), [DOT, BAR], 2, "sb3", "dqn", together=1)]
LABELLED = [Arm("images: numbers", small_preset(), [DOT, BAR], 2, labels={"agent": "numbers"})]


@pytest.mark.parametrize(
    ("name", "verb", "arms", "agents", "presets", "episodes"),
    [
        ("reproduce", "reproduce", BOTH, ["nested", "single"], ["small"], 160),
        ("sweep", "study sweep", BOTH, ["nested", "single"], ["small"], 160),
        ("benchmark", "study benchmark", SB3_TOO, ["nested", "sb3"], ["small", "dqn"], 2080),
        ("beyond", "study beyond", LABELLED, ["numbers"], ["paper"], 80),
    ],
    ids=["reproduce", "sweep", "benchmark", "beyond"],
)
def test_a_study_counts_the_episodes_of_finished_jobs(
    name: str, verb: str, arms: list[Arm], agents: list[str], presets: list[str], episodes: int, tmp_path: Path
) -> None:
    facts = known(study(tmp_path / "whole", name, arms, finished=True).path)
    assert (facts.verb, facts.state, facts.designs) == (verb, "finished", ["dot", "bar"])
    assert (facts.agents, facts.presets, facts.trials) == (agents, presets, 2)
    assert (facts.episodes_done, facts.episodes) == (episodes, episodes)
    unfinished = study(tmp_path / "part", name, arms, finished=False)
    part = known(unfinished.path)
    assert part.episodes_done == episodes - unfinished.jobs[-1].episodes
    assert part.state == "can be resumed"
    (outcome, *_) = (tmp_path / "whole" / "jobs").glob("*/outcome.json")
    outcome.write_text("{")
    broken = known(tmp_path / "whole")
    assert broken.state == "damaged"
    assert "can't be read as the outcome of a training" in (broken.why or "")


@pytest.mark.parametrize("text", [None, "[tool]\nname = 'another program'\n", "agent = ["])
def test_folders_without_a_config_of_this_project_are_not_listed(text: str | None, tmp_path: Path) -> None:
    if text is not None:
        (tmp_path / "config.toml").write_text(text)
    assert facts_of(tmp_path) is None


def test_runs_in_lists_a_folders_runs_by_name_and_a_run_by_itself(trained: Path, tmp_path: Path) -> None:
    for name in ("b", "a"):
        shutil.copytree(trained, tmp_path / name)
    (tmp_path / "other").mkdir()
    (tmp_path / "file").touch()
    assert [facts.folder.name for facts in runs_in(tmp_path)] == ["a", "b"]
    assert [facts.folder for facts in runs_in(tmp_path / "a")] == [tmp_path / "a"]
    assert runs_in(tmp_path / "nothing") == []
    with pytest.raises(RunError, match="can't be listed, Not a directory"):
        runs_in(tmp_path / "file")
