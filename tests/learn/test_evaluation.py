"""Greedy play: the networks' best actions, each run to its own end; and the steps of an agent with objectives."""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv, step_in
from mc_nested.arena.scenario import Part, Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.evaluation import BuildStep, GreedyEpisode, play_greedily, steps_of, take_steps
from mc_nested.learn.objectives.decide import PATIENCE, Decision, ObjectiveAgent
from mc_nested.learn.objectives.weights import agent_of, shipped_weights
from sim.grid import GridGame, GridVectorEnv
from tests.arena.made_parts import STONE, STRIPES, WOOD
from tests.learn.made_experiments import BAR, DOT, small_preset

LINE = load_scenario("line")


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
    done: list[object] = []
    env = GridVectorEnv([DOT, BAR])
    dot, bar = play_greedily(env, [DOT, BAR], agent, done.append, lambda: done.append("step"))
    # One step back from (7, 13), a block lands in (7, 13): DOT's only cell. Of BAR's three one lands on the design.
    assert (dot.actions, dot.score, dot.material_name(DOT)) == ([Action.BD], 11.0, "stone")
    assert (bar.actions, bar.score) == ([Action.BD] * 3, 11.0)
    assert done == [None, "step"] * 3 + [None]


def test_a_run_that_never_ends_is_cut_off_at_its_step_limit() -> None:
    agent = Agent(AGENT_SPECS["hierarchical"], [DOT], small_preset(), 0)
    always(agent, "main", 0)
    always(agent, "low", Action.F)
    (episode,) = play_greedily(GridVectorEnv([DOT]), [DOT], agent)
    assert (len(episode.actions), episode.score, episode.material) == (DOT.step_limit, -5.0, 0)


def test_an_episode_without_a_choice_has_no_material() -> None:
    assert GreedyEpisode().material_name(DOT) == "no material"
    assert np.isclose(GreedyEpisode().score, 0.0)


def test_steps_are_taken_until_the_episode_ends_and_shown_one_by_one() -> None:
    done: list[object] = []
    # From (7, 13) back, where a block lands in (7, 13): DOT's only cell. The third step comes too late.
    steps = [BuildStep((action, 0), None, (7, 13)) for action in (Action.L, Action.R, Action.BD, Action.B)]
    episode = take_steps(ArenaEnv(GridGame(DOT), DOT), steps, 0, done.append, lambda: done.append("step"))
    assert (episode.actions, episode.materials, episode.score) == ([Action.L, Action.R, Action.BD], [0, 0, 0], -4.0)
    assert done == [(7, 13), "step"] * 3 + [None]


def taken(env: ArenaEnv, steps: Iterator[BuildStep]) -> list[BuildStep]:
    """Return the steps, each done before the next is asked for, up to the episode's end or theirs."""
    done = []
    for step in steps:
        done.append(step)
        _, _, terminated, truncated, _ = env.step(step_in(env.scenario, *step.taken))
        if terminated or truncated:
            break
    return done


def begun(scenario: Scenario) -> tuple[ObjectiveAgent, ArenaEnv]:
    env = ArenaEnv(GridGame(scenario), scenario)
    env.reset()
    return agent_of(shipped_weights(), scenario), env


def test_each_step_but_the_last_is_followed_by_what_it_says() -> None:
    agent, env = begun(LINE)
    steps = taken(env, steps_of(agent, env))
    assert env.placed == LINE.design
    assert [step.following for step in steps] == [*(step.taken for step in steps[1:]), None]


def test_a_step_says_which_cell_it_is_for() -> None:
    agent, env = begun(LINE)
    steps = taken(env, steps_of(agent, env))
    assert {step.objective for step in steps} == LINE.design


@pytest.mark.parametrize(("material", "laid"), [(None, [STONE, STONE, WOOD, WOOD, WOOD]), (STONE, [STONE] * 5)])
def test_each_part_is_built_of_what_is_worth_most_there_or_of_what_is_named(
    material: int | None, laid: list[int]
) -> None:
    agent, env = begun(STRIPES)
    found = []
    for step in steps_of(agent, env, material):
        before = len(env.placed)
        _, _, terminated, _, _ = env.step(step_in(env.scenario, *step.taken))
        found += [step.taken[1]] * (len(env.placed) - before)
        if terminated:
            break
    assert found == laid


def test_the_steps_end_once_every_cell_was_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    agent, env = begun(STRIPES)
    decide = agent.decide
    monkeypatch.setattr(agent, "decide", lambda *seen: (Decision(Action.B, STONE), decide(*seen)[1]))
    steps = []
    for step in steps_of(agent, env):
        steps.append(step)
        assert len(steps) < 1000
    patience = PATIENCE * (STRIPES.size + 2)
    assert len(steps) == 2 * patience + 1  # two cells in the first part; the one more finds out that none is left
    assert steps[-1].following is None


def test_there_is_no_step_where_a_block_is_left_and_no_cell_for_it() -> None:
    ends, middle = frozenset({(1, 3), (3, 3)}), frozenset({(2, 3)})
    parts = (Part(ends, (-5.0, 10.0)), Part(middle, (6.0, -3.0)))
    agent, env = begun(replace(STRIPES, design=ends | middle, parts=parts))
    for action in (Action.FD, Action.RD):  # (1, 3), and as the second block of the first part (2, 3)
        env.step((action, STONE))
    assert env.placed == {(1, 3), (2, 3)}
    assert list(steps_of(agent, env)) == []
