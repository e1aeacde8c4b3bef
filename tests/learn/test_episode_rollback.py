"""A rollback restores networks, exploration and replay to what they were at the start of the episode."""

import numpy as np

from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.episode_rollback import EpisodeRollback
from mc_nested.learn.exploration.batched_return_then_explore import NUMBERS, BatchedReturnThenExplore
from mc_nested.learn.preset import ExcursionRule
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv
from tests.learn.imagination.made_games import BENT, SMALL
from tests.learn.made_experiments import DOT, small_preset

RULE = ExcursionRule(at_end=0.1, wander=3, rejoin=0.4, repeat=0.8)


def play(agent: Agent, explorer: BatchedReturnThenExplore, steps: int) -> None:
    run, states = np.array([0]), np.array([[7, 13, 1, 1]])
    explorer.begin(run, np.zeros((1, NUMBERS)))
    for _ in range(steps):
        after = states - [[0, 0, 1, 0]]
        seen = states, np.array([7]), np.ones(1), after, np.array([True])
        agent.low_level.store(run, *seen)
        explorer.observe(run, states[:, :3], *seen, run)
        agent.low_level.learn(run, np.zeros((1, 4)))
    explorer.end(run)


def test_what_an_episode_taught_is_undone() -> None:
    agent = Agent(AGENT_SPECS["nested"], [DOT], small_preset(), 0)
    explorer = BatchedReturnThenExplore(RULE, agent, [DOT])
    play(agent, explorer, 5)
    before = EpisodeRollback.of(agent, {"explorer": explorer})
    kept = {name: array.copy() for name, array in {**agent.state(), **explorer.state()}.items()}
    play(agent, explorer, 3)
    assert agent.low_level.replay.added.tolist() == [8]
    assert not np.array_equal(agent.low_level.engine.online, kept["low.online"])
    before.restore(agent, {"explorer": explorer})
    assert agent.low_level.replay.added.tolist() == [5]
    for name, array in {**agent.state(), **explorer.state()}.items():
        np.testing.assert_array_equal(array, kept[name], err_msg=name)


def test_what_an_episode_showed_a_learnt_game_is_forgotten() -> None:
    trainer = Trainer(GridVectorEnv([BENT]), [BENT], Agent(AGENT_SPECS["nested"], [BENT], SMALL, 0), SMALL, 0)
    while len(trainer.episode_rows) < 2:
        trainer.tick()
    agent, recorders = trainer.agent, trainer._recorders
    assert list(recorders) == ["imagination"]
    before = EpisodeRollback.of(agent, recorders)
    kept = {name: array.copy() for name, array in {**agent.state(), **recorders["imagination"].state()}.items()}
    while len(trainer.episode_rows) < 4:
        trainer.tick()
    assert len(recorders["imagination"].state()["0.steps"]) > len(kept["0.steps"])
    assert (agent.state()["low.online"] != kept["low.online"]).any()
    before.restore(agent, recorders)
    for name, array in {**agent.state(), **recorders["imagination"].state()}.items():
        np.testing.assert_array_equal(array, kept[name], err_msg=name)


def test_without_exploration_the_agent_alone_is_restored() -> None:
    agent = Agent(AGENT_SPECS["nested"], [DOT], small_preset(), 0)
    before, online = EpisodeRollback.of(agent, {}), agent.low_level.engine.online.copy()
    play(agent, BatchedReturnThenExplore(RULE, agent, [DOT]), 4)
    before.restore(agent, {})
    np.testing.assert_array_equal(agent.low_level.engine.online, online)
    assert agent.low_level.replay.added.tolist() == [0]
