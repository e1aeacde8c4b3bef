"""The camera in the player's eye: matrices (4, 4), for column vectors, in blocks from the eye's own block."""

import math

import numpy as np
from numpy.typing import NDArray

from sim.client.game.ray import direction

Matrix = NDArray[np.float32]

FIELD_OF_VIEW_DEG = 70.0
NEAR, _FAR = 0.05, 256.0
_HELD_AT, _HELD_SIZE = (0.72, -0.52, -1.0), 0.4
"""The middle of the block in the hand, in blocks to the right, up and back from the eye, and its size."""


def projection(width: int, height: int) -> Matrix:
    """The perspective of the game's own field of view, from top to bottom."""
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
    """From blocks to the camera: x to the right, y up, z backward. ``eye`` is in the same blocks, angles in degrees."""
    ahead = np.array(direction(yaw, pitch))
    turn = math.radians(yaw)
    right = np.array((-math.cos(turn), 0.0, -math.sin(turn)))
    axes = np.stack([right, np.cross(right, ahead), -ahead])
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, :3] = axes
    matrix[:3, 3] = -axes @ np.array(eye)
    return matrix


def held_block() -> Matrix:
    """From a block between 0 and 1 to the camera: smaller, turned, and in the lower right."""
    turn, tilt = math.radians(40.0), math.radians(12.0)
    turned = np.array(
        [[math.cos(turn), 0, math.sin(turn)], [0, 1, 0], [-math.sin(turn), 0, math.cos(turn)]],
    )
    tilted = np.array([[1, 0, 0], [0, math.cos(tilt), -math.sin(tilt)], [0, math.sin(tilt), math.cos(tilt)]])
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, :3] = tilted @ turned * _HELD_SIZE
    matrix[:3, 3] = np.array(_HELD_AT) - matrix[:3, :3] @ np.array((0.5, 0.5, 0.5))
    return matrix
