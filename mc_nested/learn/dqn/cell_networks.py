"""A network's passes where its input is one cell among many and a few numbers (state_space.py: encoding ``cell``).

Of the first layer's inputs for cells, one is 1 and the rest are 0: the layer is a sum of a few columns of its weights,
where a matrix product would mostly multiply by 0. From the second layer on, networks.py does the work.
"""

from typing import NamedTuple

import numpy as np

from mc_nested.arrays import Float32s, Int64s
from mc_nested.learn.dqn.compiled import compiled
from mc_nested.learn.dqn.networks import Sizes, backward, forward, hidden_for, tanh_in_place


class CellPasses(NamedTuple):
    """Arrays that the passes of one batch reuse: hidden nodes (width + 1, batch) of each layer, the last row 1."""

    first: Float32s
    hidden: tuple[Float32s, ...]
    values: Float32s


def passes_for(sizes: Sizes, batch: int) -> CellPasses:
    """The arrays for passes of that many states through networks of that shape, of two hidden layers or more."""
    first, *hidden = hidden_for(sizes, batch)
    return CellPasses(first, tuple(hidden), np.empty((sizes[-1], batch), np.float32))


@compiled(fastmath=True, nogil=True)
def forward_cells(parameters: Float32s, sizes: Int64s, states: Int64s, numbers: Float32s, passes: CellPasses) -> None:
    """Write the values (actions, batch) of the states (batch,) and their hidden nodes into ``passes``.

    ``numbers`` (rest, inputs - cells + 1) are the inputs after the cell's, by the rest of a state's index, and a 1.
    """
    nodes, width = sizes[1], sizes[0] + 1
    weights = parameters[: nodes * width].reshape(nodes, width)
    rest, others = numbers.shape
    cells = width - others
    at, rows = states // rest, states % rest
    for node in range(nodes):
        own = weights[node]
        for column in range(len(states)):
            total = own[at[column]]
            for other in range(others):
                total += own[cells + other] * numbers[rows[column], other]
            passes.first[node, column] = total
    tanh_in_place(passes.first[:nodes])
    forward(parameters[nodes * width :], sizes[1:], passes.first, passes.hidden, passes.values)


@compiled(fastmath=True, nogil=True)
def backward_cells(
    parameters: Float32s,
    sizes: Int64s,
    states: Int64s,
    numbers: Float32s,
    passes: CellPasses,
    slope: Float32s,
    gradient: Float32s,
    scratch: CellPasses,
) -> None:
    """Write each parameter's gradient into ``gradient``, from the slope at the outputs (actions, batch).

    ``passes`` is that of ``forward_cells``; ``scratch``, of the same shape, is overwritten.
    """
    nodes, width = sizes[1], sizes[0] + 1
    upper = nodes * width
    backward(parameters[upper:], sizes[1:], passes.first, passes.hidden, slope, gradient[upper:], scratch.hidden)
    second = sizes[2]
    weights = parameters[upper : upper + second * (nodes + 1)].reshape(second, nodes + 1)
    np.dot(weights.T, scratch.hidden[0][:second], scratch.first)
    rest, others = numbers.shape
    cells = width - others
    first = gradient[:upper].reshape(nodes, width)
    first[:] = np.float32(0)
    at, rows = states // rest, states % rest
    for node in range(nodes):
        of_node = first[node]
        for column in range(len(states)):
            own = scratch.first[node, column] * (np.float32(1) - passes.first[node, column] ** 2)
            of_node[at[column]] += own
            for other in range(others):
                of_node[cells + other] += own * numbers[rows[column], other]
