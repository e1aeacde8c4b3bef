"""Batched networks against torch's own autograd, and their initial parameters."""

import numpy as np
import pytest
import torch
from torch import Tensor, nn

from mc_nested.learn.networks import (
    Sizes,
    activations_of,
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
    flat = torch.zeros(2, parameter_count((3, 4, 2)))
    hidden, last = split(flat, (3, 4, 2))
    assert hidden.weight.shape == (2, 3, 4)
    assert last.bias.shape == (2, 1, 2)
    last.bias.fill_(1.0)
    assert flat[:, -2:].tolist() == [[1.0, 1.0], [1.0, 1.0]]
    assert flat[:, :-2].abs().sum() == 0


def reference(flat: Tensor, sizes: Sizes, inputs: Tensor) -> Tensor:
    """One network by torch.nn, sharing no code with ours; weights are stored transposed there."""
    start = 0
    for index in range(len(sizes) - 1):
        width_in, width_out = sizes[index], sizes[index + 1]
        weight = flat[start : start + width_in * width_out].reshape(width_in, width_out)
        start += width_in * width_out
        inputs = nn.functional.linear(inputs, weight.T, flat[start : start + width_out])
        start += width_out
        if index < len(sizes) - 2:
            inputs = torch.tanh(inputs)
    return inputs


@pytest.mark.parametrize("sizes", [(4, 32, 32, 8), (3, 5, 2), (2, 6, 5, 4, 3)])
def test_values_and_gradients_are_those_of_autograd(sizes: Sizes) -> None:
    networks, batch = 3, 7
    random = torch.Generator().manual_seed(1)
    flat = torch.randn(networks, parameter_count(sizes), generator=random)
    inputs = torch.randn(networks, batch, sizes[0], generator=random)
    output_gradient = torch.randn(networks, batch, sizes[-1], generator=random)

    activations = activations_of(networks, batch, sizes)
    values = forward(split(flat, sizes), inputs, activations)
    gradient = torch.zeros_like(flat)
    scratch = activations_of(networks, batch, sizes)
    backward(split(flat, sizes), inputs, activations, output_gradient, split(gradient, sizes), scratch)

    for network in range(networks):
        parameters = flat[network].clone().requires_grad_()
        expected = reference(parameters, sizes, inputs[network])
        expected.backward(output_gradient[network])  # type: ignore[no-untyped-call]  # torch leaves it untyped
        torch.testing.assert_close(values[network], expected.detach())
        torch.testing.assert_close(gradient[network], parameters.grad)
