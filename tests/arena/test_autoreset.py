"""NextStepAutoreset: to a step, what Gymnasium's own vector env makes of single arenas."""

from typing import Any

import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers.vector import RecordEpisodeStatistics
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.autoreset import NextStepAutoreset
from mc_nested.arena.builder import build
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import ScenarioError
from sim.grid import GridVectorEnv, arena_env

LINE = load_scenario("line")
RUNS = 3


def arrays() -> NextStepAutoreset:
    return NextStepAutoreset(GridVectorEnv([LINE] * RUNS))


def of_envs() -> NextStepAutoreset:
    return NextStepAutoreset(ArenaVectorEnv([arena_env(LINE) for _ in range(RUNS)]))


@pytest.mark.parametrize("make", [arrays, of_envs])
@given(seed=st.integers(0, 2**32 - 1), material=st.sampled_from([None, "wood", "stone"]))
def test_it_steps_as_gymnasiums_own_over_single_arenas(make: Any, seed: int, material: str | None) -> None:
    random = np.random.default_rng(seed)
    ours, theirs = make(), SyncVectorEnv([lambda: arena_env(LINE)] * RUNS)
    options = {"material": material} if material else None
    np.testing.assert_array_equal(ours.reset(options=options)[0], theirs.reset(options=options)[0])
    for _ in range(200):
        actions = random.choice(8, RUNS, p=[0.05, 0.2, 0.1, 0.1, 0.1, 0.1, 0.1, 0.25])
        one, other = ours.step(actions), theirs.step(actions)
        for mine, its in zip(one[:4], other[:4], strict=True):
            np.testing.assert_array_equal(mine, its)
            assert mine.dtype == its.dtype
        np.testing.assert_array_equal(one[4]["_score"], other[4].get("_score", np.zeros(RUNS, bool)))
        np.testing.assert_array_equal(one[4]["score"], other[4].get("score", np.zeros(RUNS)))


def test_it_says_how_it_resets_and_leaves_the_arenas_own_words_alone() -> None:
    env = arrays()
    assert env.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    assert env.metadata["render_modes"] == ["rgb_array", "ansi"]
    assert env.unwrapped.metadata["autoreset_mode"] is AutoresetMode.DISABLED


def test_an_arena_that_is_reset_by_hand_is_not_reset_again() -> None:
    env = arrays()
    env.reset()
    for action in build(LINE):
        *_, terminated, _, _ = env.step(np.array([action, Action.F, Action.F]))
    assert terminated.tolist() == [True, False, False]
    env.reset(options={"reset_mask": np.array([True, False, False])})
    observations, *_ = env.step(np.array([Action.B] * RUNS))
    assert observations.tolist() == [[7, 13, 11]] * RUNS


def test_gymnasiums_statistics_count_every_episode_once() -> None:
    env = RecordEpisodeStatistics(arrays())
    env.reset()
    for action in [*build(LINE), Action.F] * 2:
        env.step(np.array([action, Action.F, action]))
    assert list(env.return_queue) == [11.0] * 4
    assert list(env.length_queue) == [len(build(LINE))] * 4


def test_nothing_is_done_before_the_first_reset() -> None:
    with pytest.raises(ResetNeeded, match=r"call reset\(\) first"):
        arrays().step(np.zeros(RUNS, np.int64))


@pytest.mark.parametrize("actions", [[0, 1, 8], [0, 1, -1], [0, 1], [0.0, 1.0, 2.0], 3])
def test_what_is_no_action_for_each_arena_is_refused(actions: Any) -> None:
    env = arrays()
    env.reset()
    with pytest.raises(ValueError, match="one of 0 to 7 for each of the 3 arenas"):
        env.step(actions)


def test_a_list_of_actions_will_do() -> None:
    env = arrays()
    env.reset()
    assert env.step([0, 1, 2])[0].tolist() == [[7, 14, 11], [7, 13, 11], [6, 14, 11]]  # type: ignore[arg-type]


def test_a_material_that_there_is_none_of_is_refused() -> None:
    with pytest.raises(ScenarioError, match="no material 'gold'"):
        arrays().reset(options={"material": "gold"})
