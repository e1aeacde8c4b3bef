"""ArenaVectorEnv: its games say whether episodes can be saved half-way; gymnasium's wrappers fit over it."""

import numpy as np
import pytest
from gymnasium.wrappers.vector import RecordEpisodeStatistics

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.game import Game, Resumable
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arena.vector import ArenaVectorEnv, resumable_arenas
from sim.grid import GridGame, GridVectorEnv

LINE = load_scenario("line")


class StartsOver(GridGame):
    @property
    def resumable(self) -> Resumable | None:
        return None


def arenas(*games: Game) -> ArenaVectorEnv:
    return ArenaVectorEnv([ArenaEnv(game, LINE) for game in games])


def test_arenas_can_be_resumed_if_every_game_can() -> None:
    both, one = arenas(GridGame(LINE), GridGame(LINE)), arenas(GridGame(LINE), StartsOver(LINE))
    assert both.resumable is both
    assert one.resumable is None
    assert resumable_arenas(SingleAgentVectorEnv(one, [LINE] * 2)) is None
    single = SingleAgentVectorEnv(both, [LINE] * 2)
    assert resumable_arenas(single) is single


def test_a_restored_episode_goes_on_to_its_end_as_it_did_before() -> None:
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


def test_gymnasiums_wrappers_fit_over_it_and_start_their_episodes_over() -> None:
    for env in (arenas(GridGame(LINE)), GridVectorEnv([LINE])):
        wrapped = RecordEpisodeStatistics(env)
        wrapped.reset()
        assert wrapped.step(np.array([Action.BD]))[0].tolist() == [[7, 13, 10]]
        assert resumable_arenas(wrapped) is None


def test_every_arena_gets_a_seed_of_its_own_as_in_gymnasiums_vector_envs() -> None:
    env = arenas(GridGame(LINE), GridGame(LINE))
    env.reset(seed=5)
    assert [arena.np_random_seed for arena in env.envs] == [5, 6]
    env.reset(seed=[9, None])
    assert [arena.np_random_seed for arena in env.envs] == [9, 6]


def test_a_seed_too_few_is_refused() -> None:
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
