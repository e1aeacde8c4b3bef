"""Networks against torch's own autograd, and their initial parameters."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from torch import Tensor, nn

from mc_nested.arrays import Float32s
from mc_nested.learn.dqn.compiled_engine.networks import (
    Sizes,
    backward,
    forward,
    hidden_for,
    initial_parameters,
    parameter_count,
    tanh_in_place,
)


def test_the_papers_network_has_1480_parameters() -> None:
    # 4·32 + 32, 32·32 + 32, 32·8 + 8
    assert parameter_count((4, 32, 32, 8)) == 160 + 1056 + 264


def test_initial_parameters_are_uniform_within_one_over_the_root_of_the_input_count() -> None:
    flat = initial_parameters((100, 400, 2), np.random.default_rng(0))
    first, last = flat[: 101 * 400], flat[101 * 400 :]
    assert np.abs(first).max() <= 0.1
    assert first.std() == pytest.approx(0.1 / np.sqrt(3), rel=0.02)
    assert np.abs(last).max() <= 0.05
    assert np.abs(last).max() > 0.045


@given(st.lists(st.floats(-30, 30, width=32), min_size=1, max_size=40))
def test_tanh_is_accurate_to_the_last_bits(values: list[float]) -> None:
    array = np.array([values], np.float32)
    expected = np.tanh(array.astype(np.float64))
    tanh_in_place(array)
    np.testing.assert_allclose(array, expected, rtol=4e-7, atol=1e-30)  # 3.5e-7 over every seventh 32-bit float
    assert np.abs(array - expected).max() < 3e-7


def reference(flat: Tensor, sizes: Sizes, inputs: Tensor) -> Tensor:
    """Return one network by torch.nn, sharing no code with ours, for inputs (batch, inputs)."""
    start = 0
    for index in range(len(sizes) - 1):
        width_in, width_out = sizes[index], sizes[index + 1]
        end = start + (width_in + 1) * width_out
        layer = flat[start:end].reshape(width_out, width_in + 1)
        inputs = nn.functional.linear(inputs, layer[:, :-1], layer[:, -1])
        start = end
        if index < len(sizes) - 2:
            inputs = torch.tanh(inputs)
    return inputs


def columns(inputs: Tensor) -> Float32s:
    """Return (batch, inputs) as ``forward`` takes them: states as columns, a 1 below each."""
    return np.ascontiguousarray(torch.cat((inputs, torch.ones(len(inputs), 1)), 1).numpy().T)


@pytest.mark.parametrize("sizes", [(4, 32, 32, 8), (3, 5, 2), (2, 6, 5, 4, 3)])
def test_values_and_gradients_match_autograd(sizes: Sizes) -> None:
    batch = 7
    random = torch.Generator().manual_seed(1)
    parameters = torch.randn(parameter_count(sizes), generator=random)
    inputs = torch.randn(batch, sizes[0], generator=random)
    slope = torch.randn(batch, sizes[-1], generator=random)

    widths, hidden, values = np.array(sizes), hidden_for(sizes, batch), np.empty((sizes[-1], batch), np.float32)
    forward(parameters.numpy(), widths, columns(inputs), hidden, values)
    gradient, scratch = np.empty(parameter_count(sizes), np.float32), hidden_for(sizes, batch)
    downwards = np.ascontiguousarray(slope.numpy().T)
    backward(parameters.numpy(), widths, columns(inputs), hidden, downwards, gradient, scratch)

    leaf = parameters.clone().requires_grad_()
    expected = reference(leaf, sizes, inputs)
    expected.backward(slope)  # type: ignore[no-untyped-call]  # torch leaves it untyped
    assert leaf.grad is not None
    np.testing.assert_allclose(values.T, expected.detach().numpy(), rtol=1e-5, atol=1e-5)
    np.testing.assert_allclose(gradient, leaf.grad.numpy(), rtol=1e-4, atol=5e-5)
