"""Move a player by a tick: walking, sneaking, sprinting, falling, and stopping at obstacles (FACTS: Walking).

In a tick, for each axis: a small speed becomes 0 -> the push is added -> the player moves, as far as blocks allow ->
the speed is multiplied by the inertia.

Here a player stops at another one. In the game players push each other apart. The live path never walks into one, since
the rules void that (arena/cooperative/team.py). A reset may put one into another, which is not as in the game.
"""

import math
from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Literal

from sim.client.game.edition import Edition

Gait = Literal["walk", "sneak", "sprint"]
Vector = tuple[float, float, float]
IsSolid = Callable[[int, int, int], bool]
"""Whether the block at x, y, z stops a player."""

INPUT = 0.98
SNEAKING, SPRINTING = 0.3, 1.3
AIR_INERTIA = 0.91
AIR_ACCELERATION = 0.02


@dataclass(frozen=True)
class Ground:
    """The floor's slipperiness, and the factor of an effect on every push, such as 1.2."""

    slipperiness: float = 0.6
    speed: float = 1.0

    def under(self, gait: Gait) -> "Ground":
        """Return the ground as a player of that gait feels it: sprinting pushes more."""
        return Ground(self.slipperiness, self.speed * SPRINTING) if gait == "sprint" else self

    @property
    def inertia(self) -> float:
        """The part of the speed that is left after a tick."""
        return self.slipperiness * 0.91

    @property
    def acceleration(self) -> float:
        """Blocks a tick that an input of 1 adds to the speed."""
        return self.speed * 0.1 * 0.1627714 / self.inertia**3


STONE = Ground()
STANDSTILL = 0.003
GRAVITY, DRAG, JUMP = 0.08, 0.98, 0.42
AT_REST: Vector = (0.0, -GRAVITY * DRAG, 0.0)
"""The velocity of a player on the ground: gravity pulls, and the ground stops it each tick."""

HALF_WIDTH = 0.3
"""Half of the player's width (FACTS: Standing, looking, placing)."""

_TOUCH = 1e-7
"""Two boxes that overlap by no more than so many blocks count as touching."""

_STEP_DOWN, _BACK_OFF = 0.6, 0.05
"""Blocks that a sneaking player steps down at most. A step that leads deeper is shortened by so many blocks at a time
(FACTS: Sneaking)."""


def wish(forward: int, left: int, gait: Gait, yaw: float) -> tuple[float, float]:
    """Return the input of held keys, east and south, of length 1 at most. Each key is 1, 0 or -1, yaw in degrees."""
    strength = INPUT * (SNEAKING if gait == "sneak" else 1.0)
    ahead, aside = forward * strength, left * strength
    length = math.hypot(ahead, aside)
    if length > 1:
        ahead, aside = ahead / length, aside / length
    sine, cosine = math.sin(math.radians(yaw)), math.cos(math.radians(yaw))
    return aside * cosine - ahead * sine, ahead * cosine + aside * sine


def step(
    feet: Vector,
    velocity: Vector,
    push: tuple[float, float],
    height: float,
    is_solid: IsSolid,
    *,
    on_ground: bool,
    ground: Ground = STONE,
    sneaks: bool = False,
) -> tuple[Vector, Vector, bool]:
    """Return the feet, the velocity (blocks, blocks a tick) after one tick, and whether the player stands on something.

    ``push`` is what ``wish`` returns; ``height`` is the player's. A player that sneaks on the ground stops at edges.
    """
    acceleration = ground.acceleration if on_ground else AIR_ACCELERATION
    vx, vy, vz = (speed if abs(speed) >= STANDSTILL else 0.0 for speed in velocity)
    vx, vz = vx + push[0] * acceleration, vz + push[1] * acceleration
    if sneaks and on_ground:
        vx, vz = _kept_from_edge(feet, (vx, vz), height, is_solid)
    wanted = (vx, vy, vz)
    # Up and down first, then the longer motion, as the game does.
    order = (1, 2, 0) if abs(vx) < abs(vz) else (1, 0, 2)
    moved = list(feet)
    for axis in order:
        if wanted[axis]:
            moved[axis] = _stopped(moved, axis, wanted[axis], height, is_solid)
    done = [moved[axis] - feet[axis] for axis in range(3)]
    stopped = [abs(done[axis] - wanted[axis]) > _TOUCH for axis in range(3)]
    stands = stopped[1] and vy < 0
    inertia = ground.inertia if on_ground else AIR_INERTIA
    speeds = [0.0 if stopped[axis] else wanted[axis] for axis in range(3)]
    falling = (speeds[1] - GRAVITY) * DRAG
    return (moved[0], moved[1], moved[2]), (speeds[0] * inertia, falling, speeds[2] * inertia), stands


def _kept_from_edge(feet: Vector, motion: tuple[float, float], height: float, is_solid: IsSolid) -> tuple[float, float]:
    """Return the longest part of a step east and south with ground below: each shortened alone, then both."""
    x, y, z = feet
    east, south = motion

    def has_no_ground(dx: float, dz: float) -> bool:
        return is_free((x + dx, y - _STEP_DOWN, z + dz), height, is_solid)

    while east and has_no_ground(east, 0.0):
        east = _shortened(east)
    while south and has_no_ground(0.0, south):
        south = _shortened(south)
    while east and south and has_no_ground(east, south):
        east, south = _shortened(east), _shortened(south)
    return east, south


def _shortened(motion: float) -> float:
    return 0.0 if abs(motion) <= _BACK_OFF else motion - math.copysign(_BACK_OFF, motion)


def overlaps(feet: Vector, height: float, block: tuple[int, int, int]) -> bool:
    """Return whether a block overlaps a player whose feet are there."""
    return all(
        low + _TOUCH < block[axis] + 1 and high - _TOUCH > block[axis]
        for axis, (low, high) in enumerate(_sides(feet, height))
    )


def is_free(feet: Vector, height: float, is_solid: IsSolid) -> bool:
    """Return whether a player fits there."""
    xs, ys, zs = (_cells(low, high) for low, high in _sides(feet, height))
    return not any(is_solid(x, y, z) for y in ys for x in xs for z in zs)


def _sides(feet: Vector | list[float], height: float) -> tuple[tuple[float, float], ...]:
    x, y, z = feet
    return (x - HALF_WIDTH, x + HALF_WIDTH), (y, y + height), (z - HALF_WIDTH, z + HALF_WIDTH)


def _cells(low: float, high: float) -> range:
    return range(math.floor(low + _TOUCH), math.floor(high - _TOUCH) + 1)


def _stopped(feet: list[float], axis: int, motion: float, height: float, is_solid: IsSolid) -> float:
    """Return the feet's coordinate after moving along one axis by ``motion``, or up to the first block in the way."""
    sides = _sides(feet, height)
    front = sides[axis][motion > 0]
    others = [_cells(*sides[other]) for other in range(3) if other != axis]
    first, last = math.floor(front - _TOUCH if motion > 0 else front + _TOUCH), math.floor(front + motion)
    for layer in range(first, last + (1 if motion > 0 else -1), 1 if motion > 0 else -1):
        for one in others[0]:
            for other in others[1]:
                block = [one, other]
                block.insert(axis, layer)
                if layer != first and is_solid(block[0], block[1], block[2]):
                    return feet[axis] + (layer if motion > 0 else layer + 1) - front
    return feet[axis] + motion


SPRINT_WINDOW = 7
"""If forward is pressed twice within fewer ticks than this, the second press sprints (FACTS: Walking)."""


class Gaits:
    """Follows the keys from tick to tick.

    Args:
        edition: the game's version, which decides when sneaking begins to slow the player down.
    """

    def __init__(self, edition: Edition) -> None:
        self._sneaks_at_once = not edition.since(1, 15)
        self._sneaked = False
        self._was_forward = False
        self._is_sprinting = False
        self._window = 0

    def tick(self, *, is_forward: bool, sneaks: bool, may_sprint: bool) -> Gait:
        """Return the gait of this tick.

        Args:
            is_forward: whether forward is down, and back isn't.
            sneaks: whether the sneak key is down.
            may_sprint: whether the player is on the ground and didn't stop at a wall in the last tick.
        """
        self._window = 0 if self._sneaked else max(0, self._window - 1)
        is_slow = sneaks if self._sneaks_at_once else self._sneaked
        is_fast = is_forward and not is_slow
        if is_fast and not self._was_forward and not self._is_sprinting and may_sprint:
            if self._window:
                self._is_sprinting = True
            else:
                self._window = SPRINT_WINDOW
        if not is_fast or not may_sprint:
            self._is_sprinting = False
        self._was_forward, self._sneaked = is_fast, sneaks
        if is_slow:
            return "sneak"
        return "sprint" if self._is_sprinting else "walk"


WIDTH = 2 * HALF_WIDTH


def touches(one: Vector, other: Vector, height: float) -> bool:
    """Return whether two players of that height, whose feet are there, are in each other's way."""
    return abs(one[0] - other[0]) < WIDTH and abs(one[2] - other[2]) < WIDTH and abs(one[1] - other[1]) < height


def kept_apart(before: Vector, after: Vector, others: Collection[Vector], height: float) -> Vector:
    """Return where a step from ``before`` ends when other players stand in its way.

    ``after`` is where it would end if only blocks were in its way. Each axis is taken alone: a move along one that
    leads into another player is not made at all. A player who already overlaps somebody, as after a teleport, may
    move on.
    """
    around = [other for other in others if not touches(before, other, height)]

    def is_free(feet: Vector) -> bool:
        return not any(touches(feet, other, height) for other in around)

    if is_free(after):
        return after
    x = after[0] if is_free((after[0], after[1], before[2])) else before[0]
    z = after[2] if is_free((x, after[1], after[2])) else before[2]
    return x, after[1], z
