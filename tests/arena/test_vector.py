"""ArenaVectorEnv: its games say whether episodes can be saved half-way; gymnasium's wrappers fit over it; autoreset."""

from typing import Any

import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.vector import AutoresetMode, SyncVectorEnv
from gymnasium.wrappers.vector import RecordEpisodeStatistics
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game
from mc_nested.arena.planes import PlanesVectorEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arena.vector import NO_ACTION, ArenaVectorEnv, NextStepAutoreset, foresees, resumable_arenas
from mc_nested.errors import ScenarioError
from sim.grid import GridGame, GridVectorEnv
from tests.arena.made_games import TakesAtItsWord
from tests.arena.simulated import arena_env
from tests.learn.made_trainings import StartsOver

LINE = load_scenario("line")


def arenas(*games: Game) -> ArenaVectorEnv:
    return ArenaVectorEnv([ArenaEnv(game, LINE) for game in games])


def test_arenas_can_be_resumed_if_every_game_can() -> None:
    both, one = arenas(GridGame(LINE), GridGame(LINE)), arenas(GridGame(LINE), StartsOver(LINE))
    assert both.resumable is both
    assert one.resumable is None
    assert resumable_arenas(SingleAgentVectorEnv(one, [LINE] * 2)) is None
    single = SingleAgentVectorEnv(both, [LINE] * 2)
    assert resumable_arenas(single) is single


def test_games_are_told_what_comes_next_where_the_arenas_can_know_it() -> None:
    played, simulated = arenas(GridGame(LINE)), GridVectorEnv([LINE])
    assert foresees(played)
    assert foresees(SingleAgentVectorEnv(played, [LINE]))
    assert not foresees(simulated)
    assert not foresees(SingleAgentVectorEnv(simulated, [LINE]))
    assert not foresees(PlanesVectorEnv(played, [LINE]))


@given(st.lists(st.tuples(*[st.integers(NO_ACTION, 7)] * 2), max_size=70))
def test_what_is_expected_of_two_arenas_is_what_they_show_by_the_rules(steps: list[tuple[int, int]]) -> None:
    env = arenas(GridGame(LINE), GridGame(LINE))
    env.reset()
    has_ended = np.zeros(2, np.bool_)
    for step in steps:
        actions = np.array(step)
        observations, goes_on, chooses = env.expected(actions)
        shown, _, terminated, truncated, _ = env.step(actions)
        np.testing.assert_array_equal(observations, shown)
        acts = (actions != NO_ACTION) & ~has_ended
        has_ended = terminated | truncated
        np.testing.assert_array_equal(goes_on, acts & ~has_ended)
        assert not chooses.any()


def test_each_arena_is_told_what_follows_there() -> None:
    games = TakesAtItsWord(LINE), TakesAtItsWord(LINE)
    env = arenas(*games)
    env.reset()
    env.announce(np.array([Action.L, NO_ACTION]))
    env.step(np.array([Action.B, Action.B]))
    assert [game.following for game in games] == [(Action.L, None), None]
    env.step(np.array([Action.L, Action.R]))
    assert [game.kept for game in games] == [1, 0]


def test_a_restored_episode_continues_to_its_end_as_before() -> None:
    env = arenas(GridGame(LINE), GridGame(LINE))
    env.reset(options={"material": np.array([0, 1])})
    random = np.random.default_rng(2)
    for _ in range(9):
        env.step(random.integers(0, 8, 2))
    kept, placed = env.snapshot(), env.placed(1)
    ahead = random.integers(0, 8, (60, 2))

    def played() -> list[object]:
        return [[part.tolist() for part in step[:4]] + [step[4]["score"].tolist()] for step in map(env.step, ahead)]

    first = played()
    env.reset()
    env.restore(kept)
    assert env.placed(1) == placed
    assert played() == first
    assert first[-1][3] == [True, True] or first[-1][2] == [True, True]  # type: ignore[index]  # both have ended


def test_arenas_work_in_gymnasium_wrappers_but_can_not_be_resumed_there() -> None:
    for env in (arenas(GridGame(LINE)), GridVectorEnv([LINE])):
        wrapped = RecordEpisodeStatistics(env)
        wrapped.reset()
        assert wrapped.step(np.array([Action.BD]))[0].tolist() == [[7, 13, 10]]
        assert resumable_arenas(wrapped) is None


def test_each_arena_gets_its_own_seed_as_in_gymnasiums_vector_envs() -> None:
    env = arenas(GridGame(LINE), GridGame(LINE))
    env.reset(seed=5)
    assert [arena.np_random_seed for arena in env.envs] == [5, 6]
    env.reset(seed=[9, None])
    assert [arena.np_random_seed for arena in env.envs] == [9, 6]


def test_too_few_seeds_are_refused() -> None:
    for env in (arenas(GridGame(LINE), GridGame(LINE)), GridVectorEnv([LINE] * 2)):
        with pytest.raises(ValueError, match="seed needs one entry for each of the 2 runs"):
            env.reset(seed=[5])


def test_a_material_is_named_for_all_arenas_or_numbered_for_each() -> None:
    for env in (arenas(GridGame(LINE), GridGame(LINE)), GridVectorEnv([LINE] * 2)):
        for material, scores in (("wood", [-5.0, -5.0]), ([0, 1], [-5.0, 10.0])):
            env.reset(options={"material": material})
            for _ in range(LINE.step_limit):
                info = env.step(np.array([Action.F, Action.F]))[4]
            assert info["score"].tolist() == scores


LINE = load_scenario("line")
RUNS = 3


def arrays() -> NextStepAutoreset:
    return NextStepAutoreset(GridVectorEnv([LINE] * RUNS))


def of_envs() -> NextStepAutoreset:
    return NextStepAutoreset(ArenaVectorEnv([arena_env(LINE) for _ in range(RUNS)]))


@pytest.mark.parametrize("make", [arrays, of_envs])
@given(seed=st.integers(0, 2**32 - 1), material=st.sampled_from([None, "wood", "stone"]))
def test_autoreset_steps_as_gymnasiums_own_vector_env(make: Any, seed: int, material: str | None) -> None:
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


def test_the_autoreset_wrapper_declares_its_mode_and_leaves_the_arenas_metadata_unchanged() -> None:
    env = arrays()
    assert env.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    assert env.metadata["render_modes"] == ["rgb_array", "ansi"]
    assert env.unwrapped.metadata["autoreset_mode"] is AutoresetMode.DISABLED


def test_an_arena_reset_by_hand_is_not_reset_again() -> None:
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


def test_a_step_before_the_first_reset_raises() -> None:
    with pytest.raises(ResetNeeded, match=r"call reset\(\) first"):
        arrays().step(np.zeros(RUNS, np.int64))


@pytest.mark.parametrize("actions", [[0, 1, 8], [0, 1, -1], [0, 1], [0.0, 1.0, 2.0], 3])
def test_anything_but_an_action_for_each_arena_is_refused(actions: Any) -> None:
    env = arrays()
    env.reset()
    with pytest.raises(ValueError, match="one of 0 to 7 for each of the 3 arenas"):
        env.step(actions)


def test_actions_may_be_a_list() -> None:
    env = arrays()
    env.reset()
    assert env.step([0, 1, 2])[0].tolist() == [[7, 14, 11], [7, 13, 11], [6, 14, 11]]  # type: ignore[arg-type]


def test_an_unknown_material_is_refused() -> None:
    with pytest.raises(ScenarioError, match="no material 'gold'"):
        arrays().reset(options={"material": "gold"})
