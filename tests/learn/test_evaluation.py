"""Greedy play: the networks' best actions, each run to its own end."""

import numpy as np

from mc_nested.arena.action import Action
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.evaluation import GreedyEpisode, play_greedily
from sim.grid import GridVectorEnv
from tests.learn.made_experiments import BAR, DOT, small_preset


def always(agent: Agent, role: str, action: int) -> None:
    """Make the networks prefer one action in every state: all parameters 0 but that output's bias."""
    learner = {"main": agent.main, "low": agent.low_level}[role]
    assert learner is not None
    online = learner.engine.online
    online[:] = 0.0
    outputs, width = learner.states.actions, learner.engine.form.numbers[-2] + 1
    online[:, -outputs * width :].reshape(-1, outputs, width)[:, action, -1] = 1.0


def test_each_run_plays_to_its_own_end() -> None:
    agent = Agent(AGENT_SPECS["nested"], [DOT, BAR], small_preset(), 0)
    always(agent, "main", 1)
    always(agent, "low", Action.BD)
    steps: list[int] = []
    dot, bar = play_greedily(GridVectorEnv([DOT, BAR]), [DOT, BAR], agent, lambda: steps.append(1))
    # One step back from (7, 13), a block lands in (7, 13): DOT's only cell. Of BAR's three one lands on the design.
    assert (dot.actions, dot.score, dot.material_name(DOT)) == ([Action.BD], 11.0, "stone")
    assert (bar.actions, bar.score) == ([Action.BD] * 3, 11.0)
    assert len(steps) == 3


def test_a_run_that_never_ends_is_cut_off_at_its_step_limit() -> None:
    agent = Agent(AGENT_SPECS["hierarchical"], [DOT], small_preset(), 0)
    always(agent, "main", 0)
    always(agent, "low", Action.F)
    (episode,) = play_greedily(GridVectorEnv([DOT]), [DOT], agent)
    assert (len(episode.actions), episode.score, episode.material) == (DOT.step_limit, -5.0, 0)


def test_an_episode_without_a_choice_has_no_material() -> None:
    assert GreedyEpisode().material_name(DOT) == "no material"
    assert np.isclose(GreedyEpisode().score, 0.0)
