"""Many small networks of one shape as one batch: the leading axis of every tensor is the network.

The parameters of a network lie flat in one row, layer after layer, so that an optimiser, a copy or a checkpoint is one
operation on one tensor (networks, parameters); ``split`` gives the layers as views of it. Hidden layers use tanh, the
last is linear (paper, appendix: hyper-parameters).
"""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

Sizes = tuple[int, ...]
"""Widths from the input to the output: (4, 32, 32, 8) has two hidden layers of 32."""


class Layer(NamedTuple):
    """One layer of every network: weight (networks, inputs, outputs) and bias (networks, 1, outputs)."""

    weight: Tensor
    bias: Tensor


def parameter_count(sizes: Sizes) -> int:
    """Parameters of one network of that shape."""
    return sum((inputs + 1) * outputs for inputs, outputs in pairwise(sizes))


def initial_parameters(sizes: Sizes, random: np.random.Generator) -> NDArray[np.float32]:
    """One network's parameters (parameters,), uniform in ±1/√inputs of each layer (README: the task)."""
    parts = [random.uniform(-1.0, 1.0, (inputs + 1) * outputs) / np.sqrt(inputs) for inputs, outputs in pairwise(sizes)]
    return np.concatenate(parts).astype(np.float32)


def split(flat: Tensor, sizes: Sizes) -> list[Layer]:
    """The layers of (networks, parameters), as views of it."""
    layers = []
    start = 0
    for inputs, outputs in pairwise(sizes):
        weight = flat[:, start : start + inputs * outputs].view(-1, inputs, outputs)
        start += inputs * outputs
        layers.append(Layer(weight, flat[:, None, start : start + outputs]))
        start += outputs
    return layers


def activations_of(networks: int, batch: int, sizes: Sizes) -> list[Tensor]:
    """Standing tensors for one ``forward``: (networks, batch, width) for each layer behind the input."""
    return [torch.empty(networks, batch, width) for width in sizes[1:]]


def forward(layers: Sequence[Layer], inputs: Tensor, activations: Sequence[Tensor]) -> Tensor:
    """The networks' outputs (networks, batch, outputs) for inputs (networks, batch, inputs).

    Every layer's output is written into ``activations``, the last of which is returned: a fresh tensor each time would
    have to be paged in each time, which costs more than the arithmetic.
    """
    for layer, out in zip(layers, activations, strict=True):
        torch.baddbmm(layer.bias, inputs, layer.weight, out=out)
        if out is not activations[-1]:
            # NumPy's tanh is vectorised where torch's is not: measured 2 to 8 times faster, on the same memory.
            values = out.numpy()
            np.tanh(values, out=values)
        inputs = out
    return activations[-1]


def backward(
    layers: Sequence[Layer],
    inputs: Tensor,
    activations: Sequence[Tensor],
    output_gradient: Tensor,
    gradients: Sequence[Layer],
    scratch: Sequence[Tensor],
) -> None:
    """Write into ``gradients`` what the gradient at the outputs means for each layer's weight and bias.

    ``activations`` are those of the ``forward`` on the same inputs; ``scratch`` has the same shapes and is overwritten.
    """
    gradient = output_gradient
    for index in reversed(range(len(layers))):
        below = activations[index - 1] if index else inputs
        torch.bmm(below.transpose(1, 2), gradient, out=gradients[index].weight)
        torch.sum(gradient, 1, keepdim=True, out=gradients[index].bias)
        if index:
            through = torch.bmm(gradient, layers[index].weight.transpose(1, 2), out=scratch[index - 1])
            gradient = torch.ops.aten.tanh_backward.grad_input(through, below, grad_input=through)
