"""The ray of sight: from the eye through the grid of blocks to the first one that stops it."""

import math
from typing import NamedTuple

from mc_nested.live.model.reading import Block
from sim.client.game.physics import IsSolid, Vector


class Hit(NamedTuple):
    """The block hit, the cell before it on the ray, and the distance of its face from the eye, in blocks."""

    block: Block
    before: Block
    distance: float


def direction(yaw: float, pitch: float) -> Vector:
    """The unit vector of a view in degrees (FACTS: Standing, looking, placing): yaw 0 is south, pitch 90 down."""
    turn, tilt = math.radians(yaw), math.radians(pitch)
    return -math.sin(turn) * math.cos(tilt), -math.sin(tilt), math.cos(turn) * math.cos(tilt)


def cast(eye: Vector, yaw: float, pitch: float, reach: float, is_solid: IsSolid) -> Hit | None:
    """The first solid block within ``reach`` blocks of the eye; None without one. The eye's own cell never counts."""
    way = direction(yaw, pitch)
    cell = [math.floor(part) for part in eye]
    steps = [1 if part > 0 else -1 for part in way]
    # Ray lengths to the next border of each axis, and from one border to the next.
    spacing = [1 / abs(part) if part else math.inf for part in way]
    nearest = [
        ((index + 1 - start) if step > 0 else (start - index)) * gap if gap < math.inf else math.inf
        for index, start, step, gap in zip(cell, eye, steps, spacing, strict=True)
    ]
    while True:
        axis = min(range(3), key=nearest.__getitem__)
        distance = nearest[axis]
        if distance > reach:
            return None
        before = (cell[0], cell[1], cell[2])
        cell[axis] += steps[axis]
        nearest[axis] += spacing[axis]
        if is_solid(cell[0], cell[1], cell[2]):
            return Hit((cell[0], cell[1], cell[2]), before, distance)
