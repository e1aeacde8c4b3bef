"""Small networks, compiled: their shapes, their parameters, and the two passes through one of them.

The parameters of a network lie flat in one row, layer after layer, so that an optimiser, a copy or a checkpoint is one
operation on one array (networks, parameters). Hidden layers use tanh, the last is linear (paper, appendix:
hyper-parameters).

States of a batch are columns, and below the last feature and the last node of every hidden layer lies a 1 that the
biases, the last column of each weight, are multiplied with: a layer is one product forward and two back.
"""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Ints = NDArray[np.int64]

Sizes = tuple[int, ...]
"""Widths from the input to the output: (4, 32, 32, 8) has two hidden layers of 32."""


def parameter_count(sizes: Sizes) -> int:
    """Parameters of one network of that shape."""
    return sum((inputs + 1) * outputs for inputs, outputs in pairwise(sizes))


def initial_parameters(sizes: Sizes, random: np.random.Generator) -> Floats:
    """One network's parameters (parameters,), uniform in ±1/√inputs of each layer (README: the task)."""
    parts = [random.uniform(-1.0, 1.0, (inputs + 1) * outputs) / np.sqrt(inputs) for inputs, outputs in pairwise(sizes)]
    return np.concatenate(parts).astype(np.float32)


def hidden_for(sizes: Sizes, batch: int) -> tuple[Floats, ...]:
    """An array (width + 1, batch) for each hidden layer's nodes, the last row being 1."""
    return tuple(np.ones((width + 1, batch), np.float32) for width in sizes[1:-1])


@njit(cache=True, fastmath=True, error_model="numpy")
def forward(parameters: Floats, sizes: Ints, inputs: Floats, hidden: Sequence[Floats], values: Floats) -> None:
    """Write the outputs (outputs, batch) for inputs (inputs + 1, batch), the last row 1, and the ``hidden`` nodes."""
    start = 0
    below = inputs
    for layer in range(len(hidden)):
        outputs, width = sizes[layer + 1], sizes[layer] + 1
        nodes = hidden[layer][:outputs]
        np.dot(parameters[start : start + outputs * width].reshape(outputs, width), below, nodes)
        tanh_in_place(nodes)
        start += outputs * width
        below = hidden[layer]
    np.dot(parameters[start:].reshape(sizes[-1], sizes[-2] + 1), below, values)


@njit(cache=True, fastmath=True, error_model="numpy")
def backward(
    parameters: Floats,
    sizes: Ints,
    inputs: Floats,
    hidden: Sequence[Floats],
    slope: Floats,
    gradient: Floats,
    scratch: Sequence[Floats],
) -> None:
    """Write what the slope at the outputs (outputs, batch) means for each parameter into ``gradient``.

    ``inputs`` and ``hidden`` are those of ``forward``; ``scratch``, shaped as ``hidden``, is overwritten.
    """
    end = len(parameters)
    above = slope
    for layer in range(len(hidden), -1, -1):
        outputs, width = sizes[layer + 1], sizes[layer] + 1
        start = end - outputs * width
        below = hidden[layer - 1] if layer else inputs
        np.dot(above, below.T, gradient[start:end].reshape(outputs, width))
        if layer:
            through = scratch[layer - 1]
            np.dot(parameters[start:end].reshape(outputs, width).T, above, through)
            for node in range(width - 1):
                for column in range(through.shape[1]):
                    through[node, column] *= np.float32(1) - below[node, column] ** 2
            above = through[: width - 1]
        end = start


@njit(cache=True, fastmath=True, error_model="numpy")
def tanh_in_place(values: Floats) -> None:
    """The hyperbolic tangent by a quotient of polynomials that a processor does many of at once; within 3e-7.

    Beyond ±7.9 it is 1 in 32 bits. The coefficients are those of the minimax approximation in the library Eigen.
    """
    for row in range(values.shape[0]):
        for column in range(values.shape[1]):
            x = min(max(values[row, column], np.float32(-7.9)), np.float32(7.9))
            s = x * x
            above = np.float32(-2.76076847742355e-16)
            above = above * s + np.float32(2.00018790482477e-13)
            above = above * s + np.float32(-8.60467152213735e-11)
            above = above * s + np.float32(5.12229709037114e-08)
            above = above * s + np.float32(1.48572235717979e-05)
            above = above * s + np.float32(6.37261928875436e-04)
            above = above * s + np.float32(4.89352455891786e-03)
            below = np.float32(1.19825839466702e-06)
            below = below * s + np.float32(1.18534705686654e-04)
            below = below * s + np.float32(2.26843463243900e-03)
            below = below * s + np.float32(4.89352518554385e-03)
            values[row, column] = x * above / below
