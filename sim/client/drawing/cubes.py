"""The shapes of the world: its blocks as cubes, the floor, and the outline of the block looked at.

A shape is an array (corners, 6): positions in blocks, then normals. Rows (n, 6) say where it is drawn: positions in
blocks, then colours from 0 to 1.
"""

from collections.abc import Mapping
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from mc_nested.live.model.reading import Block
from sim.client.drawing.block_colours import block_colour
from sim.client.game.colours import Colour
from sim.client.game.world import AIR

Floats = NDArray[np.float32]

FAR = 96
"""Blocks from the player within which anything is drawn; the fog hides the rest."""

HOLE: Colour = (5, 5, 5)
_STANDS_OFF = 0.002
"""Blocks between a block and its outline."""

FACES = (((0, 1, 2), 1), ((0, 2, 1), 0), ((1, 2, 0), 1), ((2, 1, 0), 0), ((2, 0, 1), 1), ((1, 0, 2), 0))
"""The axes of each face, the last one its normal's, and the side it is on: counter-clockwise from outside."""


@lru_cache(1)
def unit_cube() -> Floats:
    """The 36 corners of the triangles of a cube between 0 and 1."""
    corners = []
    for (one, other, axis), side in FACES:
        normal = [0.0, 0.0, 0.0]
        normal[axis] = 1.0 if side else -1.0
        for u, v in ((0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1)):
            position = [0.0, 0.0, 0.0]
            position[one], position[other], position[axis] = u, v, side
            corners.append([*position, *normal])
    return np.array(corners, np.float32)


@lru_cache(1)
def floor_square() -> Floats:
    """The six corners of a level square that reaches FAR in each direction."""
    corners = ((-1, -1), (1, 1), (1, -1), (-1, -1), (-1, 1), (1, 1))
    return np.array([(FAR * x, 0, FAR * z, 0, 1, 0) for x, z in corners], np.float32)


@lru_cache(1)
def outline() -> Floats:
    """The 24 ends of the edges of a cube that is a little larger than a block."""
    low, high = -_STANDS_OFF, 1 + _STANDS_OFF
    ends = []
    for axis in range(3):
        for one, other in product((low, high), repeat=2):
            for along in (low, high):
                position = [one, other]
                position.insert(axis, along)
                ends.append([*position, 0.0, 0.0, 0.0])
    return np.array(ends, np.float32)


def row_of(position: tuple[float, float, float], colour: Colour) -> Floats:
    """The one row that draws a shape at a position in a colour."""
    return np.array([(*position, *(part / 255 for part in colour))], np.float32)


def cubes(built: Mapping[Block, str], origin: Block) -> Floats:
    """One row for each block that differs from the bare floor, in blocks from ``origin``; those beyond FAR left out.

    A missing block of the floor is black.
    """
    rows = []
    for block, name in built.items():
        x, y, z = (part - own for part, own in zip(block, origin, strict=True))
        if max(abs(x), abs(y), abs(z)) <= FAR:
            rows.append(row_of((x, y, z), HOLE if name == AIR else block_colour(name)))
    return np.concatenate(rows) if rows else np.empty((0, 6), np.float32)
