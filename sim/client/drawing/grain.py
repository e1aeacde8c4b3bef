"""The grain of the blocks' faces: 16 x 16 dots a face, as in the game's pictures, and a darker rim around each face."""

import numpy as np

from sim.client.drawing.cubes import Floats

GRAIN_BLOCKS = 4
"""Blocks in each direction after which the grain repeats."""

DOTS = 16
RIM = 0.84


def grain() -> Floats:
    """Brightness from 0 to 1, an array (64, 64): GRAIN_BLOCKS faces in each direction."""
    side = GRAIN_BLOCKS * DOTS
    dots = np.random.default_rng(0).uniform(0.84, 1.0, (side, side)).astype(np.float32)
    place = np.arange(side) % DOTS
    is_rim = (place == 0) | (place == DOTS - 1)
    dots[is_rim, :] *= RIM
    dots[:, is_rim] *= RIM
    return dots
