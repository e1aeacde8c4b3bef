"""ArenaEnv over the simulator: rewards, ends, infos and Gymnasium's own checks."""

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.drawing import CELL_PX, draw_picture
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Following, Outcome
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, ScenarioError
from sim.grid import GridGame
from tests.arena.made_games import TakesAtItsWord
from tests.arena.made_parts import STONE, STRIPES, TO_FAR, WOOD, scenarios_with_parts
from tests.arena.simulated import arena_env


@pytest.fixture
def begun() -> ArenaEnv:
    env = arena_env("line")
    env.reset()
    return env


def test_observations_are_raw_x_y_b() -> None:
    env = arena_env("line")
    observation, info = env.reset()
    assert observation.dtype == np.int64
    assert observation.tolist() == [7, 14, 11]
    assert info == {"material": "stone"}
    assert env.observation_space == gymnasium.spaces.Box(np.array([0, 0, 0]), np.array([14, 14, 11]), dtype=np.int64)
    assert env.action_space == gymnasium.spaces.Discrete(8)


@pytest.mark.parametrize("size", [5, 20, 32])
def test_spaces_pictures_and_the_checker_follow_the_arenas_size(size: int) -> None:
    material = load_scenario("line").materials
    scenario = Scenario("corner", frozenset({(size - 1, size - 1)}), (size - 1, 0), size, material, size)
    env = arena_env(scenario, "rgb_array")
    check_env(env, skip_render_check=True)
    highest = np.array([size - 1, size - 1, 1])
    assert env.observation_space == gymnasium.spaces.Box(np.zeros(3, np.int64), highest, dtype=np.int64)
    env.reset()
    picture = env.render()
    assert picture.shape == (size * CELL_PX, size * CELL_PX, 3)
    steps = [env.step(action) for action in build(scenario)]
    assert steps[-1][2]
    assert env.placed == scenario.design


def test_a_block_on_the_design_earns_1_and_one_off_it_nothing(begun: ArenaEnv) -> None:
    rewards = [begun.step(action)[1] for action in (Action.BD, Action.B, Action.BD, Action.LD, Action.BD)]
    # (7, 14) and (6, 13) lie off the line, (7, 12) on it.
    assert rewards == [0.0, 0.0, 1.0, 0.0, 0.0]


def test_a_void_block_earns_nothing_and_uses_up_no_block(begun: ArenaEnv) -> None:
    observation, reward, *_, info = begun.step(Action.LD)
    assert (observation.tolist(), reward) == ([6, 14, 11], 0.0)
    assert "placed" not in info


@pytest.mark.parametrize(("material", "score"), [("stone", 21.0), ("wood", 6.0)])
def test_the_last_step_brings_the_main_agents_reward(material: str, score: float) -> None:
    env = arena_env("line")
    env.reset(options={"material": material})
    *earlier, last = (env.step(action) for action in build(env.scenario))
    assert last[2:] == (True, False, {"material": material, "placed": (7, 2), "score": score})
    assert all("score" not in step[4] for step in earlier)
    assert sum(step[1] for step in [*earlier, last]) == 11.0
    assert env.placed == env.scenario.design


def test_the_score_so_far_is_what_the_episode_would_bring_if_it_ended(begun: ArenaEnv) -> None:
    assert begun.score == 10.0
    begun.step(Action.B)
    begun.step(Action.BD)
    assert begun.score == 10.0  # a block off the design
    begun.step(Action.BD)
    assert begun.score == 11.0


def test_the_step_limit_truncates_the_episode_and_gives_the_score(begun: ArenaEnv) -> None:
    for _ in range(59):
        assert begun.step(Action.L)[2:4] == (False, False)
    *_, terminated, truncated, info = begun.step(Action.L)
    assert (terminated, truncated, info["score"]) == (False, True, 10.0)


def test_the_last_block_on_the_last_step_terminates(begun: ArenaEnv) -> None:
    for action in [*[Action.L, Action.R] * 23, Action.L, *build(begun.scenario)[:-1]]:
        begun.step(action)
    # An odd step aside leaves the agent one cell left of the line: its blocks count for nothing, but they run out.
    *_, terminated, truncated, _ = begun.step(Action.BD)
    assert (terminated, truncated) == (True, False)


def test_a_step_before_a_reset_or_after_the_end_raises() -> None:
    env = arena_env("line")
    with pytest.raises(ResetNeeded):
        env.step(Action.F)
    env.reset()
    for action in build(env.scenario):
        env.step(action)
    with pytest.raises(ResetNeeded):
        env.step(Action.F)


def test_an_unknown_material_is_refused() -> None:
    with pytest.raises(ScenarioError, match="no material 'gold'"):
        arena_env("line").reset(options={"material": "gold"})


class BreaksDown(GridGame):
    def act(self, action: Action, material: int | None = None, following: Following | None = None) -> Outcome:
        if action is Action.F:
            raise LiveError("the game is gone")
        return super().act(action, material, following)


def test_an_env_needs_a_reset_after_its_game_failed() -> None:
    line = load_scenario("line")
    env = ArenaEnv(BreaksDown(line), line)
    env.reset()
    with pytest.raises(LiveError):
        env.step(Action.F)
    with pytest.raises(ResetNeeded):
        env.step(Action.B)
    env.reset()
    assert env.step(Action.B)[0].tolist() == [7, 13, 11]


steps_and_materials = st.lists(st.tuples(st.sampled_from(Action), st.integers(0, 1)), max_size=40)


@given(scenarios_with_parts(), steps_and_materials)
def test_what_is_expected_of_a_step_is_what_it_shows_by_the_rules(
    scenario: Scenario, steps: list[tuple[Action, int]]
) -> None:
    env = arena_env(scenario)
    env.reset()
    for step in steps:
        observation, goes_on, chooses = env.expected(step)
        assert env.expected(step)[2] == chooses, "asking changes nothing"
        shown, _, terminated, truncated, info = env.step(step)
        assert (shown.tolist(), not (terminated or truncated), info["chooses"]) == (
            observation.tolist(),
            goes_on,
            chooses,
        )
        if not goes_on:
            break


def test_what_is_expected_is_reckoned_by_hand() -> None:
    env = arena_env(STRIPES)
    env.reset()
    (first, goes_on, chooses), _ = env.expected((TO_FAR[0], STONE)), env.step((TO_FAR[0], STONE))
    assert (first.tolist(), goes_on, chooses) == ([1, 2, 4], True, False)
    second, goes_on, chooses = env.expected((TO_FAR[1], STONE))
    assert (second.tolist(), goes_on, chooses) == ([2, 2, 3], True, True)  # the first part is done


def test_the_game_is_told_once_what_follows_with_the_material_that_will_be_passed() -> None:
    game = TakesAtItsWord(STRIPES)
    env = ArenaEnv(game, STRIPES)
    env.reset()
    env.announce((Action.RD, WOOD))
    env.step((Action.FD, STONE))
    env.announce(np.int64(Action.B))  # without a material the one in hand stays there
    env.step((Action.RD, WOOD))
    env.step(Action.B)
    assert game.told == [(Action.RD, WOOD), (Action.B, None), None]


def test_what_was_announced_is_forgotten_with_the_episode() -> None:
    game = TakesAtItsWord(STRIPES)
    env = ArenaEnv(game, STRIPES)
    env.reset()
    env.announce(Action.B)
    env.reset()
    env.step(Action.L)
    assert game.following is None


class KnowsNothingOfIt(GridGame):
    """A game whose act takes an action and a material alone."""

    def act(self, action: Action, material: int | None = None) -> Outcome:  # type: ignore[override]  # that's the point
        return super().act(action, material)


def test_where_nothing_is_announced_the_game_is_told_nothing() -> None:
    line = load_scenario("line")
    env = ArenaEnv(KnowsNothingOfIt(line), line)  # type: ignore[arg-type]  # as above
    env.reset()
    assert env.step(Action.B)[0].tolist() == [7, 13, 11]
    env.announce(Action.B)
    with pytest.raises(TypeError):
        env.step(Action.B)


def test_the_text_shows_agent_blocks_and_design() -> None:
    env = arena_env("line", render_mode="ansi")
    env.reset()
    for action in (Action.LD, Action.BD, Action.R, Action.B, Action.BD):
        env.step(action)
    drawing = env.render().splitlines()
    assert drawing[0] == ". . . . . . x . . . . . . . ."
    assert drawing[2] == ". . . . . . . # . . . . . . ."
    assert drawing[3] == ". . . . . . . ^ . . . . . . ."
    assert drawing[4] == ". . . . . . . o . . . . . . ."


def test_the_picture_shows_the_arenas_present_state() -> None:
    env = arena_env("line", render_mode="rgb_array")
    env.reset()
    before = env.render()
    env.step(Action.BD)
    np.testing.assert_array_equal(env.render(), draw_picture(env.scenario, (7, 13), {(7, 14)}))
    assert (env.render() != before).any()


def test_an_env_without_a_render_mode_draws_nothing(begun: ArenaEnv) -> None:
    assert begun.render() is None
