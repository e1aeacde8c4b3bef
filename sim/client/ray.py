"""The looking ray: from the eye through the grid of blocks to the first one that stops it."""

import math
from dataclasses import dataclass

from mc_nested.live.reading import Block
from sim.client.physics import IsSolid, Vector


@dataclass(frozen=True)
class Hit:
    """The block hit, the cell that the ray came from, and how far from the eye its face is, in blocks."""

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
    at = [math.floor(part) for part in eye]
    steps = [1 if part > 0 else -1 for part in way]
    # Ray lengths to the next border of each axis, and from one border to the next.
    spacing = [1 / abs(part) if part else math.inf for part in way]
    nearest = [
        ((cell + 1 - start) if step > 0 else (start - cell)) * gap if gap < math.inf else math.inf
        for cell, start, step, gap in zip(at, eye, steps, spacing, strict=True)
    ]
    while True:
        axis = min(range(3), key=nearest.__getitem__)
        distance = nearest[axis]
        if distance > reach:
            return None
        before = (at[0], at[1], at[2])
        at[axis] += steps[axis]
        nearest[axis] += spacing[axis]
        if is_solid(at[0], at[1], at[2]):
            return Hit((at[0], at[1], at[2]), before, distance)
