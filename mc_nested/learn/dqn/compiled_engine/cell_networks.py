"""A network's passes where its input is one cell among many and a few numbers (states.py: encoding ``cell``).

Of the first layer's inputs for cells, one is 1 and the rest are 0: the layer is a sum of a few of its weights' columns,
where a matrix product would mostly multiply by 0. For that, a column has to lie in one piece: ``by_input`` turns the
first layer's weights round, and ``by_node`` turns them back. From the second layer on, networks.py does the work.
"""

from typing import NamedTuple

import numpy as np

from mc_nested.arrays import Float32s, Int64s
from mc_nested.compiled import compiled
from mc_nested.learn.dqn.compiled_engine.networks import Sizes, backward, forward, hidden_for, tanh_in_place
from mc_nested.learn.dqn.compiled_engine.products import multiply


class CellPasses(NamedTuple):
    """Arrays that the passes of one batch reuse: hidden nodes (width + 1, batch) of each layer, the last row 1.

    ``turned`` (batch, width) is the first layer again, a state a row.
    """

    first: Float32s
    turned: Float32s
    hidden: tuple[Float32s, ...]
    values: Float32s


def passes_for(sizes: Sizes, batch: int) -> CellPasses:
    """Return the arrays for passes of that many states through networks of that shape, of two hidden layers or more."""
    first, *hidden = hidden_for(sizes, batch)
    turned, values = np.empty((batch, sizes[1]), np.float32), np.empty((sizes[-1], batch), np.float32)
    return CellPasses(first, turned, tuple(hidden), values)


@compiled(nogil=True)
def by_input(parameters: Float32s, sizes: Int64s) -> None:
    """Order the first layer's weights by input, in place; moments and gradients of parameters alike."""
    nodes, width = sizes[1], sizes[0] + 1
    first = parameters[: nodes * width]
    first[:] = first.copy().reshape(nodes, width).T.copy().ravel()


@compiled(nogil=True)
def by_node(parameters: Float32s, sizes: Int64s) -> None:
    """Order the first layer's weights by node again, as networks.py does, in place."""
    nodes, width = sizes[1], sizes[0] + 1
    first = parameters[: nodes * width]
    first[:] = first.copy().reshape(width, nodes).T.copy().ravel()


@compiled(fused=True, nogil=True)
def forward_cells(parameters: Float32s, sizes: Int64s, states: Int64s, numbers: Float32s, passes: CellPasses) -> None:
    """Write the values (actions, batch) of the states (batch,) and their hidden nodes into ``passes``.

    ``parameters`` are ordered by input. ``numbers`` (rest, inputs - cells + 1) are the inputs after the cell's, by the
    rest of a state's index, and a 1.
    """
    nodes, width = sizes[1], sizes[0] + 1
    weights = parameters[: nodes * width].reshape(width, nodes)
    rest, others = numbers.shape
    cells = width - others
    for column in range(len(states)):
        cell, row = states[column] // rest, states[column] % rest
        own = passes.turned[column]
        own[:] = weights[cell]
        for other in range(others):
            number = numbers[row, other]
            if number == 0:
                continue
            of_input = weights[cells + other]
            for node in range(nodes):
                own[node] += of_input[node] * number
        for node in range(nodes):
            passes.first[node, column] = own[node]
    tanh_in_place(passes.first[:nodes])
    forward(parameters[nodes * width :], sizes[1:], passes.first, passes.hidden, passes.values)


@compiled(fused=True, nogil=True)
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
    """Write each parameter's gradient, ordered by input, from the slope at the outputs (actions, batch).

    ``passes`` is that of ``forward_cells``; ``scratch``, of the same shape, is overwritten.
    """
    nodes, width = sizes[1], sizes[0] + 1
    upper = nodes * width
    backward(parameters[upper:], sizes[1:], passes.first, passes.hidden, slope, gradient[upper:], scratch.hidden)
    second = sizes[2]
    weights = parameters[upper : upper + second * (nodes + 1)].reshape(second, nodes + 1)
    multiply(weights.T[:nodes], scratch.hidden[0][:second], scratch.first[:nodes])
    rest, others = numbers.shape
    cells = width - others
    first = gradient[:upper].reshape(width, nodes)
    first[:] = np.float32(0)
    for node in range(nodes):
        for column in range(len(states)):
            own = scratch.first[node, column] * (np.float32(1) - passes.first[node, column] ** 2)
            scratch.turned[column, node] = own
    for column in range(len(states)):
        cell, row = states[column] // rest, states[column] % rest
        own_row, of_cell = scratch.turned[column], first[cell]
        for node in range(nodes):
            of_cell[node] += own_row[node]
        for other in range(others):
            number = numbers[row, other]
            if number == 0:
                continue
            of_input = first[cells + other]
            for node in range(nodes):
                of_input[node] += own_row[node] * number
