"""Batched networks against torch's own autograd, and their initial parameters."""

import numpy as np
import pytest
import torch
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from torch import Tensor, nn

from mc_nested.learn.networks import (
    Activations,
    Sizes,
    backward,
    forward,
    initial_parameters,
    parameter_count,
    split,
)


def test_the_papers_network_has_1480_parameters() -> None:
    # 4·32 + 32, 32·32 + 32, 32·8 + 8
    assert parameter_count((4, 32, 32, 8)) == 160 + 1056 + 264


def test_initial_parameters_are_uniform_within_one_over_root_of_the_inputs() -> None:
    flat = initial_parameters((100, 400, 2), np.random.default_rng(0))
    first, last = flat[: 101 * 400], flat[101 * 400 :]
    assert np.abs(first).max() <= 0.1
    assert first.std() == pytest.approx(0.1 / np.sqrt(3), rel=0.02)
    assert np.abs(last).max() <= 0.05
    assert np.abs(last).max() > 0.045


def test_layers_are_views_of_the_flat_parameters() -> None:
    flat = np.zeros((2, parameter_count((3, 4, 2))), np.float32)
    hidden, last = split(flat, (3, 4, 2))
    assert hidden.shape == (2, 4, 3 + 1)
    assert last.shape == (2, 2, 4 + 1)
    last[:, 1].fill(1.0)
    assert flat[:, -5:].tolist() == [[1.0] * 5] * 2
    assert flat[:, :-5].any() == np.False_


def reference(flat: Tensor, sizes: Sizes, inputs: Tensor) -> Tensor:
    """One network by torch.nn, sharing no code with ours, for inputs (batch, inputs)."""
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


def columns(inputs: Tensor) -> NDArray[np.float32]:
    """(…, batch, inputs) as ``forward`` takes them: states as columns, a 1 below each."""
    ones = torch.ones(*inputs.shape[:-1], 1)
    return torch.cat((inputs, ones), -1).transpose(-1, -2).numpy()


@pytest.mark.parametrize("sizes", [(4, 32, 32, 8), (3, 5, 2), (2, 6, 5, 4, 3)])
def test_values_and_gradients_are_those_of_autograd(sizes: Sizes) -> None:
    networks, batch = 3, 7
    random = torch.Generator().manual_seed(1)
    flat = torch.randn(networks, parameter_count(sizes), generator=random)
    inputs = torch.randn(networks, batch, sizes[0], generator=random)
    output_gradient = torch.randn(networks, batch, sizes[-1], generator=random)

    activations = Activations((networks,), batch, sizes)
    layers = split(flat.numpy(), sizes)
    values = torch.from_numpy(forward(layers, columns(inputs), activations)).transpose(1, 2)
    gradient = torch.zeros_like(flat)
    scratch = [np.empty((networks, width, batch), np.float32) for width in sizes[1:-1]]
    slope = output_gradient.transpose(1, 2).contiguous().numpy()
    backward(layers, columns(inputs), activations.hidden, slope, split(gradient.numpy(), sizes), scratch)

    for network in range(networks):
        parameters = flat[network].clone().requires_grad_()
        expected = reference(parameters, sizes, inputs[network])
        expected.backward(output_gradient[network])  # type: ignore[no-untyped-call]  # torch leaves it untyped
        torch.testing.assert_close(values[network], expected.detach())
        torch.testing.assert_close(gradient[network], parameters.grad, rtol=1e-4, atol=5e-5)


@given(networks=st.integers(1, 6), batches=st.integers(1, 3))
def test_a_networks_values_are_the_same_to_the_bit_whatever_lies_beside_it(networks: int, batches: int) -> None:
    sizes, random = (4, 32, 32, 8), np.random.default_rng(networks)
    flat = np.stack([initial_parameters(sizes, random) for _ in range(networks)])
    inputs = np.ones((batches, networks, 5, 32), np.float32)
    inputs[:, :, :-1] = random.uniform(-1, 1, (batches, networks, 4, 32))
    together = forward(split(flat, sizes), inputs, Activations((batches, networks), 32, sizes))
    for network in range(networks):
        for batch in range(batches):
            one = forward(split(flat[[network]], sizes), inputs[batch, [network]], Activations((1,), 32, sizes))
            np.testing.assert_array_equal(one[0], together[batch, network])
