"""A team's episodes: what is observed and earned, when they end, and what the team scores.

A team's arena from above: every builder in a colour of its own, everything else as for one.
"""

import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.cooperative.team import Team, team_of
from mc_nested.arena.cooperative.team_env import BODIES, TeamVectorEnv, draw_team_picture, draw_team_text, rendered_team
from mc_nested.arena.drawing import draw_picture
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import NO_ACTION
from sim.grid import GridVectorEnv
from sim.team_grid import TeamGrid

LINE = load_scenario("line")
WOOD, STONE = 0, 1
F, B, L, R, FD, LD, RD, BD = Action


def begun(team: Team, material: int = STONE, runs: int = 1) -> TeamVectorEnv:
    env = TeamVectorEnv([TeamGrid(team) for _ in range(runs)], team)
    env.reset(options={"material": np.full(env.num_envs, material)})
    return env


def after(env: TeamVectorEnv, *ticks: Sequence[int]) -> tuple[Any, ...]:
    """Return the outcome of the last tick as lists: observations, rewards, terminated, truncated and scores."""
    for tick in ticks:
        observations, rewards, terminated, truncated, info = env.step(np.array(tick))
    return tuple(each.tolist() for each in (observations, rewards, terminated, truncated, info["score"]))


def test_each_builder_observes_its_own_cell_and_the_teams_blocks() -> None:
    env = TeamVectorEnv([TeamGrid(Team(LINE, ((7, 12), (3, 3))))], Team(LINE, ((7, 12), (3, 3))))
    assert env.reset()[0].tolist() == [[7, 12, 11], [3, 3, 11]]
    observations, rewards, *_ = after(env, [BD, L])
    assert observations == [[7, 11, 10], [2, 3, 10]]
    assert rewards == [1.0, 0.0]
    assert [env.cell(0), env.cell(1)] == [(7, 11), (2, 3)]
    assert env.placed(0) == env.placed(1) == {(7, 12)}


def test_each_builder_earns_for_its_own_block_and_the_team_shares_the_score() -> None:
    two = dataclasses.replace(LINE, design=frozenset({(7, 12), (3, 3)}))
    env = begun(Team(two, ((7, 12), (3, 3))), WOOD)
    _, rewards, terminated, truncated, scores = after(env, [BD, BD])
    assert rewards == [1.0, 1.0]
    assert (terminated, truncated, scores) == ([True] * 2, [False] * 2, [2 - 5.0] * 2)


def test_blocks_off_the_design_are_used_up_and_earn_nothing() -> None:
    one = dataclasses.replace(LINE, design=frozenset({(0, 0)}))
    env = begun(Team(one, ((7, 12), (3, 3))))
    _, rewards, terminated, _, scores = after(env, [BD, BD])
    assert rewards == [0.0, 0.0]
    assert (terminated, scores) == ([True] * 2, [10.0] * 2)
    assert env.placed(0) == {(7, 12)}, "the other had no block left"


def test_the_step_limit_counts_ticks_and_ends_the_episode_until_a_reset() -> None:
    env = begun(team_of(dataclasses.replace(LINE, step_limit=2), 2))
    assert after(env, [L, L])[3] == [False, False]
    observations, _, terminated, truncated, scores = after(env, [NO_ACTION, L])
    assert (terminated, truncated, scores) == ([False] * 2, [True] * 2, [10.0] * 2)
    again = after(env, [L, L])
    assert again[0] == observations
    assert again[1:] == ([0.0] * 2, [False] * 2, [True] * 2, [0.0] * 2)


def test_a_tick_in_which_nobody_acts_is_not_counted() -> None:
    env = begun(team_of(dataclasses.replace(LINE, step_limit=2), 2))
    assert after(env, [L, L], [NO_ACTION, NO_ACTION])[3] == [False, False]
    assert after(env, [L, L])[3] == [True, True]


def test_a_step_before_the_first_reset_raises() -> None:
    team = team_of(LINE, 2)
    with pytest.raises(ResetNeeded):
        TeamVectorEnv([TeamGrid(team)], team).step(np.array([F, F]))


class Fails(TeamGrid):
    """A game that is gone at its first tick."""

    def act(self, actions: Sequence[Action | None]) -> Any:  # noqa: ARG002 - it does none
        raise RuntimeError("gone")


def test_an_arena_needs_a_reset_after_an_error() -> None:
    team = team_of(LINE, 2)
    env = TeamVectorEnv([Fails(team)], team)
    env.reset()
    with pytest.raises(RuntimeError):
        env.step(np.array([F, F]))
    with pytest.raises(ResetNeeded):
        env.step(np.array([F, F]))
    assert env.reset()[0].tolist() == [[7, 14, 11], [14, 14, 11]]


def test_each_arena_ends_and_is_reset_independently() -> None:
    team = Team(dataclasses.replace(LINE, design=frozenset({(7, 12)})), ((7, 12), (3, 3)))
    env = begun(team, runs=2)
    observations, rewards, terminated, _, scores = after(env, [L, L, BD, L])
    assert observations == [[6, 12, 1], [2, 3, 1], [7, 11, 0], [2, 3, 0]]
    assert (rewards, terminated, scores) == ([0, 0, 1, 0], [False, False, True, True], [0, 0, 11, 11])
    mask = np.array([False, False, True, True])
    found, _ = env.reset(options={"reset_mask": mask, "material": np.full(4, WOOD)})
    assert found.tolist() == [[6, 12, 1], [2, 3, 1], [7, 12, 1], [3, 3, 1]]


@given(st.lists(st.sampled_from(Action), max_size=70), st.sampled_from([WOOD, STONE]))
def test_a_team_of_one_steps_as_the_arena_of_one_agent(actions: list[Action], material: int) -> None:
    ours, theirs = begun(team_of(LINE, 1), material), GridVectorEnv([LINE])
    theirs.reset(options={"material": np.array([material])})
    for action in actions:
        own, other = ours.step(np.array([action])), theirs.step(np.array([action]))
        for one, same in zip(own[:4], other[:4], strict=True):
            np.testing.assert_array_equal(one, same)
        assert own[4]["score"].tolist() == other[4]["score"].tolist()
        assert own[4]["_score"].tolist() == other[4]["_score"].tolist()


def test_the_scripted_builder_alone_reaches_the_optimum_while_the_other_waits() -> None:
    env = begun(team_of(LINE, 2))
    assert after(env, *([action, NO_ACTION] for action in build(LINE)))[-1] == [LINE.optimum] * 2


def test_a_restored_episode_continues_as_the_saved_one() -> None:
    env, other = (begun(team_of(LINE, 3), WOOD, runs=2) for _ in range(2))
    after(env, [BD, BD, L, F, F, F])
    kept = env.snapshot()
    ticks = [[BD, R, LD, B, BD, L]] * 3
    before = [after(env, tick) for tick in ticks]
    other.restore(kept)
    assert [after(other, tick) for tick in ticks] == before
    assert other.placed(0) == env.placed(0) != other.placed(3) == env.placed(3)
    assert other.resumable is other


TEAM = Team(LINE, ((7, 14), (3, 14)))


def test_the_text_drawing_shows_builders_as_their_numbers() -> None:
    rows = draw_team_text(TEAM, [(7, 1), (0, 0)], {(7, 2), (5, 5)}).splitlines()
    assert rows[-1] == "1" + " ." * 14
    assert rows[-2].split()[7] == "0"
    assert rows[-3].split()[7] == "#"
    assert rows[-6].split()[5:8] == ["x", ".", "o"]


def test_a_builder_alone_is_drawn_as_the_agent() -> None:
    ours = draw_team_picture(Team(LINE, (LINE.start,)), [(4, 4)], {(7, 2)})
    np.testing.assert_array_equal(ours, draw_picture(LINE, (4, 4), {(7, 2)}))


def test_each_builder_is_drawn_in_its_own_colour() -> None:
    cells = [(0, 0), (14, 0), (0, 14), (14, 14)]
    picture = draw_team_picture(Team(LINE, tuple(cells)), cells, set(), cell_px=16)
    for (x, y), body in zip(cells, BODIES, strict=True):
        tile = picture[(14 - y) * 16 : (15 - y) * 16, x * 16 : (x + 1) * 16]
        assert (tile == body).all(axis=-1).any()
        assert not any((tile == other).all(axis=-1).any() for other in BODIES if other != body)


def test_the_render_mode_selects_text_a_picture_or_nothing() -> None:
    assert rendered_team(None, TEAM, TEAM.starts, ()) is None
    assert rendered_team("ansi", TEAM, TEAM.starts, ()) == draw_team_text(TEAM, TEAM.starts, ())
    assert rendered_team("rgb_array", TEAM, TEAM.starts, ()).shape == (240, 240, 3)
