"""``train --from``: what an earlier training gives, and what of it doesn't count for another design."""

import json
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arrays import Arrays
from mc_nested.errors import RunError
from mc_nested.learn.imagination.beliefs import Belief
from mc_nested.learn.imagination.learnt_rules import learn_rules
from mc_nested.learn.runs.checkpoint import FILE
from mc_nested.learn.runs.earlier_run import earlier_run
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.cli.made_imagination import BESIDE, SMALL, write_preset, write_scenario
from tests.cli.running import TRAIN, run, table
from tests.learn.runs.changed_arrays import change_arrays


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a preset, two designs of the same arena, and a training on the first."""
    folder = tmp_path_factory.mktemp("files")
    write_preset(folder / "preset.toml")
    write_scenario(folder / "small.toml", SMALL)
    write_scenario(folder / "beside.toml", BESIDE)
    assert run(*words(folder, "small"), "--trials", "2", "--out", folder / "first") == 0
    return folder


def words(files: Path, design: str) -> tuple[str | Path, ...]:
    """Return the command line's words for a training on that design until its optimum."""
    preset, scenario = files / "preset.toml", files / f"{design}.toml"
    return "train", "--preset", preset, "--scenario", scenario, "--stop-at-optimum", "--seed", "3"


def begun(files: Path, design: str, out: Path) -> Trainer:
    """Return a training on that design that was begun from the first, before its first tick."""
    assert run(*words(files, design), "--episodes", "1", "--out", out) == 0
    folder = RunFolder.open(out)
    agent = folder.new_agent(1)
    env = agent.view_of(GridVectorEnv(folder.scenarios), folder.scenarios)
    trainer = Trainer(env, folder.scenarios, agent, folder.config.preset, 5)
    earlier_run(files / "first", folder).begin(trainer)
    return trainer


def test_a_training_from_an_earlier_run_knows_the_same_design_from_the_beginning(files: Path, tmp_path: Path) -> None:
    assert run(*words(files, "small"), "--from", files / "first", "--out", tmp_path / "again") == 0
    summary = json.loads((tmp_path / "again" / "summary.json").read_text())
    assert summary["episodes_to_optimum"] == [0]
    assert summary["played_to_optimum"][0]["episodes"] == 1
    trainer = begun(files, "small", tmp_path / "begun")
    assert trainer.practice.imagination is not None
    assert trainer.practice.imagination.known_arena(0).known_to_pay == SMALL.blocks
    assert trainer.practice.imagination.episodes(0) == 0


def test_a_training_on_another_design_keeps_moves_and_materials_but_no_cells(files: Path, tmp_path: Path) -> None:
    trainer = begun(files, "beside", tmp_path / "begun")
    assert trainer.practice.imagination is not None
    earlier = earlier_run(files / "first", RunFolder.open(tmp_path / "begun"))
    assert earlier.game is not None
    untried = trainer.practice.imagination.state()["untried"][0]
    assert untried.tolist() == earlier.game["untried"].tolist()
    assert untried.sum() <= 1, "no first tries of what was tried"
    rules, seen = trainer.practice.imagination.rules(0), trainer.practice.imagination.known_arena(0)
    assert rules.known.tolist() == (~untried).tolist()
    steps, first_of_episode = earlier.game["seen.steps"], earlier.game["seen.first_of_episode"]
    learnt = learn_rules(steps, first_of_episode, len(untried), BESIDE.size)
    assert (rules.lands, rules.moves.tolist()) == (learnt.lands, learnt.moves.tolist())
    assert np.isin(seen.cells, (Belief.UNKNOWN, Belief.BELIEVED)).all()
    assert len(trainer.practice.imagination.state()["0.extras"]) > 0
    while not (trainer.episode_rows or trainer.evaluation_rows):
        trainer.tick()
    assert not trainer.evaluation_rows, "a policy of another design isn't worth an episode"


def test_a_training_from_an_earlier_run_takes_fewer_steps_than_from_scratch(files: Path, tmp_path: Path) -> None:
    played = {}
    for name, more in {"scratch": (), "begun": ("--from", files / "first")}.items():
        out = tmp_path / name
        assert run(*words(files, "beside"), *more, "--trials", "3", "--out", out) == 0
        summary = json.loads((out / "summary.json").read_text())
        assert summary["final_scores"] == [BESIDE.optimum] * 3
        played[name] = sum(trial["steps"] for trial in summary["played_to_optimum"])
    assert played["begun"] < played["scratch"]


def test_materials_that_differ_from_the_earlier_runs_are_tried_anew(files: Path, tmp_path: Path) -> None:
    other = (files / "small.toml").read_text("utf-8").replace("10.0", "3.0")
    (files / "poorer.toml").write_text(other, "utf-8")
    trainer = begun(files, "poorer", tmp_path / "begun")
    assert trainer.practice.imagination is not None
    assert len(trainer.practice.imagination.state()["0.extras"]) == 0
    assert trainer.practice.imagination.known_arena(0).known_to_pay == SMALL.blocks


def test_an_earlier_run_without_imagination_gives_its_policy_and_no_learnt_game(tmp_path: Path) -> None:
    trained = tmp_path / "run"
    assert run(*TRAIN, "--out", trained) == 0
    assert run("train", "--episodes", "2", "--from", trained, "--out", tmp_path / "on") == 0
    assert [row["episode"] for row in table(tmp_path / "on" / "evaluations.csv")] == ["0", "2"]
    assert earlier_run(trained, RunFolder.open(tmp_path / "on")).game is None


def forget(state: Arrays) -> None:
    for name in [name for name in state if name.startswith("practice.")]:
        del state[name]


def test_a_checkpoint_without_its_learnt_game_is_refused_in_one_line(
    files: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*words(files, "small"), "--out", tmp_path / "cut") == 0
    checkpoint = tmp_path / "cut" / "checkpoint"
    change_arrays(checkpoint / FILE, forget)
    capsys.readouterr()
    assert run(*words(files, "small"), "--from", tmp_path / "cut", "--out", tmp_path / "new") == 2
    said = capsys.readouterr().err
    assert "holds no learnt game of trial 0: bring back a whole copy" in said
    assert said.count("\n") == 1
    assert not (tmp_path / "new").exists()


def test_a_learnt_game_of_another_shape_is_refused_as_damaged(files: Path, tmp_path: Path) -> None:
    trainer = begun(files, "small", tmp_path / "begun")
    earlier = earlier_run(files / "first", RunFolder.open(tmp_path / "begun"))
    assert earlier.game is not None
    earlier.game["tries"] = np.zeros(3, np.int64)
    with pytest.raises(RunError, match="its learnt game is damaged: train it again"):
        earlier.begin(trainer)
