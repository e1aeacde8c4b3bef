"""The virtual world: an endless floor, the blocks that differ from it, and the ray of sight to the first one."""

import itertools
import math
from collections.abc import Mapping
from typing import NamedTuple

from mc_nested.live.model.reading import Block
from sim.client.game.physics import IsSolid, Vector

AIR = "air"


class VirtualWorld:
    """Blocks by name, without namespace. Below ``floor`` everything is the floor's block; above is air.

    Args:
        floor: the height of the floor's top, on which the feet stand.
        floor_block: what the floor is made of.
    """

    def __init__(self, floor: int, floor_block: str) -> None:
        self.floor = floor
        self.floor_block = floor_block
        self._changed: dict[Block, str] = {}
        self._seen: tuple[int, Mapping[Block, str]] = (-1, {})
        self.revision = 0
        """Increases with every change."""

    def block_at(self, block: Block) -> str:
        """Return the name of the block at a position; ``AIR`` where there is none."""
        return self._changed.get(block) or self._natural(block)

    def is_solid(self, x: int, y: int, z: int) -> bool:
        """Return whether the block there stops players and views."""
        changed = self._changed.get((x, y, z)) if self._changed else None
        return y < self.floor if changed is None else changed != AIR

    def put(self, block: Block, name: str) -> bool:
        """Put a block there, or air; return whether that changed anything."""
        if self.block_at(block) == name:
            return False
        self.revision += 1
        if name == self._natural(block):
            del self._changed[block]
        else:
            self._changed[block] = name
        return True

    def fill(self, low: Block, high: Block, name: str, *, only_air: bool = False) -> int:
        """Put a block everywhere between two corners, included, or only where air is; return how many changed."""
        sides = [range(min(one, other), max(one, other) + 1) for one, other in zip(low, high, strict=True)]
        if name == AIR and sides[1][0] >= self.floor:
            # Clearing above the floor, as every reset does: only what stands there can change.
            there = [block for block in self._changed if all(block[axis] in sides[axis] for axis in range(3))]
            return sum(self.put(block, name) for block in there)
        blocks = ((x, y, z) for x, y, z in itertools.product(*sides))
        return sum(self.put(block, name) for block in blocks if not only_air or self.block_at(block) == AIR)

    def built(self) -> dict[Block, str]:
        """Return what differs from the bare floor: names by position, ``AIR`` where some of the floor is missing."""
        return dict(self._changed)

    def seen(self) -> Mapping[Block, str]:
        """Return what ``built`` returns, and the same mapping again until something changes: not to be written to."""
        if self._seen[0] != self.revision:
            self._seen = self.revision, self.built()
        return self._seen[1]

    def restore(self, built: Mapping[Block, str]) -> None:
        """Restore what ``built`` returned."""
        self._changed = dict(built)
        self.revision += 1

    def _natural(self, block: Block) -> str:
        return self.floor_block if block[1] < self.floor else AIR


def block_of(point: tuple[float, float, float]) -> Block:
    """Return the block that a point lies in."""
    return math.floor(point[0]), math.floor(point[1]), math.floor(point[2])


class Hit(NamedTuple):
    """The block hit, the cell before it on the ray, and the distance of its face from the eye, in blocks."""

    block: Block
    before: Block
    distance: float


def direction(yaw: float, pitch: float) -> Vector:
    """Return a view's unit vector; degrees: yaw 0 is south, pitch 90 down (FACTS: Standing, looking, placing)."""
    turn, tilt = math.radians(yaw), math.radians(pitch)
    return -math.sin(turn) * math.cos(tilt), -math.sin(tilt), math.cos(turn) * math.cos(tilt)


def cast_ray(eye: Vector, yaw: float, pitch: float, reach: float, is_solid: IsSolid) -> Hit | None:
    """Return the first solid block within ``reach`` blocks of the eye, or None. The eye's own cell never counts."""
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
