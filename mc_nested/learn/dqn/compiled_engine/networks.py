"""Small networks, compiled: their shapes, their parameters, and the two passes through one of them.

The parameters of a network are flat in one row, layer after layer, so that an optimiser step, a copy or a checkpoint is
one operation on one array (networks, parameters). Hidden layers use tanh, the last is linear (paper, appendix:
hyper-parameters).

The states of a batch are columns. Below the last feature and the last node of every hidden layer is a 1 that multiplies
the biases, the last column of each weight. So a layer is one matrix product forward and two backward.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mc_nested.arrays import Float32s, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.compiled_engine.products import multiply

Sizes = tuple[int, ...]
"""Widths from the input to the output: (4, 32, 32, 8) has two hidden layers of 32."""


def parameter_count(sizes: Sizes) -> int:
    """Return parameters of one network of that shape."""
    return sum((inputs + 1) * outputs for inputs, outputs in pairwise(sizes))


def initial_parameters(sizes: Sizes, random: np.random.Generator) -> Float32s:
    """Return one network's parameters (parameters,), uniform in ±1/√inputs of each layer (docs/explanation/task.md)."""
    parts = [random.uniform(-1.0, 1.0, (inputs + 1) * outputs) / np.sqrt(inputs) for inputs, outputs in pairwise(sizes)]
    return np.concatenate(parts).astype(np.float32)


def hidden_for(sizes: Sizes, batch: int) -> tuple[Float32s, ...]:
    """Return an array (width + 1, batch) for each hidden layer's nodes, the last row being 1."""
    return tuple(np.ones((width + 1, batch), np.float32) for width in sizes[1:-1])


@compiled(fused=True)
def forward(
    parameters: Float32s, sizes: Int64s, inputs: Float32s, hidden: Sequence[Float32s], values: Float32s
) -> None:
    """Write the outputs (outputs, batch) for inputs (inputs + 1, batch), the last row 1, and the ``hidden`` nodes."""
    start = 0
    below = inputs
    for layer in range(len(hidden)):
        outputs, width = sizes[layer + 1], sizes[layer] + 1
        nodes = hidden[layer][:outputs]
        multiply(parameters[start : start + outputs * width].reshape(outputs, width), below, nodes)
        tanh_in_place(nodes)
        start += outputs * width
        below = hidden[layer]
    multiply(parameters[start:].reshape(sizes[-1], sizes[-2] + 1), below, values)


@compiled(fused=True)
def backward(
    parameters: Float32s,
    sizes: Int64s,
    inputs: Float32s,
    hidden: Sequence[Float32s],
    slope: Float32s,
    gradient: Float32s,
    scratch: Sequence[Float32s],
) -> None:
    """Write the gradient of each parameter, from the slope at the outputs (outputs, batch), into ``gradient``.

    ``inputs`` and ``hidden`` are those of ``forward``; ``scratch``, shaped as ``hidden``, is overwritten.
    """
    end = len(parameters)
    above = slope
    for layer in range(len(hidden), -1, -1):
        outputs, width = sizes[layer + 1], sizes[layer] + 1
        start = end - outputs * width
        below = hidden[layer - 1] if layer else inputs
        multiply(above, below.T, gradient[start:end].reshape(outputs, width))
        if layer:
            through = scratch[layer - 1][: width - 1]
            weights = parameters[start:end].reshape(outputs, width)
            multiply(weights.T[: width - 1], above, through)
            for node in range(width - 1):
                for column in range(through.shape[1]):
                    through[node, column] *= np.float32(1) - below[node, column] ** 2
            above = through
        end = start


@compiled(fused=True)
def tanh_in_place(values: Float32s) -> None:
    """Replace values by their hyperbolic tangent, a quotient of polynomials, which vectorises; within 3e-7.

    Beyond ±7.9 it stays at its value there. The coefficients are those of the minimax approximation in the library
    Eigen. The terms are added in pairs (Estrin's scheme), which need not wait for each other.
    """
    flat = values.reshape(-1)
    for at in range(len(flat)):
        x = min(max(flat[at], np.float32(-7.9)), np.float32(7.9))
        s = x * x
        t = s * s
        above_0 = np.float32(6.37261928875436e-04) * s + np.float32(4.89352455891786e-03)
        above_2 = np.float32(5.12229709037114e-08) * s + np.float32(1.48572235717979e-05)
        above_4 = np.float32(2.00018790482477e-13) * s + np.float32(-8.60467152213735e-11)
        above_6 = np.float32(-2.76076847742355e-16)
        below_0 = np.float32(2.26843463243900e-03) * s + np.float32(4.89352518554385e-03)
        below_2 = np.float32(1.19825839466702e-06) * s + np.float32(1.18534705686654e-04)
        above = ((above_6 * t + above_4) * t + above_2) * t + above_0
        flat[at] = x * above / (below_2 * t + below_0)
