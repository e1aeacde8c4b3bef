"""A team's episodes: what is observed and earned, when they end, and what the team scores.

A team's arena from above: every builder in a colour of its own, everything else as for one.
"""

import dataclasses

import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arena.cooperative.team_env import BODIES, TeamEnv, draw_team_picture, draw_team_text, rendered_team
from mc_nested.arena.drawing import draw_picture
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import NO_ACTION
from sim.grid import arena_env
from sim.team_grid import TeamGrid

LINE = load_scenario("line")
WOOD, STONE = 0, 1
F, B, L, R, FD, LD, RD, BD = Action


def team_env(team: Team) -> TeamEnv:
    return TeamEnv(TeamGrid(team), team)


def test_each_observes_its_own_cell_and_the_teams_blocks() -> None:
    env = team_env(Team(LINE, ((7, 12), (3, 3))))
    assert env.reset(STONE).tolist() == [[7, 12, 11], [3, 3, 11]]
    step = env.step([BD, L])
    assert step.observations.tolist() == [[7, 11, 10], [2, 3, 10]]
    assert step.rewards.tolist() == [1.0, 0.0]
    assert env.cells == ((7, 11), (2, 3))
    assert env.placed == {(7, 12)}


def test_each_earns_for_its_own_block_and_the_score_is_the_teams() -> None:
    two = dataclasses.replace(LINE, design=frozenset({(7, 12), (3, 3)}))
    env = team_env(Team(two, ((7, 12), (3, 3))))
    env.reset(WOOD)
    step = env.step([BD, BD])
    assert step.rewards.tolist() == [1.0, 1.0]
    assert (step.terminated, step.truncated, step.score) == (True, False, 2 - 5.0)


def test_blocks_off_the_design_are_used_up_and_earn_nothing() -> None:
    one = dataclasses.replace(LINE, design=frozenset({(0, 0)}))
    env = team_env(Team(one, ((7, 12), (3, 3))))
    env.reset(STONE)
    step = env.step([BD, BD])
    assert step.rewards.tolist() == [0.0, 0.0]
    assert (step.terminated, step.score) == (True, 10.0)
    assert env.placed == {(7, 12)}, "the other had no block left"


def test_the_step_limit_counts_ticks() -> None:
    short = dataclasses.replace(LINE, step_limit=2)
    env = team_env(team_of(short, 2))
    env.reset(STONE)
    assert not env.step([L, L]).truncated
    step = env.step([NO_ACTION, L])
    assert (step.terminated, step.truncated, step.score) == (False, True, 10.0)
    with pytest.raises(ResetNeeded):
        env.step([L, L])


def test_nothing_is_done_before_a_reset() -> None:
    with pytest.raises(ResetNeeded):
        team_env(team_of(LINE, 2)).step([F, F])


@given(st.lists(st.sampled_from(Action), max_size=70), st.sampled_from([WOOD, STONE]))
def test_one_builder_is_the_arena_of_one(actions: list[Action], material: int) -> None:
    ours, theirs = team_env(team_of(LINE, 1)), arena_env(LINE)
    begun, _ = theirs.reset(options={"material": LINE.materials[material].name})
    assert ours.reset(material).tolist() == [begun.tolist()]
    for action in actions:
        step = ours.step([action])
        observation, reward, terminated, truncated, info = theirs.step(action)
        assert step.observations.tolist() == [observation.tolist()]
        assert (step.rewards.tolist(), step.terminated, step.truncated) == ([reward], terminated, truncated)
        assert step.score == info.get("score", 0.0)
        if terminated or truncated:
            return


def test_the_scripted_builder_alone_reaches_the_optimum_while_the_other_waits() -> None:
    env = team_env(team_of(LINE, 2))
    env.reset(STONE)
    steps = [env.step([action, NO_ACTION]) for action in build(LINE)]
    assert steps[-1].score == LINE.optimum


def test_an_episode_goes_on_where_it_was_saved() -> None:
    env = team_env(team_of(LINE, 3))
    env.reset(WOOD)
    env.step([BD, BD, L])
    kept = env.snapshot()
    before = [env.step([BD, R, LD]) for _ in range(3)]
    other = team_env(team_of(LINE, 3))
    other.restore(kept)
    for step in before:
        again = other.step([BD, R, LD])
        np.testing.assert_array_equal(again.observations, step.observations)
        assert again.rewards.tolist() == step.rewards.tolist()
    assert other.placed == env.placed
    assert other.resumable is other


TEAM = Team(LINE, ((7, 14), (3, 14)))


def test_builders_are_their_numbers_in_text() -> None:
    rows = draw_team_text(TEAM, [(7, 1), (0, 0)], {(7, 2), (5, 5)}).splitlines()
    assert rows[-1] == "1" + " ." * 14
    assert rows[-2].split()[7] == "0"
    assert rows[-3].split()[7] == "#"
    assert rows[-6].split()[5:8] == ["x", ".", "o"]


def test_one_builder_is_drawn_as_the_agent() -> None:
    ours = draw_team_picture(Team(LINE, (LINE.start,)), [(4, 4)], {(7, 2)})
    np.testing.assert_array_equal(ours, draw_picture(LINE, (4, 4), {(7, 2)}))


def test_each_builder_has_its_colour_in_its_cell() -> None:
    cells = [(0, 0), (14, 0), (0, 14), (14, 14)]
    picture = draw_team_picture(Team(LINE, tuple(cells)), cells, set(), cell_px=16)
    for (x, y), body in zip(cells, BODIES, strict=True):
        tile = picture[(14 - y) * 16 : (15 - y) * 16, x * 16 : (x + 1) * 16]
        assert (tile == body).all(axis=-1).any()
        assert not any((tile == other).all(axis=-1).any() for other in BODIES if other != body)


def test_a_render_mode_says_what_is_drawn() -> None:
    assert rendered_team(None, TEAM, TEAM.starts, ()) is None
    assert rendered_team("ansi", TEAM, TEAM.starts, ()) == draw_team_text(TEAM, TEAM.starts, ())
    assert rendered_team("rgb_array", TEAM, TEAM.starts, ()).shape == (240, 240, 3)
