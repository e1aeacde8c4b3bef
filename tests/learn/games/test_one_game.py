"""A learner with one game, whose episode is taken before the next is planned, is a trainer of one run, to the bit."""

import numpy as np
import pytest

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.arrays import Arrays
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.games.games_trainer import GamesTrainer
from mc_nested.learn.imagination.background_practice import Background
from mc_nested.learn.preset import Preset, load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.training import Training
from sim.grid import GridGame
from tests.learn.games.lockstep import finish, game_of, learner_of
from tests.learn.imagination.made_games import BENT, SMALL, TWO
from tests.learn.made_trainings import finish as finished
from tests.learn.test_training_beside_a_live_game import ENOUGH, Rounds, Slow

OF_THE_ARENA = {"observations", "materials", "steps_in_episode", "between_episodes", "evaluating", "by_hand"}
"""Where a trainer is in its episode, which a learner leaves to its games."""


def trainer_of(
    scenario: Scenario,
    preset: Preset,
    agent: str,
    seed: int,
    *,
    stops: bool = False,
    game: GridGame | None = None,
    background: Background | None = None,
) -> Trainer:
    arena = ArenaVectorEnv([ArenaEnv(game or GridGame(scenario), scenario)])
    trains = Agent(AGENT_SPECS[agent], [scenario], preset, seed)
    return finished(Trainer(trains.view_of(arena, [scenario]), [scenario], trains, preset, seed, stops, background))


def state_of(training: Training) -> Arrays:
    return training.state()


def assert_same(learner: GamesTrainer, trainer: Trainer) -> None:
    """Raise AssertionError unless both came to the same, and would save the same, to the bit."""
    own, expected = state_of(learner), state_of(trainer)
    assert learner.episode_rows == trainer.episode_rows
    assert learner.evaluation_rows == trainer.evaluation_rows
    for name, kept in trainer.policies.items():
        np.testing.assert_array_equal(learner.policies[name], kept, err_msg=name)
    of_the_arena = {f"runs.{name}" for name in OF_THE_ARENA} | {name for name in expected if name.startswith("env.")}
    assert own.keys() - {"planned"} == expected.keys() - of_the_arena
    for name in own.keys() - {"planned"}:
        assert own[name].dtype == expected[name].dtype, name
        np.testing.assert_array_equal(own[name], expected[name], err_msg=name)
    for name, rows in trainer.journal(None).items():
        np.testing.assert_array_equal(learner.journal(None)[name], rows, err_msg=name)
    for name in ("episodes_done", "runs_finished", "policy_scores", "epsilon"):
        np.testing.assert_array_equal(getattr(learner, name), getattr(trainer, name), err_msg=name)


@pytest.mark.parametrize("agent", ["nested", "hierarchical"])
@pytest.mark.parametrize("design", [BENT, TWO], ids=["bent", "two"])
@pytest.mark.parametrize("seed", range(2))
def test_a_learner_with_one_game_trains_as_a_trainer_does(design: Scenario, agent: str, seed: int) -> None:
    learner = finish(learner_of(design, SMALL, agent=agent, seed=seed), game_of(design, SMALL, agent))
    assert_same(learner, trainer_of(design, SMALL, agent, seed))


def test_a_learner_with_one_game_stops_at_the_optimum_as_a_trainer_does() -> None:
    learner = finish(learner_of(BENT, SMALL, stops=True), game_of(BENT, SMALL))
    assert learner.evaluation_rows[-1].score == BENT.optimum
    assert len(learner.episode_rows) < SMALL.episodes
    assert_same(learner, trainer_of(BENT, SMALL, "nested", 0, stops=True))


@pytest.mark.slow
@pytest.mark.parametrize("agent", ["nested", "hierarchical"])
@pytest.mark.parametrize("design", ["line", "zigzag", "islands"])
def test_a_learner_with_preset_model_based_trains_on_shipped_designs_as_a_trainer_does(design: str, agent: str) -> None:
    scenario, preset = load_scenario(design), load_preset("model-based").model_copy(update={"episodes": 15})
    learner = finish(learner_of(scenario, preset, agent=agent), game_of(scenario, preset, agent))
    assert_same(learner, trainer_of(scenario, preset, agent, 0))


@pytest.mark.slow
def test_a_learner_trains_as_a_trainer_with_enough_practice_time_beside_a_live_game() -> None:
    scenario, preset = load_scenario("line"), load_preset("model-based").model_copy(update={"episodes": 5})
    learner = finish(learner_of(scenario, preset), game_of(scenario, preset))
    beside = trainer_of(scenario, preset, "nested", 0, game=Slow(scenario), background=Rounds(ENOUGH))
    assert learner.episode_rows == beside.episode_rows
    assert learner.evaluation_rows == beside.evaluation_rows
    for name, kept in beside.agent.state().items():
        np.testing.assert_array_equal(learner.agent.state()[name], kept, err_msg=name)
