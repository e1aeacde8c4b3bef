"""The networks of the agents with objectives, by NumPy alone: what acts, in a training and afterwards.

dqn/torch_engine/objective_networks.py says what they are, and computes the same where they are trained.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from mc_nested.arrays import Bools, Float32s, Int64s
from mc_nested.learn.dqn.nearness import SMALL, TINY, spread
from mc_nested.learn.dqn.states import AGENT, MANY, NONE, OCCUPIED, WANTED

EIGHT = np.float32(8.0)
"""Cells that count as 1 in a distance."""


class NetworkLayer(NamedTuple):
    """A layer's weights and its biases: (outputs, inputs) and (outputs,); of a convolution, (outputs, inputs, 3, 3)."""

    weights: Float32s
    biases: Float32s


def layers_of(flat: Float32s, shapes: Sequence[tuple[int, ...]]) -> list[NetworkLayer]:
    """Return the layers of a row of parameters (parameters,), as the torch engine lays them out.

    Of a dense layer, each node's bias follows its weights. Raise ValueError if their number differs.
    """
    layers, start = [], 0
    for shape in shapes:
        weights, biases = math.prod(shape), shape[0]
        own = flat[start : start + weights + biases]
        if len(own) < weights + biases:
            raise ValueError(f"{len(flat)} parameters are too few")
        if len(shape) > 2:
            layers.append(NetworkLayer(own[:weights].reshape(shape), own[weights:]))
        else:
            nodes = own.reshape(shape[0], shape[1] + 1)
            layers.append(NetworkLayer(nodes[:, :-1], nodes[:, -1]))
        start += weights + biases
    if start != len(flat):
        raise ValueError(f"{len(flat)} parameters, not {start}")
    return layers


class Reaching(NamedTuple):
    """What the nested agent knows of an objective while nothing changes but where it is.

    ``near`` (R, side, side) is how near each cell is; ``wide`` (R, 2, side + 4, side + 4) what is wanted and stands.
    """

    near: Float32s
    wide: Float32s

    def of(self, rows: Int64s) -> "Reaching":
        """Return what is known in the named arenas (k,)."""
        return Reaching(self.near[rows], self.wide[rows])


class ReachNetwork:
    """The nested agent's network, of parameters (parameters,): what the best action is.

    ValueError if the parameters aren't those of such a network.
    """

    SHAPES = ((12, 2, 3, 3), (2, 12, 1, 1), (64, 59), (32, 64), (8, 32))

    def __init__(self, parameters: Float32s) -> None:
        self._seen, self._maps, *self._dense = layers_of(parameters, self.SHAPES)

    def reaching(self, planes: Bools) -> Reaching:
        """Return what is known of the objectives of planes (R, OBJECTIVE_PLANES, side, side)."""
        seen = planes[:, :AGENT].astype(np.float32)
        maps = sigmoid(convolved(relu(convolved(seen, self._seen)), self._maps))
        beside = sliding_window_view(padded(seen[:, WANTED], 1), (3, 3), axis=(1, 2)).max((3, 4))
        near, _ = spread(maps[:, 1] * beside, maps[:, 0] * (1 - seen[:, OCCUPIED]))
        return Reaching(near, framed_wide(seen))

    def values(self, reaching: Reaching, agents: Int64s) -> Float32s:
        """Return the value of each action (R, actions), of agents at these cells (R, 2)."""
        every = np.arange(len(agents))
        near = windows(padded(reaching.near, 1)[:, None], every, agents, 1)
        highest = np.maximum(near.max(1, keepdims=True), TINY)
        window = windows(reaching.wide, every, agents, 2)
        hidden = np.concatenate((near / highest, window), axis=1)
        values: Float32s = highest * through(hidden, self._dense)
        return values


class OrderNetwork:
    """The main agent's network, of parameters (parameters,): what each cell is worth as the next one.

    ValueError if the parameters aren't those of such a network.
    """

    SHAPES = (
        (2, 2, 1, 1),
        (12, 10, 3, 3),
        (12, 12, 3, 3),
        (12, 12, 3, 3),
        (12, 48, 1, 1),
        (96, 201),
        (96, 96),
        (1, 96),
    )

    def __init__(self, parameters: Float32s) -> None:
        layers = layers_of(parameters, self.SHAPES)
        self._passing, self._seen, self._farther, self._farthest, self._axes, *self._dense = layers

    def values(self, planes: Bools) -> Float32s:
        """Return each cell's value (R, side, side) in planes (R, planes, side, side); NONE if it isn't wanted."""
        seen = planes.astype(np.float32)
        agents = np.repeat(seen[:, AGENT : AGENT + 1], 2, axis=1)
        passing = sigmoid(convolved(seen[:, :AGENT], self._passing))
        near = spread(*(each.reshape(-1, *each.shape[2:]) for each in (agents, passing)))[0].reshape(agents.shape)
        near = np.roll(near, 1, axis=3)  # a block is placed from the cell before it
        maps = np.concatenate((near, -np.log(near + SMALL) / 4), axis=1)
        across, along = _away(planes)
        hidden = relu(convolved(np.concatenate((seen, maps, across, along), axis=1), self._seen))
        hidden += relu(convolved(hidden, self._farther, 2))
        hidden += relu(convolved(hidden, self._farthest, 4))
        hidden += relu(convolved(_along_axes(hidden), self._axes))
        rows, x, y = np.nonzero(planes[:, WANTED])
        cells = np.stack((x, y), axis=1)
        away = np.stack((across[rows, 0, x, y], along[rows, 0, x, y]), axis=1)
        of_cells = np.concatenate(
            (
                windows(framed_wide(seen), rows, cells, 2),
                windows(padded(maps, 1), rows, cells, 1),
                _cross(hidden, rows, cells),
                away,
                np.abs(away),
                np.count_nonzero(planes[:, WANTED], (1, 2))[rows, None].astype(np.float32) / MANY,
            ),
            axis=1,
        )
        values = np.full((len(planes), *planes.shape[2:]), NONE, np.float32)
        values[rows, x, y] = through(of_cells, self._dense)[:, 0]
        return values


def relu(values: Float32s) -> Float32s:
    """Return what is above 0 of each value."""
    above: Float32s = np.maximum(values, np.float32(0))
    return above


def sigmoid(values: Float32s) -> Float32s:
    """Return the logistic function of each value."""
    one = np.float32(1)
    found: Float32s = (one / (one + np.exp(-values))).astype(np.float32, copy=False)
    return found


def through(values: Float32s, layers: Sequence[NetworkLayer]) -> Float32s:
    """Return values (n, inputs) after dense layers, with ReLU between them."""
    for layer in layers[:-1]:
        values = relu(values @ layer.weights.T + layer.biases)
    found: Float32s = values @ layers[-1].weights.T + layers[-1].biases
    return found


def padded(planes: Float32s, cells: int, value: float = 0.0) -> Float32s:
    """Return planes (…, side, side) with so many cells of that value around them."""
    edges = ((0, 0),) * (planes.ndim - 2) + ((cells, cells),) * 2
    return np.pad(planes, edges, constant_values=np.float32(value))


def framed_wide(planes: Float32s) -> Float32s:
    """Return planes (R, …, side, side) with two cells more on every side, which are occupied."""
    wide = padded(planes, 2)
    wide[:, OCCUPIED] = padded(planes[:, OCCUPIED], 2, 1.0)
    return wide


def convolved(planes: Float32s, layer: NetworkLayer, apart: int = 1) -> Float32s:
    """Return the convolution of planes (R, inputs, side, side), (R, outputs, side, side).

    Its kernel's cells are so far ``apart``.
    """
    runs, inputs, side, _ = planes.shape
    outputs, _, width, _ = layer.weights.shape
    taps = padded(planes, apart * (width // 2))
    found = np.empty((runs, outputs, side * side), np.float32)
    found[:] = layer.biases[:, None]
    for x in range(width):
        for y in range(width):
            tap = taps[:, :, x * apart : x * apart + side, y * apart : y * apart + side].reshape(runs, inputs, -1)
            found += layer.weights[:, :, x, y] @ tap
    return found.reshape(runs, outputs, side, side)


def windows(wide: Float32s, rows: Int64s, cells: Int64s, reach: int) -> Float32s:
    """Return what planes hold up to ``reach`` cells around some cells, (n, planes * width * width as x, y, planes).

    Args:
        wide: the planes with ``reach`` cells more on every side, (R, planes, …).
        rows: the cells' arenas, (n,).
        cells: (n, 2).
        reach: how far a window reaches.
    """
    width = 2 * reach + 1
    view: Float32s = sliding_window_view(wide, (width, width), axis=(2, 3))
    seen: Float32s = (
        view[rows, :, cells[:, 0], cells[:, 1]].transpose(0, 2, 3, 1).reshape(len(rows), wide.shape[1] * width**2)
    )
    return seen


def _away(planes: Bools) -> tuple[Float32s, Float32s]:
    """Return how far each cell is from the agent, (R, 1, side, side), across and along, in eights of cells."""
    runs, side = len(planes), planes.shape[-1]
    x, y = np.divmod(planes[:, AGENT].reshape(runs, -1).argmax(1), side)
    cells, whole = np.arange(side), (runs, 1, side, side)
    across: Float32s = ((cells - x[:, None]).astype(np.float32) / EIGHT)[:, None, :, None]
    along: Float32s = ((cells - y[:, None] - 1).astype(np.float32) / EIGHT)[:, None, None, :]
    return np.broadcast_to(across, whole), np.broadcast_to(along, whole)


def _along_axes(seen: Float32s) -> Float32s:
    """Return the most of each channel in the cell's row, in all rows beyond, in its column and in the arena."""
    row = seen.max(2, keepdims=True)
    beyond = np.zeros_like(row)
    beyond[..., :-1] = np.maximum.accumulate(row[..., ::-1], axis=3)[..., ::-1][..., 1:]
    every = row, beyond, seen.max(3, keepdims=True), seen.max((2, 3), keepdims=True)
    return np.concatenate([np.broadcast_to(each, seen.shape) for each in every], axis=1)


def _cross(seen: Float32s, rows: Int64s, cells: Int64s) -> Float32s:
    """Return the channels (R, channels, side, side) of some cells (n, 2) and their neighbours, (n, 5 * channels)."""
    wide = padded(seen, 1)
    steps = ((1, 1), (0, 1), (2, 1), (1, 0), (1, 2))
    found = [wide[rows, :, cells[:, 0] + across, cells[:, 1] + along] for across, along in steps]
    return np.concatenate(found, axis=1)
