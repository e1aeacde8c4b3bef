"""What an agent learns from an episode that was played elsewhere."""

import numpy as np
import pytest

from mc_nested.arena.builder import build
from mc_nested.arena.demonstration import Demonstration, ShownStep
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from mc_nested.learn.whole_episode import as_seen
from sim.grid import GridGame, GridVectorEnv
from tests.learn.made_trainings import SHORT

LINE = load_scenario("line")
STONE = 1


def shown_line() -> Demonstration:
    """Return the line as the scripted builder builds it, of stone."""
    game = GridGame(LINE)
    game.reset(STONE)
    return Demonstration(STONE, [ShownStep(action, STONE, game.act(action)) for action in build(LINE)])


@pytest.mark.parametrize("name", AGENT_SPECS)
def test_an_agent_sees_the_choice_and_the_actions_as_its_own(name: str) -> None:
    agent = Agent(AGENT_SPECS[name], [LINE], SHORT, 0)
    episode, shown = as_seen(agent, LINE, shown_line()), shown_line()
    actions = [int(step.action) for step in shown.steps]
    assert episode.actions.tolist() == (actions if agent.main else [STONE, *(2 + action for action in actions)])
    assert (episode.earned[-1], episode.terminated) == (LINE.optimum, True)
    assert sum(episode.rewards) == (LINE.blocks if agent.main else LINE.optimum)
    assert len(episode.observations) == len(episode.materials) == len(episode.actions) + 1


@pytest.mark.parametrize(
    ("name", "preset"),
    [*((name, "paper") for name in AGENT_SPECS), ("nested", "tuned"), ("nested", "model-based")],
)
def test_a_demonstration_counts_as_a_training_episode_and_is_learnt_from(name: str, preset: str) -> None:
    hyper = load_preset(preset)
    agent = Agent(AGENT_SPECS[name], [LINE, LINE], hyper, 0)
    env = agent.view_of(GridVectorEnv([LINE, LINE]), [LINE, LINE])
    trainer = Trainer(env, [LINE, LINE], agent, hyper, 0)
    episode = as_seen(agent, LINE, shown_line())
    trainer.learn_from(episode)
    steps = len(episode.actions)
    assert trainer.demonstrated.tolist() == trainer.episodes_done.tolist() == [1, 1]
    assert [(row.score, row.steps) for row in trainer.episode_rows] == [(LINE.optimum, steps)] * 2
    if imagination := trainer.practice.imagination:
        assert all(imagination.has_experience(run) for run in (0, 1))
    else:
        assert agent.low_level.replay.added.sum() == 2 * steps


def test_the_same_demonstration_and_seed_train_the_same() -> None:
    trained = []
    for _ in range(2):
        agent = Agent(AGENT_SPECS["nested"], [LINE], SHORT, 3)
        trainer = Trainer(GridVectorEnv([LINE]), [LINE], agent, SHORT, 3)
        trainer.learn_from(as_seen(agent, LINE, shown_line()))
        while not trainer.finished:
            trainer.tick()
        trained.append((trainer.episode_rows, trainer.agent.low_level.engine.online.copy()))
    assert trained[0][0] == trained[1][0]
    np.testing.assert_array_equal(trained[0][1], trained[1][1])
