"""The contract of every Env, whatever game is behind it; test_env_contract checks that wrong Envs fail it."""

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.builder import build
from mc_nested.arena.rules import landing, moved
from mc_nested.arena.scenario import Scenario


def check_env_contract(env: gymnasium.Env[Any, Any], scenario: Scenario, actions: Sequence[Action]) -> None:
    """Raise AssertionError where the Env returns something else than the task says.

    Three episodes: of these actions, which end none; of the builder, to the optimum; and one to the step limit. The
    scenario's first material must not be its best one.
    """
    _check_spaces(env, scenario)
    best, first = scenario.materials[scenario.best_material].name, scenario.materials[0].name

    _check_reset(env.reset(seed=1), env, scenario, best)
    _follow(env, scenario, actions)

    _check_reset(env.reset(options={"material": first}), env, scenario, first)
    *_, last = _follow(env, scenario, build(scenario))
    assert last[2:4] == (True, False), "the last block ends the episode"
    assert last[4]["score"] == scenario.blocks + scenario.materials[0].p, "the last step brings r_M"
    with pytest.raises(ResetNeeded):
        env.step(Action.F)

    _check_reset(env.reset(), env, scenario, best)
    *earlier, last = _follow(env, scenario, [Action.F] * scenario.step_limit)
    assert not any(step[2] or step[3] or "score" in step[4] for step in earlier), "no step before the last ends it"
    assert last[2:4] == (False, True), "the step limit truncates the episode"
    assert last[4]["score"] == scenario.materials[scenario.best_material].p, "and brings r_M"


def _check_spaces(env: gymnasium.Env[Any, Any], scenario: Scenario) -> None:
    highest = np.array([scenario.size - 1, scenario.size - 1, scenario.blocks])
    assert env.observation_space == gymnasium.spaces.Box(np.zeros(3, np.int64), highest, dtype=np.int64), "the space"
    assert env.action_space == gymnasium.spaces.Discrete(8), "eight actions"


def _check_reset(
    begun: tuple[Any, dict[str, Any]], env: gymnasium.Env[Any, Any], scenario: Scenario, material: str
) -> None:
    observation, info = begun
    assert env.observation_space.contains(observation), "a reset returns an observation of the space"
    assert observation.tolist() == list(scenario.start_state), "an episode begins on the start cell, with every block"
    assert info == {"material": material}, "the material is the one asked for, or the best"


def _follow(env: gymnasium.Env[Any, Any], scenario: Scenario, actions: Sequence[Action]) -> list[tuple[Any, ...]]:
    """Do the actions, compare each step with the rules, and return the Env's steps."""
    cell, placed, steps = scenario.start, set[Cell](), list[tuple[Any, ...]]()
    for action in actions:
        step = env.step(action)
        steps.append(step)
        observation, reward, _, _, info = step
        cell = moved(cell, action, placed, scenario.size)
        block = landing(cell, action, placed, scenario.size)
        placed |= {block} if block else set()
        assert env.observation_space.contains(observation), "a step returns an observation of the space"
        assert observation.tolist() == [*cell, scenario.blocks - len(placed)], f"{action.name} leads to {cell}"
        assert type(reward) is float, "a reward is a float"
        assert reward == float(block in scenario.design), f"{action.name} earns {block in scenario.design}"
        assert info.get("placed") == block, f"{action.name} places a block in {block}"
    return steps
