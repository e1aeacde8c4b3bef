"""Independent single agents in one arena: whose material counts, and what every action does."""

import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.cooperative.single_team import SingleTeamEnv
from mc_nested.arena.cooperative.team import team_of
from mc_nested.arena.cooperative.team_env import TeamEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from sim.grid import GridVectorEnv
from sim.team_grid import TeamGrid

LINE = load_scenario("line")
WOOD, STONE, F, B, L, R, FD, LD, RD, BD = range(10)


def singles(builders: int) -> SingleTeamEnv:
    team = team_of(LINE, builders)
    env = SingleTeamEnv(TeamEnv(TeamGrid(team), team))
    env.reset(0)
    return env


def test_no_material_is_chosen_at_the_start() -> None:
    assert singles(2).reset(0).tolist() == [[7, 14, 11, 0], [14, 14, 11, 0]]


def test_builder_0_chooses_for_all_and_earns_its_p() -> None:
    step = singles(2).step([STONE, WOOD])
    assert step.observations.tolist() == [[7, 14, 11, 2], [14, 14, 11, 2]]
    assert step.rewards.tolist() == [10.0, 0.0]
    assert (step.terminated, step.truncated) == (False, False)


def test_what_the_others_do_meanwhile_does_nothing() -> None:
    step = singles(2).step([WOOD, BD])
    assert step.observations.tolist() == [[7, 14, 11, 1], [14, 14, 11, 1]]


def test_without_a_material_the_episode_ends_with_score_0() -> None:
    env = singles(2)
    step = env.step([B, STONE])
    assert (step.terminated, step.score, step.rewards.tolist()) == (True, 0.0, [0.0, 0.0])
    with pytest.raises(ResetNeeded):
        env.step([STONE, STONE])


def test_a_later_material_action_does_nothing_and_counts_as_a_step() -> None:
    env = singles(2)
    env.step([STONE, STONE])
    step = env.step([WOOD, L])
    assert step.observations.tolist() == [[7, 14, 11, 2], [13, 14, 11, 2]]
    for _ in range(57):
        assert not env.step([WOOD, WOOD]).truncated
    step = env.step([WOOD, WOOD])
    assert (step.terminated, step.truncated, step.score) == (False, True, 10.0)


@given(st.lists(st.integers(0, 9), max_size=70))
def test_one_builder_is_the_papers_single_agent(actions: list[int]) -> None:
    ours, theirs = singles(1), SingleAgentVectorEnv(GridVectorEnv([LINE]), [LINE])
    theirs.reset()
    for action in actions:
        step = ours.step([action])
        observations, rewards, terminated, truncated, info = theirs.step(np.array([action]))
        assert step.observations.tolist() == observations.tolist()
        assert step.rewards.tolist() == rewards.tolist()
        assert (step.terminated, step.truncated) == (terminated[0], truncated[0])
        assert step.score == info["score"][0]
        if step.terminated or step.truncated:
            return


def test_an_episode_goes_on_where_it_was_saved() -> None:
    env, other = singles(2), singles(2)
    env.step([STONE, F])
    env.step([BD, LD])
    other.restore(env.snapshot())
    one, same = env.step([BD, B]), other.step([BD, B])
    assert one.observations.tolist() == same.observations.tolist()
    assert one.rewards.tolist() == same.rewards.tolist()
