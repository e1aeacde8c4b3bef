"""The agent's steps in an Env: what they announce, what they are made of, and where they end."""

from collections.abc import Iterator
from dataclasses import replace

import pytest

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv, step_in
from mc_nested.arena.scenario import Part, Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.objectives.building import Step, steps_of
from mc_nested.learn.objectives.decide import PATIENCE, Decision, ObjectiveAgent
from mc_nested.learn.objectives.weights import agent_of, shipped_weights
from sim.grid import GridGame
from tests.arena.made_parts import STONE, STRIPES, WOOD

LINE = load_scenario("line")


def taken(env: ArenaEnv, steps: Iterator[Step]) -> list[Step]:
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
    steps = taken(env, steps_of(agent, env, material))
    assert [step.taken[1] for step in steps if step.taken[0] >= Action.FD] == laid


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
