"""The look of the world: shapes, colour and grain of its blocks, daylight, and the camera in the player's eye.

The window's scene (sim/window) and the client's own pictures share it. A shape is an array (corners, 6): positions in
blocks, then normals. Rows (n, 6) say where it is drawn: positions in blocks, then colours from 0 to 1. The camera's
matrices (4, 4) are for column vectors, in blocks from the eye's own block.
"""

import math
import zlib
from collections.abc import Mapping
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray

from mc_nested.arrays import Float32s
from mc_nested.live.model.reading import Block
from sim.client.game.widgets import Colour
from sim.client.game.world import AIR, direction

_KNOWN: dict[str, Colour] = {
    "bedrock": (85, 85, 85),
    "dirt": (134, 96, 67),
    "glowstone": (231, 190, 105),
    "grass_block": (104, 159, 56),
    "lapis_block": (31, 67, 140),
    "mossy_cobblestone": (110, 118, 95),
    "oak_planks": (176, 142, 86),
    "planks": (176, 142, 86),
    "obsidian": (32, 20, 48),
    "sand": (219, 207, 163),
    "smooth_stone": (160, 160, 160),
    "stone": (125, 125, 125),
}


def block_colour(block: str) -> Colour:
    """Return the mean colour of a block by its name without a namespace; one that isn't known gets one of its own."""
    if block in _KNOWN:
        return _KNOWN[block]
    shade = zlib.crc32(block.encode())
    return 60 + shade % 120, 60 + (shade >> 8) % 120, 60 + (shade >> 16) % 120


FAR = 96
"""Blocks from the player within which anything is drawn; the fog hides the rest."""

HOLE: Colour = (5, 5, 5)
_STANDS_OFF = 0.002
"""Blocks between a block and its outline."""

FACES = (((0, 1, 2), 1), ((0, 2, 1), 0), ((1, 2, 0), 1), ((2, 1, 0), 0), ((2, 0, 1), 1), ((1, 0, 2), 0))
"""The axes of each face, the last one its normal's, and the side it is on: counter-clockwise from outside."""


@lru_cache(1)
def unit_cube() -> Float32s:
    """Return the 36 corners of the triangles of a cube between 0 and 1."""
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
def floor_square() -> Float32s:
    """Return the six corners of a level square that reaches FAR in each direction."""
    corners = ((-1, -1), (1, 1), (1, -1), (-1, -1), (-1, 1), (1, 1))
    return np.array([(FAR * x, 0, FAR * z, 0, 1, 0) for x, z in corners], np.float32)


@lru_cache(1)
def outline() -> Float32s:
    """Return the 24 ends of the edges of a cube that is a little larger than a block."""
    low, high = -_STANDS_OFF, 1 + _STANDS_OFF
    ends = []
    for axis in range(3):
        for one, other in product((low, high), repeat=2):
            for along in (low, high):
                position = [one, other]
                position.insert(axis, along)
                ends.append([*position, 0.0, 0.0, 0.0])
    return np.array(ends, np.float32)


def row_of(position: tuple[float, float, float], colour: Colour) -> Float32s:
    """Return the one row that draws a shape at a position in a colour."""
    return np.array([(*position, *(part / 255 for part in colour))], np.float32)


def cubes(built: Mapping[Block, str], origin: Block) -> Float32s:
    """Return one row for each block within FAR that differs from the bare floor, in blocks from ``origin``.

    A missing block of the floor is black.
    """
    rows = []
    for block, name in built.items():
        x, y, z = (part - own for part, own in zip(block, origin, strict=True))
        if max(abs(x), abs(y), abs(z)) <= FAR:
            rows.append(row_of((x, y, z), HOLE if name == AIR else block_colour(name)))
    return np.concatenate(rows) if rows else np.empty((0, 6), np.float32)


GRAIN_BLOCKS = 4
"""Blocks in each direction after which the grain repeats."""

DOTS = 16
RIM = 0.84


def grain() -> Float32s:
    """Return a grain of brightness from 0 to 1, an array (64, 64): GRAIN_BLOCKS faces in each direction."""
    side = GRAIN_BLOCKS * DOTS
    dots = np.random.default_rng(0).uniform(0.84, 1.0, (side, side)).astype(np.float32)
    place = np.arange(side) % DOTS
    is_rim = (place == 0) | (place == DOTS - 1)
    dots[is_rim, :] *= RIM
    dots[:, is_rim] *= RIM
    return dots


SKY = (0.47, 0.65, 1.0)
"""Red, green and blue, from 0 to 1."""

TOP, BOTTOM, NORTH_AND_SOUTH, EAST_AND_WEST = 1.0, 0.5, 0.8, 0.62
"""The part of its colour that a face shows, by where it looks."""

FOG_FROM = 0.3
"""The part of the farthest distance at which the fog begins; at the end of it there is nothing else."""


def light(axis: int, side: int) -> float:
    """Return the light on a face across ``axis`` (0 east, 1 up, 2 south), on its high (1) or low side (0)."""
    if axis == 1:
        return TOP if side else BOTTOM
    return EAST_AND_WEST if axis == 0 else NORTH_AND_SOUTH


Matrix = NDArray[np.float32]

FIELD_OF_VIEW_DEG = 70.0
NEAR, _FAR = 0.05, 256.0
_HELD_AT, _HELD_SIZE = (0.72, -0.52, -1.0), 0.4
"""The middle of the block in the hand, in blocks to the right, up and back from the eye, and its size."""


def projection(width: int, height: int) -> Matrix:
    """Return the perspective of the game's own field of view, from top to bottom."""
    scale = 1 / math.tan(math.radians(FIELD_OF_VIEW_DEG) / 2)
    depth = NEAR - _FAR
    return np.array(
        [
            [scale * height / width, 0, 0, 0],
            [0, scale, 0, 0],
            [0, 0, (_FAR + NEAR) / depth, 2 * _FAR * NEAR / depth],
            [0, 0, -1, 0],
        ],
        np.float32,
    )


def view(eye: tuple[float, float, float], yaw: float, pitch: float) -> Matrix:
    """Return the matrix from blocks to the camera: x right, y up, z back. ``eye`` is in blocks, angles in degrees."""
    ahead = np.array(direction(yaw, pitch))
    turn = math.radians(yaw)
    right = np.array((-math.cos(turn), 0.0, -math.sin(turn)))
    axes = np.stack([right, np.cross(right, ahead), -ahead])
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, :3] = axes
    matrix[:3, 3] = -axes @ np.array(eye)
    return matrix


def held_block() -> Matrix:
    """Return the matrix from a block between 0 and 1 to the camera: smaller, turned, and in the lower right."""
    turn, tilt = math.radians(40.0), math.radians(12.0)
    turned = np.array(
        [[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]],
    )
    tilted = np.array([[1, 0, 0], [0, math.cos(tilt), -math.sin(tilt)], [0, math.sin(tilt), math.cos(tilt)]])
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, :3] = tilted @ turned * _HELD_SIZE
    matrix[:3, 3] = np.array(_HELD_AT) - matrix[:3, :3] @ np.array((0.5, 0.5, 0.5))
    return matrix
