"""A learner's run on disk: saved as any training's is, and resumed with several games, with one, or by a trainer."""

from pathlib import Path

import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.run_folder import RunFolder
from mc_nested.learn.trainer import Trainer
from sim.grid import GridGame
from tests.learn.games.lockstep import finish, game_of
from tests.learn.games.test_one_game import assert_same
from tests.learn.imagination.made_games import BENT, SMALL
from tests.learn.made_experiments import run_config, small_preset
from tests.learn.made_trainings import finish as finished

SEED = 4


def folder_in(path: Path, preset: Preset = SMALL) -> RunFolder:
    folder = RunFolder.new(path, run_config(BENT, seed=SEED, preset=preset))
    folder.begin()
    return folder


def learner_in(folder: RunFolder) -> GamesTrainer:
    return GamesTrainer(folder.scenario, folder.new_agent(1), folder.config.preset, SEED)


def trainer_in(folder: RunFolder) -> Trainer:
    arena = ArenaVectorEnv([ArenaEnv(GridGame(BENT), BENT)])
    return Trainer(arena, folder.scenarios, folder.new_agent(1), folder.config.preset, SEED)


@pytest.mark.parametrize("preset", [SMALL, small_preset(12)], ids=["imagining", "paper"])
def test_a_resumed_learner_finishes_with_the_same_files_as_an_uninterrupted_one(tmp_path: Path, preset: Preset) -> None:
    whole, halved, play = (
        folder_in(tmp_path / "whole", preset),
        folder_in(tmp_path / "halved", preset),
        game_of(BENT, preset),
    )
    summary = whole.save(finish(learner_in(whole), play), 1.0)
    first = learner_in(halved)
    while len(first.episode_rows) < 6:
        first.take(play(first.plan("game")))
    halved.save(first, 1.0)
    first.plan("lost")
    reopened = RunFolder.open(halved.path)
    resumed = learner_in(reopened)
    reopened.checkpoint.load_into(resumed)
    assert reopened.save(finish(resumed, play), 1.0) == summary
    for name in ("episodes.csv", "evaluations.csv", "summary.json", "checkpoint/state.npz"):
        assert (halved.path / name).read_bytes() == (whole.path / name).read_bytes(), name
    assert summary["episodes_done"] == [12]
    assert summary["final_scores"] == [resumed.policy_scores[0]]


def test_a_trainer_resumes_a_learners_run_and_a_learner_a_trainers(tmp_path: Path) -> None:
    alone, play = finished(trainer_in(folder_in(tmp_path / "alone"))), game_of(BENT, SMALL)
    begun_by_games, begun_by_trainer = folder_in(tmp_path / "games"), folder_in(tmp_path / "trainer")

    learner = learner_in(begun_by_games)
    while len(learner.episode_rows) < 6:
        learner.take(play(learner.plan("game")))
    begun_by_games.save(learner, 1.0)
    trainer = trainer_in(begun_by_games)
    begun_by_games.checkpoint.load_into(trainer)
    finished(trainer)
    assert trainer.episode_rows == alone.episode_rows
    assert trainer.evaluation_rows == alone.evaluation_rows

    trainer = trainer_in(begun_by_trainer)
    while len(trainer.episode_rows) < 6:
        trainer.tick()
    begun_by_trainer.save(trainer, 1.0)
    learner = learner_in(begun_by_trainer)
    begun_by_trainer.checkpoint.load_into(learner)
    assert_same(finish(learner, play), alone)
