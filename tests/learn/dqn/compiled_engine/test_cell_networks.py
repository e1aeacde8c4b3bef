"""Networks that see one cell among many compute the same as networks fed with every input."""

import numpy as np
import pytest
import torch

from mc_nested.arrays import Float32s, Int64s
from mc_nested.learn.dqn.compiled_engine.cell_networks import (
    CellPasses,
    backward_cells,
    by_input,
    by_node,
    forward_cells,
    passes_for,
)
from mc_nested.learn.dqn.compiled_engine.networks import Sizes, backward, forward, hidden_for, parameter_count
from mc_nested.learn.dqn.states import StateSpace
from tests.learn.dqn.compiled_engine.test_networks import reference

BATCH = 9


def space_of(highest: list[int]) -> StateSpace:
    return StateSpace(np.array([highest]), actions=5, encoding="cell")


SPACES = [space_of([4, 3, 2, 1]), space_of([2, 2, 4]), space_of([4, 4])]
IDS = ["x, y, b and a material", "x, y and b", "a cell alone"]
HIDDEN = [(6, 5), (4, 6, 3)]


def numbers_of(space: StateSpace) -> Float32s:
    """Return the inputs after the cell's, as the passes take them."""
    rest = space.count // space.cells
    return np.ascontiguousarray(space.table[:rest, space.cells :])


def drawn(space: StateSpace, sizes: Sizes) -> tuple[Float32s, Int64s, Float32s]:
    """Return parameters, states with one of them twice, and slopes."""
    random = np.random.default_rng(2)
    parameters = random.standard_normal(parameter_count(sizes)).astype(np.float32)
    states = random.integers(0, space.count, BATCH)
    states[1] = states[0]
    slope = random.standard_normal((sizes[-1], BATCH)).astype(np.float32)
    return parameters, states, slope


def passed(space: StateSpace, sizes: Sizes) -> tuple[CellPasses, Float32s]:
    """Return the values and hidden nodes, and the gradient."""
    parameters, states, slope = drawn(space, sizes)
    passes, scratch = passes_for(sizes, BATCH), passes_for(sizes, BATCH)
    gradient = np.full(parameter_count(sizes), np.nan, np.float32)
    by_input(parameters, np.array(sizes))
    forward_cells(parameters, np.array(sizes), states, numbers_of(space), passes)
    backward_cells(parameters, np.array(sizes), states, numbers_of(space), passes, slope, gradient, scratch)
    by_node(gradient, np.array(sizes))
    return passes, gradient


def test_reordering_weights_by_input_and_back_by_node_restores_them() -> None:
    sizes = (3, 2, 2, 1)  # the first layer: 2 nodes of 3 inputs and a bias
    parameters = np.arange(parameter_count(sizes), dtype=np.float32)
    turned = parameters.copy()
    by_input(turned, np.array(sizes))
    assert turned[:8].tolist() == [0, 4, 1, 5, 2, 6, 3, 7]
    assert turned[8:].tolist() == parameters[8:].tolist()
    by_node(turned, np.array(sizes))
    assert turned.tolist() == parameters.tolist()


@pytest.mark.parametrize("hidden", HIDDEN, ids=["two layers", "three layers"])
@pytest.mark.parametrize("space", SPACES, ids=IDS)
def test_cell_passes_match_the_values_and_gradients_of_a_network_fed_with_every_input(
    space: StateSpace, hidden: tuple[int, ...]
) -> None:
    sizes = space.network(hidden)
    parameters, states, slope = drawn(space, sizes)
    inputs, widths = np.ascontiguousarray(space.table[states].T), np.array(sizes)
    nodes, values = hidden_for(sizes, BATCH), np.empty((sizes[-1], BATCH), np.float32)
    forward(parameters, widths, inputs, nodes, values)
    expected = np.empty(parameter_count(sizes), np.float32)
    backward(parameters, widths, inputs, nodes, slope, expected, hidden_for(sizes, BATCH))

    passes, gradient = passed(space, sizes)
    np.testing.assert_allclose(passes.values, values, rtol=1e-4, atol=1e-5)
    np.testing.assert_allclose(gradient, expected, rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("hidden", HIDDEN, ids=["two layers", "three layers"])
@pytest.mark.parametrize("space", SPACES, ids=IDS)
def test_cell_passes_match_the_values_and_gradients_of_autograd(space: StateSpace, hidden: tuple[int, ...]) -> None:
    sizes = space.network(hidden)
    parameters, states, slope = drawn(space, sizes)
    leaf = torch.from_numpy(parameters.copy()).requires_grad_()
    expected = reference(leaf, sizes, torch.from_numpy(space.table[states][:, :-1].copy()))
    expected.backward(torch.from_numpy(np.ascontiguousarray(slope.T)))  # type: ignore[no-untyped-call]
    assert leaf.grad is not None

    passes, gradient = passed(space, sizes)
    np.testing.assert_allclose(passes.values.T, expected.detach().numpy(), rtol=1e-4, atol=1e-5)
    np.testing.assert_allclose(gradient, leaf.grad.numpy(), rtol=1e-3, atol=5e-5)


def test_only_cells_visited_in_the_batch_have_a_gradient() -> None:
    space = SPACES[0]
    sizes = space.network((6, 5))
    _, states, _ = drawn(space, sizes)
    gradient = passed(space, sizes)[1][: 6 * (sizes[0] + 1)].reshape(6, -1)
    visited = np.unique(states // (space.count // space.cells))
    assert set(np.flatnonzero(gradient[:, : space.cells].any(axis=0))) == set(visited.tolist())


def test_a_state_has_the_same_values_alone_and_in_a_batch() -> None:
    space = SPACES[0]
    sizes = space.network((6, 5))
    parameters, states, _ = drawn(space, sizes)
    one = passes_for(sizes, 1)
    by_input(parameters, np.array(sizes))
    forward_cells(parameters, np.array(sizes), states[3:4], numbers_of(space), one)
    np.testing.assert_allclose(one.values[:, 0], passed(space, sizes)[0].values[:, 3], rtol=1e-5, atol=1e-6)
