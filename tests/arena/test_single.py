"""The single agent's ten actions, step by step (paper, appendix; docs/explanation/task.md)."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.cooperative.team import team_of
from mc_nested.arena.cooperative.team_env import TeamVectorEnv
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arena.vector import ArenaVectorEnv
from sim.grid import GridVectorEnv
from sim.team_grid import TeamGrid
from tests.arena.made_games import PlayedByAPerson, TakesAtItsWord
from tests.arena.made_parts import STRIPES, scenarios_with_parts
from tests.arena.simulated import arena_env

LINE = load_scenario("line")
WOOD, STONE, FIRST_MOVE = 0, 1, 2


@given(scenarios_with_parts() | st.just(LINE), st.lists(st.integers(0, 9), max_size=40))
def test_what_is_expected_where_it_builds_is_what_it_shows_by_the_rules(scenario: Scenario, steps: list[int]) -> None:
    env = SingleAgentVectorEnv(ArenaVectorEnv([arena_env(scenario)]), [scenario])
    env.reset()
    for step, action in enumerate(steps):
        expected, (goes_on,), (chooses,) = env.expected(np.array([action]))
        shown, _, (terminated,), (truncated,), _ = env.step(np.array([action]))
        builds = step > 0 and action >= len(scenario.materials)
        assert goes_on == (builds and not (terminated or truncated))
        assert not chooses
        if builds:
            assert expected.tolist() == shown.tolist()
        if terminated or truncated:
            break


def test_the_game_is_told_what_is_built_next_with_the_material_in_hand() -> None:
    game = TakesAtItsWord(STRIPES)
    env = SingleAgentVectorEnv(ArenaVectorEnv([ArenaEnv(game, STRIPES)]), [STRIPES])
    env.reset()
    first, second = FIRST_MOVE + Action.FD, FIRST_MOVE + Action.RD
    env.step(np.array([STONE]))
    env.announce(np.array([second]))
    env.step(np.array([first]))
    env.announce(np.array([WOOD]))  # which the arena within isn't asked for
    env.step(np.array([second]))
    assert game.told == [(Action.RD, STONE), None]


def single(runs: int = 1) -> SingleAgentVectorEnv:
    env = SingleAgentVectorEnv(GridVectorEnv([LINE] * runs), [LINE] * runs)
    env.reset()
    return env


def test_no_material_is_chosen_at_the_start() -> None:
    env = single()
    observations, _ = env.reset()
    assert observations.tolist() == [[7, 14, 11, 0]]
    assert env.single_action_space.n == 10  # type: ignore[attr-defined]  # a Discrete
    assert env.single_observation_space.high.tolist() == [14, 14, 11, 2]  # type: ignore[attr-defined]  # a Box


@pytest.mark.parametrize(("choice", "worth"), [(WOOD, -5.0), (STONE, 10.0)])
def test_the_choice_earns_p_and_shows_in_the_state(choice: int, worth: float) -> None:
    env = single()
    observations, rewards, terminated, truncated, _ = env.step(np.array([choice]))
    assert observations.tolist() == [[7, 14, 11, choice + 1]]
    assert (rewards.tolist(), terminated.tolist(), truncated.tolist()) == ([worth], [False], [False])


@pytest.mark.parametrize("action", range(FIRST_MOVE, 10))
def test_a_first_action_that_chooses_no_material_ends_the_episode_with_score_0(action: int) -> None:
    env = single()
    observations, rewards, terminated, _, info = env.step(np.array([action]))
    assert observations.tolist() == [[7, 14, 11, 0]]
    assert (rewards.tolist(), terminated.tolist()) == ([0.0], [True])
    assert (info["_score"].tolist(), info["score"].tolist()) == ([True], [0.0])


@pytest.mark.parametrize(("choice", "score"), [(WOOD, 6.0), (STONE, 21.0)])
def test_the_builder_reaches_the_optimum_after_its_choice(choice: int, score: float) -> None:
    env = single()
    earned = env.step(np.array([choice]))[1][0]
    for action in build(LINE):
        _, rewards, terminated, _, info = env.step(np.array([action + FIRST_MOVE]))
        earned += rewards[0]
    assert terminated.tolist() == [True]
    assert info["score"].tolist() == [score]
    assert earned == score


def test_a_later_material_action_does_nothing_and_counts_as_a_step() -> None:
    env = single()
    env.step(np.array([STONE]))
    for _ in range(58):
        observations, rewards, terminated, truncated, info = env.step(np.array([WOOD]))
        assert (observations.tolist(), rewards.tolist()) == ([[7, 14, 11, 2]], [0.0])
        assert not (terminated | truncated | info["_score"]).any()
    *_, truncated, info = env.step(np.array([WOOD]))
    assert (truncated.tolist(), info["score"].tolist()) == ([True], [10.0])


def test_an_ended_episode_stands_still_until_its_reset() -> None:
    env = single(2)
    env.step(np.array([STONE, FIRST_MOVE]))
    _, _, terminated, _, info = env.step(np.array([FIRST_MOVE + Action.BD, STONE]))
    assert (terminated.tolist(), info["_score"].tolist()) == ([False, True], [False, False])
    observations, _ = env.reset(options={"reset_mask": np.array([False, True])})
    assert observations.tolist() == [[7, 13, 10, 2], [7, 14, 11, 0]]


@given(seed=st.integers(0, 2**32 - 1))
def test_arrays_and_single_arenas_agree(seed: int) -> None:
    random = np.random.default_rng(seed)
    arrays = single(3)
    games = SingleAgentVectorEnv(ArenaVectorEnv([arena_env(LINE) for _ in range(3)]), [LINE] * 3)
    games.reset()
    mask = np.zeros(3, dtype=bool)
    for _ in range(150):
        fresh = arrays.reset(options={"reset_mask": mask})[0]
        np.testing.assert_array_equal(fresh, games.reset(options={"reset_mask": mask})[0])
        actions = np.where(fresh[:, 3] == 0, random.integers(0, 3, 3), random.integers(0, 10, 3))
        ours, theirs = arrays.step(actions), games.step(actions)
        for one, other in zip(ours[:4], theirs[:4], strict=True):
            np.testing.assert_array_equal(one, other)
        np.testing.assert_array_equal(ours[4]["score"], theirs[4]["score"])
        mask = ours[2] | ours[3]


@given(scenarios_with_parts(), st.integers(0, 2**32 - 1))
def test_a_single_agents_return_with_parts_is_the_arenas_score(scenario: Scenario, seed: int) -> None:
    random, materials = np.random.default_rng(seed), len(scenario.materials)
    view = SingleAgentVectorEnv(GridVectorEnv([scenario]), [scenario])
    view.reset()
    arena = arena_env(scenario)
    total, in_hand = 0.0, int(random.integers(materials))
    rewards = [float(view.step(np.array([in_hand]))[1][0])]
    assert rewards == [0.0], "the first choice earns nothing by itself"
    arena.reset(options={"material": scenario.materials[in_hand].name})
    for _ in range(scenario.step_limit):
        action = int(random.integers(materials + len(Action)))
        observations, reward, terminated, truncated, info = view.step(np.array([action]))
        rewards.append(float(reward[0]))
        if action < materials:
            in_hand = action
        else:
            told = arena.step((action - materials, in_hand))[4]
            total = told["earned"]
        assert observations[0, 3] == in_hand + 1
        if terminated[0] or truncated[0]:
            break
    lacks = 0.0
    if truncated[0]:
        laid, part = len(arena.placed), scenario.part_at(scenario.blocks - len(arena.placed))
        of_part = scenario.in_order[part]
        ends = sum(len(each.cells) for each in scenario.in_order[: part + 1])
        if not part or ends - laid < len(of_part.cells):
            lacks = of_part.worth[in_hand] * (ends - laid) / len(of_part.cells)
    assert info["score"][0] == pytest.approx(total + lacks)
    assert sum(rewards) == pytest.approx(info["score"][0])


def test_a_later_material_action_with_parts_changes_the_material_and_counts_as_a_step() -> None:
    view = SingleAgentVectorEnv(GridVectorEnv([STRIPES]), [STRIPES])
    view.reset()
    steps = [view.step(np.array([action])) for action in (STONE, FIRST_MOVE + Action.FD, WOOD, FIRST_MOVE + Action.RD)]
    assert [step[1][0] for step in steps] == [0.0, 1 + 5, 0.0, 1 - 2.5]
    assert [step[0][0, 3] for step in steps] == [2, 2, 1, 1]
    for _ in range(7):
        view.step(np.array([STONE]))
    *_, truncated, info = view.step(np.array([STONE]))
    assert truncated[0], "twelve steps, nine of which chose"
    assert info["score"][0] == 2 + 5 - 2.5, "and the near stripe, of which nothing stands, earns nothing"


def test_a_restored_snapshot_with_parts_earns_the_same_rewards() -> None:
    view = SingleAgentVectorEnv(GridVectorEnv([STRIPES]), [STRIPES])
    view.reset()
    view.step(np.array([STONE]))
    view.step(np.array([FIRST_MOVE + Action.FD]))
    kept = view.snapshot()
    ahead = [WOOD, FIRST_MOVE + Action.RD, *[FIRST_MOVE + Action.B] * 8]
    first = [view.step(np.array([action]))[1].tolist() for action in ahead]
    view.restore(kept)
    assert [view.step(np.array([action]))[1].tolist() for action in ahead] == first


def test_a_restored_snapshot_continues_every_arena_identically() -> None:
    env = single(2)
    random = np.random.default_rng(3)
    env.step(np.array([STONE, WOOD]))
    for _ in range(10):
        env.step(random.integers(2, 10, 2))
    kept = env.snapshot()
    ahead = random.integers(0, 10, (40, 2))
    first = [env.step(actions)[0].tolist() for actions in ahead]
    env.restore(kept)
    assert [env.step(actions)[0].tolist() for actions in ahead] == first


def singles(builders: int, runs: int = 1) -> SingleAgentVectorEnv:
    """Return single agents that share an arena in each run."""
    team = team_of(LINE, builders)
    each = [replace(team.scenario, start=team.starts[number]) for _ in range(runs) for number in range(builders)]
    env = SingleAgentVectorEnv(TeamVectorEnv([TeamGrid(team) for _ in range(runs)], team), each, builders)
    env.reset()
    return env


F, B, L, R, FD, LD, RD, BD = range(FIRST_MOVE, 10)


def test_each_of_several_single_agents_observes_its_own_start() -> None:
    assert singles(2).reset()[0].tolist() == [[7, 14, 11, 0], [14, 14, 11, 0]]


@pytest.mark.parametrize("beside", [WOOD, BD])
def test_the_first_of_several_single_agents_chooses_for_all_and_earns_p(beside: int) -> None:
    observations, rewards, terminated, truncated, _ = singles(2).step(np.array([STONE, beside]))
    assert observations.tolist() == [[7, 14, 11, 2], [14, 14, 11, 2]]
    assert rewards.tolist() == [10.0, 0.0]
    assert not (terminated | truncated).any()


def test_an_episode_of_several_ends_with_score_0_if_the_first_agent_chooses_no_material() -> None:
    env = singles(2, runs=2)
    _, rewards, terminated, _, info = env.step(np.array([B, STONE, STONE, B]))
    assert (terminated.tolist(), rewards.tolist()) == ([True, True, False, False], [0.0, 0.0, 10.0, 0.0])
    assert (info["score"].tolist(), info["_score"].tolist()) == ([0.0] * 4, [True, True, False, False])
    observations, rewards, *_ = env.step(np.array([STONE, STONE, L, L]))
    assert observations.tolist() == [[7, 14, 11, 0], [14, 14, 11, 0], [6, 14, 11, 2], [13, 14, 11, 2]]
    assert rewards.tolist() == [0.0] * 4


def score_of_a_truncated_episode(env: SingleAgentVectorEnv, steps_left: int) -> list[float]:
    """Return the scores of two agents that do nothing for their last ``steps_left`` steps."""
    for _ in range(steps_left - 1):
        assert not env.step(np.array([WOOD, WOOD]))[3].any()
    _, _, terminated, truncated, info = env.step(np.array([WOOD, WOOD]))
    assert (terminated.tolist(), truncated.tolist()) == ([False] * 2, [True] * 2)
    scores: list[float] = info["score"].tolist()
    return scores


def test_a_placed_block_is_used_up_for_all_agents_and_counts_in_the_score_of_all() -> None:
    env = singles(2)
    env.step(np.array([STONE, STONE]))
    observations, rewards, *_ = env.step(np.array([BD, WOOD]))
    assert observations.tolist() == [[7, 13, 10, 2], [14, 14, 10, 2]]
    assert rewards.tolist() == [0.0, 0.0], "the start is beside the design"
    observations, rewards, *_ = env.step(np.array([B, L]))
    _, rewards, *_ = env.step(np.array([BD, L]))
    assert rewards.tolist() == [1.0, 0.0]
    assert score_of_a_truncated_episode(env, steps_left=56) == [11.0, 11.0]


def test_a_later_material_action_of_several_agents_does_nothing_and_counts_as_a_step() -> None:
    env = singles(2)
    env.step(np.array([STONE, STONE]))
    observations, *_ = env.step(np.array([WOOD, L]))
    assert observations.tolist() == [[7, 14, 11, 2], [13, 14, 11, 2]]
    assert score_of_a_truncated_episode(env, steps_left=58) == [10.0, 10.0]


@given(st.lists(st.integers(0, 9), max_size=70))
def test_a_team_of_one_steps_as_the_papers_single_agent(actions: list[int]) -> None:
    ours, theirs = singles(1), single()
    for action in actions:
        own, other = ours.step(np.array([action])), theirs.step(np.array([action]))
        for one, same in zip(own[:4], other[:4], strict=True):
            np.testing.assert_array_equal(one, same)
        assert own[4]["score"].tolist() == other[4]["score"].tolist()


def test_a_restored_episode_of_several_agents_continues_as_the_saved_one() -> None:
    env, other = singles(2), singles(2)
    env.step(np.array([STONE, F]))
    env.step(np.array([BD, LD]))
    other.restore(env.snapshot())
    for one, same in zip(env.step(np.array([BD, B]))[:4], other.step(np.array([BD, B]))[:4], strict=True):
        np.testing.assert_array_equal(one, same)


def test_what_a_person_did_instead_is_told_as_one_of_the_ten_actions() -> None:
    games = [PlayedByAPerson(LINE, 1), PlayedByAPerson(LINE, 0)]
    env = SingleAgentVectorEnv(ArenaVectorEnv([ArenaEnv(game, LINE) for game in games]), [LINE, LINE])
    env.reset()
    chosen = env.step(np.array([STONE, STONE]))
    first, second, third = (env.step(np.array([FIRST_MOVE, FIRST_MOVE]))[-1] for _ in range(3))
    assert "instead" not in chosen[-1]
    assert (first["instead"][0], first["_instead"].tolist()) == (FIRST_MOVE + Action.R, [True, False])
    assert (second["instead"][0], second["_instead"].tolist()) == (FIRST_MOVE + Action.FD, [True, False])
    assert "instead" not in third
