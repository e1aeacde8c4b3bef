"""WalkTracker: follows a hold from reading to reading, so that its end is known long before the walker stands still.

From a known position and velocity, a walker (model/kinematics.py) can reach only few positions: after so many ticks
before the key was felt, so many with it, so many coasting. If a position matches exactly one of them, to the decimals
on the screen, the walker's end is known. If it matches none, or several that end apart, nothing is known, and the
walker is watched until it stands still.
"""

from dataclasses import dataclass
from typing import NamedTuple

from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import INERTIA, coasted, held, ticked

MATCH = 0.0016
"""Blocks that a position may lie off a path: two roundings to three decimals, and a little."""

SLIPPERY, SLIPPERY_MATCH = 0.6, 0.004
"""The inertia from which on it may lie farther off, and how far, in blocks: there the last points of coasting lie 0.003
apart, so the walker may have been a tick further at the path's begin than was seen."""

AGREE = 0.02
"""Blocks that the ends of all the path points matching a position may lie apart."""

MORE_TICKS = 3
"""Ticks that a hold may be felt shorter, and ticks that may pass before it: lateness, not lag."""

LAG_TICKS = 12
"""Ticks that a hold may be felt longer: in a game that stalls the release comes late (FACTS: Keys; ten at once)."""

AT_REST = GroundVector(0.0, 0.0)


@dataclass(frozen=True)
class CoastingState:
    """A walker with every key up: where it was seen, in cells, and its velocity, the step of the next tick.

    ``inertia`` is the share of a step that is left after a tick.
    """

    position: GroundVector
    velocity: GroundVector
    inertia: float = INERTIA

    @property
    def end(self) -> GroundVector:
        """The position at which the walker stops."""
        (x, y), (x_speed, y_speed), inertia = self.position, self.velocity, self.inertia
        return GroundVector(coasted(x, x_speed, inertia)[-1][0], coasted(y, y_speed, inertia)[-1][0])

    def ticked(self, push: GroundVector) -> "CoastingState":
        """Return the state a tick later; ``push`` is what the keys that are down add to its step."""
        (x, y), (x_speed, y_speed), inertia = self.position, self.velocity, self.inertia
        (x, x_speed), (y, y_speed) = ticked(x, x_speed, push.right, inertia), ticked(y, y_speed, push.forward, inertia)
        return CoastingState(GroundVector(x, y), GroundVector(x_speed, y_speed), inertia)


@dataclass(frozen=True)
class Hold:
    """A held key: the axis (0 right, 1 forward), its direction, the ticks, and the push of a tick, in blocks."""

    axis: int
    sign: int
    ticks: int
    push: float


class _PathPoint(NamedTuple):
    """A place where a walker can be seen along one axis, its velocity there, and how many ticks have felt the key.

    ``end`` is where it stops; None until the key is up for good.
    """

    position: float
    velocity: float
    ticks_held: int
    end: float | None


class WalkTracker:
    """Knows where a walker can be seen after ``begin``, with one hold or none.

    Args:
        begin: the walker's position and velocity.
        hold: the key that is held then; None for no key.
        inertia: the share of a step that is left after a tick.
    """

    def __init__(self, begin: CoastingState, hold: Hold | None = None, inertia: float = INERTIA) -> None:
        self._hold = hold
        self._inertia = inertia
        self._paths = [
            _hold_path(*state, hold, inertia) if hold and hold.axis == axis else _coasting_path(*state, 0, inertia)
            for axis, state in enumerate(zip(begin.position, begin.velocity, strict=True))
        ]

    def coasting_at(self, position: GroundVector) -> CoastingState | None:
        """Return the state of a walker that is seen there.

        Return None if it isn't certain that its keys are up and where it ends.
        """
        right, forward = (self._velocity(axis, position[axis]) for axis in (0, 1))
        if right is None or forward is None:
            return None
        return CoastingState(position, GroundVector(right, forward), self._inertia)

    def ticks_held(self, position: GroundVector) -> int | None:
        """Return how many ticks have felt the key, for a walker seen there with the key still down.

        Return None if not certain.
        """
        axis = self._hold.axis if self._hold else 0
        counts = {point.ticks_held if point.end is None else None for point in self._matching(axis, position[axis])}
        return counts.pop() if len(counts) == 1 else None

    @property
    def end_if_late(self) -> GroundVector:
        """The position at which the walker stops if it feels the key one tick longer than planned."""
        sign, most = (self._hold.sign, self._hold.ticks + 1) if self._hold else (1, 0)
        right, forward = (
            sign * max(sign * each.end for each in path if each.end is not None and each.ticks_held <= most)
            for path in self._paths
        )
        return GroundVector(right, forward)

    def _matching(self, axis: int, position: float) -> list[_PathPoint]:
        slack = SLIPPERY_MATCH if self._inertia > SLIPPERY else MATCH
        return [point for point in self._paths[axis] if abs(point.position - position) <= slack]

    def _velocity(self, axis: int, position: float) -> float | None:
        points = self._matching(axis, position)
        is_held = self._hold is not None and self._hold.axis == axis
        if not points and not is_held and abs(position - self._paths[axis][-1].position) <= AGREE:
            # The last steps of coasting along this axis were a little longer or shorter than known: it ends there.
            return 0.0
        ends = [point.end for point in points if point.end is not None]
        if not points or len(ends) < len(points) or max(ends) - min(ends) > AGREE:
            return None
        return min(points, key=lambda point: abs(point.position - position)).velocity


def _coasting_path(position: float, velocity: float, ticks_held: int, inertia: float) -> list[_PathPoint]:
    states = coasted(position, velocity, inertia)
    return [_PathPoint(*state, ticks_held, states[-1][0]) for state in states]


def _hold_path(position: float, velocity: float, hold: Hold, inertia: float) -> list[_PathPoint]:
    """Return every point of a hold of about its ticks, of the coasting before it and of the coasting after it."""
    points: list[_PathPoint] = []
    for waits, begin in enumerate(coasted(position, velocity, inertia)[: MORE_TICKS + 1]):
        states = held(hold.ticks + (MORE_TICKS if waits else LAG_TICKS), hold.sign * hold.push, inertia, *begin)
        points += [_PathPoint(*state, ticks, None) for ticks, state in enumerate(states)]
        for ticks in range(max(1, hold.ticks - MORE_TICKS), len(states)):
            points += _coasting_path(*states[ticks], ticks, inertia)[1:]
    return points
