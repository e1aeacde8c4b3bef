"""A training's folder: what it holds, how it is opened again, and what a full disk leaves."""

import os
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arrays import Arrays
from mc_nested.errors import PresetError, RunError
from mc_nested.learn.episode_log import EpisodeRow, EvaluationRow
from mc_nested.learn.runs.checkpoint import unsealed
from mc_nested.learn.runs.folder_lock import folder_lock
from mc_nested.learn.runs.run_config import RunConfig
from mc_nested.learn.runs.run_folder import RunFolder, summarise
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.cli.running import table
from tests.full_disk import full_disk
from tests.learn.made_experiments import run_config, small_preset
from tests.learn.made_trainings import finish
from tests.learn.runs.changed_arrays import change_arrays


def config_of(trials: int = 2, profile: str | None = None) -> RunConfig:
    return run_config(profile=profile, trials=trials, seed=4, preset=small_preset(10))


def trainer_in(folder: RunFolder) -> Trainer:
    agent = folder.new_agent(folder.config.trials)
    env = agent.view_of(GridVectorEnv(folder.scenarios), folder.scenarios)
    return Trainer(env, folder.scenarios, agent, folder.config.preset, folder.config.seed)


def begun(path: Path) -> RunFolder:
    folder = RunFolder.new(path, config_of())
    folder.begin()
    return folder


def test_a_run_moved_to_another_device_keeps_its_identity_and_still_plays_on_the_cpu(tmp_path: Path) -> None:
    torch = config_of().preset.changed(engine="torch")
    here = config_of().model_copy(update={"preset": torch})
    there = here.model_copy(update={"preset": torch.changed(device="cuda")})
    assert there.preset.device == "cuda"
    assert there.identity() == here.identity()
    assert RunFolder(tmp_path, there).new_agent(1).networks == 2, "no such device is needed to play it"
    with pytest.raises(PresetError, match='device "cuda" needs engine "torch"'):
        config_of().preset.changed(device="cuda")


def test_a_begun_folder_is_opened_with_its_config_and_never_overwritten(tmp_path: Path) -> None:
    folder = begun(tmp_path / "run")
    assert RunFolder.open(tmp_path / "run").config == folder.config
    assert folder.only_begun
    assert folder.wall_s_so_far() == 0.0
    with pytest.raises(RunError, match="nothing was overwritten"):
        RunFolder.new(tmp_path / "run", config_of())


def test_a_runs_identity_ignores_the_profile_but_not_the_number_of_trials() -> None:
    assert config_of().identity() == config_of(profile="moved").identity()
    assert config_of().identity() != config_of(trials=3).identity()
    assert "format" not in config_of().identity()


def test_an_unfinished_training_has_no_final_scores_and_a_finished_one_has_everything(tmp_path: Path) -> None:
    folder = begun(tmp_path)
    trainer = trainer_in(folder)
    trainer.tick()
    early = folder.save(trainer, 1.5, {"live": {}})
    assert (early["final_scores"], early["live"]) == ([None, None], {})
    assert not folder.only_begun
    summary = folder.save(finish(trainer), 2.5)
    assert unsealed(tmp_path / "summary.json") == summary
    assert folder.wall_s_so_far() == 2.5
    assert summary["episodes_done"] == [10, 10]
    assert summary["final_scores"] == trainer.policy_scores.tolist()
    rows = table(tmp_path / "episodes.csv")
    assert len(rows) == 20
    assert sum(int(row["steps"]) for row in rows) == summary["env_steps"]


def test_played_to_optimum_counts_greedy_episodes_too(tmp_path: Path) -> None:
    folder = RunFolder.new(tmp_path, config_of())
    trainer = trainer_in(folder)
    trainer.episode_rows += [EpisodeRow(0, number, 1.0, 1, number, 0.5, 0.5) for number in range(1, 9)]
    trainer.episode_rows += [EpisodeRow(1, 1, 1.0, 1, 4, 0.5, 0.5)]
    trainer.evaluation_rows += [
        EvaluationRow(0, 0, 1.0, 1, 4),
        EvaluationRow(0, 5, 11.0, 1, 1),
        EvaluationRow(0, 8, 11.0, 1, 1),
        EvaluationRow(1, 0, 10.9, 1, 4),
    ]
    summary = summarise(folder.config, folder.scenario, trainer, 1.23456)
    assert summary["episodes_to_optimum"] == [5, None]
    # Five episodes of 1 to 5 steps, and the greedy ones of 4 and 1 steps.
    assert summary["played_to_optimum"] == [{"episodes": 7, "steps": 20}, None]
    assert (summary["wall_s"], summary["optimum"], summary["networks"]) == (1.235, 11.0, 2)


def test_policies_are_read_back_from_the_checkpoint(tmp_path: Path) -> None:
    folder = begun(tmp_path)
    with pytest.raises(RunError, match=f"nothing is trained yet: .* --resume {re.escape(str(tmp_path))}$"):
        folder.policies()
    trainer = finish(trainer_in(folder))
    folder.save(trainer, 1.0)
    found = RunFolder.open(tmp_path).policies()
    assert {name: (array.dtype, array.tobytes()) for name, array in found.items()} == {
        name: (array.dtype, array.tobytes()) for name, array in trainer.policies.items()
    }


def test_a_run_that_another_process_trains_and_has_not_saved_yet_says_to_wait(tmp_path: Path) -> None:
    folder = begun(tmp_path)
    with folder_lock(tmp_path), pytest.raises(RunError) as caught:
        folder.policies()
    assert str(caught.value) == (
        f"{tmp_path}: process {os.getpid()} is training it, and has saved nothing yet: wait for a minute"
    )


def test_a_summary_that_was_changed_is_refused_in_one_line(tmp_path: Path) -> None:
    folder = begun(tmp_path)
    folder.save(trainer_in(folder), 12.5)
    summary = (tmp_path / "summary.json").read_text("utf-8")
    (tmp_path / "summary.json").write_text(summary.replace("12.5", "13.5"), "utf-8")
    with pytest.raises(RunError, match=r"summary\.json: is damaged: remove it, and the seconds are counted"):
        folder.wall_s_so_far()
    (tmp_path / "summary.json").unlink()
    assert folder.wall_s_so_far() == 0.0


def test_a_full_disk_is_reported_and_leaves_no_half_begun_checkpoint(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = RunFolder.new(tmp_path / "run", config_of())
    monkeypatch.setattr("os.fsync", full_disk)
    with pytest.raises(RunError, match="make room and begin again"):
        folder.save_before_all(trainer_in(folder))
    assert not (tmp_path / "run" / "checkpoint").exists()
    with pytest.raises(RunError, match=r"no space left on the disk\): name another folder, or make room"):
        folder.begin()
    with pytest.raises(RunError, match="make room, then mc-nested train --resume"):
        folder.save(trainer_in(folder), 0.0)


MISFITS: dict[str, Callable[[Arrays], object]] = {
    "no network": lambda state: state.pop("policies.low"),
    "no scores": lambda state: state.pop("policies.scores"),
    "another network": lambda state: state.update({"policies.main": np.zeros((1, 7), np.float32)}),
    "a trial more": lambda state: state.update({"policies.scores": np.zeros(3)}),
}
"""What a whole checkpoint can hold where a network of one's own was changed since."""


@pytest.mark.parametrize("misfit", MISFITS)
def test_policies_that_do_not_fit_the_preset_are_refused_with_the_checkpoints_file_name(
    misfit: str, tmp_path: Path
) -> None:
    folder = begun(tmp_path)
    trainer = trainer_in(folder)
    folder.save(trainer, 1.0)
    assert folder.policies().keys() == trainer.policies.keys()
    change_arrays(folder.checkpoint.file, MISFITS[misfit])
    with pytest.raises(RunError, match=re.escape(f"{folder.checkpoint.file}: holds networks of another shape")):
        folder.policies()
