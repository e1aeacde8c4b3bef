"""The faces of the world's blocks that can be seen at all, as squares in space.

Each face has a darker rim, as the grain of the window's scene has (world_shapes.py); its dots are too fine for a
picture that is made smaller, so the rest of a face has the grain's mean.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from mc_nested.live.model.reading import Block
from sim.client.drawing.world_shapes import DOTS, FACES, HOLE, RIM, block_colour, grain, light
from sim.client.game.widgets import Colour
from sim.client.game.world import AIR

NEAR_FLOOR = 12
"""Blocks around the eye within which the floor shows its blocks' rims: farther rims are finer than a dot."""


@dataclass(frozen=True)
class Faces:
    """Squares in space, n of them.

    ``blocks`` (n, 3) are the blocks that they belong to, ``sides`` (n,) the number of each in ``FACES``; ``corners``
    (n, 4, 3) are in blocks, ``colours`` (n, 3) red, green, blue, 0 to 255, lit.
    """

    blocks: NDArray[np.int64]
    sides: NDArray[np.int64]
    corners: NDArray[np.float64]
    colours: NDArray[np.float64]

    def chosen(self, which: NDArray[np.bool_]) -> "Faces":
        """Return the faces that the mask (n,) is true for."""
        return Faces(self.blocks[which], self.sides[which], self.corners[which], self.colours[which])


def faces_of(built: Mapping[Block, str], floor: int) -> Faces:
    """Return the faces of what is built that nothing stands beside; ``floor`` is the height of the bare floor's top."""
    found = [
        (block, number, name)
        for block, name in built.items()
        for number, ((_, _, axis), side) in enumerate(FACES)
        if (near := _beside(block, axis, side)) not in built and near[1] >= floor
    ]
    return _faces(
        np.array([block for block, _, _ in found], np.int64).reshape(-1, 3),
        np.array([number for _, number, _ in found], np.int64),
        np.array([HOLE if name == AIR else block_colour(name) for _, _, name in found], np.float64).reshape(-1, 3),
    )


def floor_faces(around: Block, built: Mapping[Block, str], floor: int, block: str) -> Faces:
    """Return the tops of the bare floor's blocks around a block, with nothing built in them or on them."""
    reach = range(-NEAR_FLOOR, NEAR_FLOOR + 1)
    bare = [
        (x, floor - 1, z)
        for x in (around[0] + step for step in reach)
        for z in (around[2] + step for step in reach)
        if (x, floor - 1, z) not in built and (x, floor, z) not in built
    ]
    tops = np.full(len(bare), FACES.index(((2, 0, 1), 1)))
    colours = np.tile(np.array(block_colour(block), np.float64), (len(bare), 1))
    return _faces(np.array(bare, np.int64).reshape(-1, 3), tops, colours)


def both(one: Faces, other: Faces) -> Faces:
    """Return the faces of two worlds together."""
    return Faces(
        np.concatenate([one.blocks, other.blocks]),
        np.concatenate([one.sides, other.sides]),
        np.concatenate([one.corners, other.corners]),
        np.concatenate([one.colours, other.colours]),
    )


def cube_faces(colour: Colour) -> Faces:
    """Return the six faces of the block between 0 and 1."""
    return _faces(np.zeros((6, 3), np.int64), np.arange(6), np.tile(np.array(colour, np.float64), (6, 1)))


def inside_rims(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the corners (n, 4, ...) of squares without their rims."""
    middle = corners.mean(1, keepdims=True)
    return np.asarray(middle + (corners - middle) * (1 - 2 / DOTS), np.float64)


@lru_cache(1)
def brightness() -> tuple[float, float]:
    """Return the grain's mean inside a face's rim, and on it."""
    dots = grain()[:DOTS, :DOTS]
    inside = float(dots[1:-1, 1:-1].mean())
    return inside, inside * RIM


def _faces(blocks: NDArray[np.int64], sides: NDArray[np.int64], colours: NDArray[np.float64]) -> Faces:
    lights = np.array([light(axis, side) for (_, _, axis), side in FACES])
    return Faces(blocks, sides, blocks[:, None] + _squares()[sides], colours * lights[sides, None])


@lru_cache(1)
def _squares() -> NDArray[np.float64]:
    """Return the corners (6, 4, 3) of the faces of the block between 0 and 1, counter-clockwise from outside."""
    squares = np.zeros((6, 4, 3))
    for number, ((one, other, axis), side) in enumerate(FACES):
        squares[number, :, one] = 0, 1, 1, 0
        squares[number, :, other] = 0, 0, 1, 1
        squares[number, :, axis] = side
    return squares


def _beside(block: Block, axis: int, side: int) -> Block:
    moved = list(block)
    moved[axis] += 1 if side else -1
    return moved[0], moved[1], moved[2]
