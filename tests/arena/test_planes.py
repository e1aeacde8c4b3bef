"""The arena as planes: drawn by hand, the same for a simulated and a step-by-step game, and what its view passes on."""

from dataclasses import replace

import numpy as np
import pytest
from gymnasium.spaces import Box
from hypothesis import given
from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.planes import PlanesVectorEnv, planes_of, shares, start_planes, with_material
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.single import SingleAgentVectorEnv
from mc_nested.arena.vector import ArenaVectorEnv
from mc_nested.errors import ScenarioError
from sim.grid import GridGame, GridVectorEnv
from tests.learn.made_experiments import BAR, DOT

SMALL = replace(DOT, name="small", design=frozenset({(2, 3), (3, 3), (2, 4), (3, 4)}), start=(2, 1), size=5)


def test_planes_show_the_agent_the_blocks_the_share_left_and_the_start() -> None:
    occupied = np.zeros((1, 5, 5), np.bool_)
    occupied[0, 2, 3] = True
    planes = planes_of(np.array([[3, 2, 3]]), occupied, np.array([[2, 1]]), np.array([4]))[0]
    assert planes.dtype == np.uint8
    for plane, cell in ((0, (3, 2)), (1, (2, 3)), (3, (2, 1))):
        assert np.argwhere(planes[plane]).tolist() == [list(cell)]
        assert planes[plane].max() == 255
    assert (planes[2] == 191).all(), "three blocks of four are left"


def test_a_material_fills_an_extra_plane() -> None:
    planes = with_material(np.zeros((2, 4, 5, 5), np.uint8), shares(np.array([1, 2]), 2))
    assert planes.shape == (2, 5, 5, 5)
    assert [np.unique(plane).tolist() for plane in planes[:, 4]] == [[128], [255]]


def test_start_planes_equal_the_observation_of_a_reset() -> None:
    scenarios = [DOT, BAR]
    env = PlanesVectorEnv(GridVectorEnv(scenarios), scenarios)
    np.testing.assert_array_equal(env.reset()[0], start_planes(scenarios))


def both_views(scenario: Scenario) -> list[PlanesVectorEnv]:
    arenas = GridVectorEnv([scenario]), ArenaVectorEnv([ArenaEnv(GridGame(scenario), scenario)])
    return [PlanesVectorEnv(env, [scenario]) for env in arenas]


@given(actions=st.lists(st.integers(0, 7), min_size=1, max_size=30))
def test_arrays_and_single_games_give_the_same_planes(actions: list[int]) -> None:
    views = both_views(SMALL)
    seen = [view.reset()[0] for view in views]
    for action in actions:
        np.testing.assert_array_equal(seen[0], seen[1])
        seen = [view.step(np.array([action]))[0] for view in views]
    np.testing.assert_array_equal(seen[0], seen[1])


def test_observations_lie_in_their_space() -> None:
    view = both_views(SMALL)[0]
    assert view.single_observation_space == Box(0, 255, (4, 5, 5), np.uint8)
    observations, _ = view.reset()
    assert view.observation_space.contains(observations)
    assert view.observation_space.contains(view.step(np.array([Action.FD]))[0])


def test_the_single_agent_sees_no_old_blocks_and_no_material_after_a_reset() -> None:
    env = PlanesVectorEnv(SingleAgentVectorEnv(GridVectorEnv([SMALL]), [SMALL]), [SMALL])
    first, _ = env.reset()
    assert first.shape == (1, 5, 5, 5)
    assert not first[0, 4].any(), "no material is chosen"
    chosen = env.step(np.array([1]))[0]
    assert (chosen[0, 4] == 255).all()
    assert env.step(np.array([2 + Action.FD]))[0][0, 1].any()
    again, _ = env.reset()
    np.testing.assert_array_equal(again, first)


def test_a_restored_view_continues_with_its_arenas() -> None:
    for view in both_views(SMALL):
        view.reset()
        view.step(np.array([Action.FD]))
        assert view.resumable
        kept = {name: array.copy() for name, array in view.resumable.snapshot().items()}
        expected = view.step(np.array([Action.LD]))[0]
        view.resumable.restore(kept)
        np.testing.assert_array_equal(view.step(np.array([Action.LD]))[0], expected)


def test_arenas_of_several_sizes_are_refused() -> None:
    with pytest.raises(ScenarioError, match=r"arenas of \[5, 15\] cells a side: images have one size"):
        start_planes([SMALL, DOT])
