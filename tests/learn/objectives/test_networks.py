"""The networks by NumPy give what the networks by torch give, in arenas of any size."""

import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from mc_nested.arrays import Bools
from mc_nested.learn.dqn.states import NONE, WANTED
from mc_nested.learn.dqn.torch_engine import objective_networks as by_torch
from mc_nested.learn.dqn.torch_engine.rows import flat_of
from mc_nested.learn.objectives.arenas import order_planes, outside, plane_of_each, reach_planes, side_for
from mc_nested.learn.objectives.networks import OrderNetwork, ReachNetwork


def made(seed: int) -> tuple[by_torch.ReachModule, by_torch.OrderModule]:
    with torch.random.fork_rng():
        torch.manual_seed(seed)
        return by_torch.ReachModule(8), by_torch.OrderModule()


def some_arenas(
    seed: int, size: int, runs: int = 3
) -> tuple[Bools, Bools, "np.ndarray[tuple[int, ...], np.dtype[np.int64]]"]:
    """Return what is wanted, what stands, and where the agents are."""
    random = np.random.default_rng(seed)
    side = side_for(size)
    occupied = outside(size, side)[None] | (random.random((runs, side, side)) < 0.3)
    occupied[:, 1, 1] = False
    wanted = ~occupied & (random.random(occupied.shape) < 0.2)
    agents = np.array([random.permutation(np.argwhere(~stands))[0] for stands in occupied])
    return wanted, occupied, agents


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 1000), st.integers(5, 20))
def test_both_main_agents_value_every_cell_alike(seed: int, size: int) -> None:
    _, network = made(seed)
    wanted, occupied, agents = some_arenas(seed, size)
    planes, _ = order_planes(wanted, occupied, agents)
    with torch.no_grad():
        theirs = network(torch.from_numpy(planes.astype(np.float32))).numpy()
    ours = OrderNetwork(flat_of(network)).values(planes)
    np.testing.assert_allclose(ours.reshape(len(planes), -1), theirs, atol=1e-5, rtol=1e-5)
    assert (ours[~planes[:, WANTED]] == NONE).all()


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 1000), st.integers(5, 20))
def test_both_nested_agents_value_every_action_alike(seed: int, size: int) -> None:
    network, _ = made(seed)
    _, occupied, agents = some_arenas(seed, size)
    goals = np.random.default_rng(seed).integers(1, size + 1, agents.shape)
    planes = reach_planes(plane_of_each(goals, side_for(size)), occupied, agents)
    with torch.no_grad():
        theirs = network(torch.from_numpy(planes.astype(np.float32))).numpy()
    ours = ReachNetwork(flat_of(network))
    np.testing.assert_allclose(ours.values(ours.reaching(planes), agents), theirs, atol=1e-6, rtol=1e-4)


def test_a_window_of_the_near_cells_is_the_same_wherever_the_arena_ends() -> None:
    network, _ = made(0)
    goal, agent = np.array([[3, 4]]), np.array([[3, 3]])
    values = []
    for side in (7, 12, 34):
        occupied = outside(5, side)[None]
        own = ReachNetwork(flat_of(network))
        values.append(own.values(own.reaching(reach_planes(plane_of_each(goal, side), occupied, agent)), agent))
    np.testing.assert_allclose(values[0], values[1], rtol=1e-4)
    np.testing.assert_allclose(values[0], values[2], rtol=1e-4)


@pytest.mark.parametrize("network", [ReachNetwork, OrderNetwork])
@pytest.mark.parametrize("parameters", [0, 100, 100_000])
def test_parameters_of_another_number_are_refused(
    network: "type[ReachNetwork] | type[OrderNetwork]", parameters: int
) -> None:
    with pytest.raises(ValueError, match="parameters"):
        network(np.zeros(parameters, np.float32))
