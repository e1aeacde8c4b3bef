"""WalkTracker: follows a hold from reading to reading, so that its end is known long before the walker stands still.

From a known position and velocity, a walker (model/kinematics.py) can reach only few positions: after so many ticks
before the key was felt, so many with it, so many coasting. If a position matches exactly one of them, to the decimals
on the screen, the walker's end is known. If it matches none, or several that end apart, nothing is known, and the
walker is watched until it stands still.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import INERTIA, STANDSTILL, coasting_distance, step_of

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

_ROUNDING = 1e-6
"""Blocks that a sum of steps may lie off what is worked out at once."""


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
        right, forward = (coasting_distance(speed, self.inertia) for speed in self.velocity)
        return GroundVector(self.position.right + right, self.position.forward + forward)


@dataclass(frozen=True)
class Hold:
    """A held key: the axis (0 right, 1 forward), its direction, the ticks, and the push of a tick, in blocks."""

    axis: int
    sign: int
    ticks: int
    push: float


class _PathPoint(NamedTuple):
    """A point of a path: how far from its beginning, where the walker would end, its velocity, and the key.

    ``is_released`` is whether the key is up for good; ``ticks_held`` how many ticks have felt it.
    """

    covered: float
    end: float
    velocity: float
    is_released: bool
    ticks_held: int


class _Coasting(NamedTuple):
    """The start of coasting: how far from the path's beginning, the velocity there, the ticks that felt the key.

    ``nearest`` and ``farthest`` are bounds of all its points, ``inertia`` the share of a step that is left.
    """

    covered: float
    velocity: float
    ticks_held: int
    nearest: float
    farthest: float
    inertia: float

    @property
    def end(self) -> float:
        """The position at which the walker stops."""
        return self.covered + coasting_distance(self.velocity, self.inertia)

    def points(self) -> list[_PathPoint]:
        """Return the points behind the one where the key came up, until the walker stands still."""
        covered, velocity, end = self.covered, self.velocity, self.end
        points: list[_PathPoint] = []
        while abs(velocity) >= STANDSTILL:
            covered, velocity = covered + velocity, velocity * self.inertia
            points.append(_PathPoint(covered, end, velocity, True, self.ticks_held))
        return points


def _coasting_from(covered: float, velocity: float, ticks_held: int, inertia: float) -> _Coasting:
    # It would come so far if it never stood still; a margin is left for rounding.
    limit = covered + velocity / (1 - inertia)
    nearest, farthest = (covered, limit) if velocity > 0 else (limit, covered)
    return _Coasting(covered, velocity, ticks_held, nearest - _ROUNDING, farthest + _ROUNDING, inertia)


class _Path:
    """All points along one axis: those before the key is up for good, and those of each coasting after it.

    Most coastings are never near where a walker is seen, so their points are worked out when they are asked for.
    """

    def __init__(self, points: list[_PathPoint], coastings: list[_Coasting]) -> None:
        self._points, self._coastings = points, coastings

    def matching(self, covered: float, slack: float) -> list[_PathPoint]:
        """Return the points that this distance can mean."""
        low, high = covered - slack, covered + slack
        found = [point for point in self._points if low <= point.covered <= high]
        for coasting in self._coastings:
            if coasting.nearest <= high and coasting.farthest >= low:
                found += [point for point in coasting.points() if low <= point.covered <= high]
        return sorted(found)

    def farthest_end(self, ticks_held: int) -> float:
        """Return the farthest end of the points where the key is up and at most so many ticks have felt it."""
        ends = [point.end for point in self._points if point.is_released and point.ticks_held <= ticks_held]
        return max(ends + [coasting.end for coasting in self._coastings if coasting.ticks_held <= ticks_held])


class WalkTracker:
    """Knows where a walker can be seen after ``begin``, with one hold or none.

    Args:
        begin: the walker's position and velocity.
        hold: the key that is held then; None for no key.
        inertia: the share of a step that is left after a tick.
    """

    def __init__(self, begin: CoastingState, hold: Hold | None = None, inertia: float = INERTIA) -> None:
        self._begin = begin
        self._hold = hold
        self._inertia = inertia
        self._paths = [
            _hold_path(begin.velocity[axis] * hold.sign, hold.ticks, hold.push, inertia)
            if hold and hold.axis == axis
            else _coasting_path(begin.velocity[axis], inertia)
            for axis in (0, 1)
        ]
        self._signs = [hold.sign if hold and hold.axis == axis else 1 for axis in (0, 1)]

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
        if self._hold is None:
            return None
        axis, sign = self._hold.axis, self._hold.sign
        points = self._matching(axis, (position[axis] - self._begin.position[axis]) * sign)
        counts = {point.ticks_held for point in points}
        return counts.pop() if len(counts) == 1 and not any(point.is_released for point in points) else None

    @property
    def end_if_late(self) -> GroundVector:
        """The position at which the walker stops if it feels the key one tick longer than planned."""
        right, forward = (
            self._begin.position[axis]
            + sign * self._paths[axis].farthest_end(self._hold.ticks + 1 if self._hold else 0)
            for axis, sign in enumerate(self._signs)
        )
        return GroundVector(right, forward)

    def _matching(self, axis: int, covered: float) -> list[_PathPoint]:
        return self._paths[axis].matching(covered, SLIPPERY_MATCH if self._inertia > SLIPPERY else MATCH)

    def _velocity(self, axis: int, position: float) -> float | None:
        sign = self._signs[axis]
        covered = (position - self._begin.position[axis]) * sign
        points = self._matching(axis, covered)
        is_held = self._hold is not None and self._hold.axis == axis
        if not points and not is_held and abs(covered - self._paths[axis].farthest_end(0)) <= AGREE:
            # The last steps of coasting along this axis were a little longer or shorter than known: it ends there.
            return 0.0
        if not points or not all(point.is_released for point in points):
            return None
        ends = [point.end for point in points]
        if max(ends) - min(ends) > AGREE:
            return None
        return min(points, key=lambda point: abs(point.covered - covered)).velocity * sign


@lru_cache(256)
def _coasting_path(velocity: float, inertia: float) -> _Path:
    coasting = _coasting_from(0.0, velocity, 0, inertia)
    return _Path([_PathPoint(0.0, coasting.end, velocity, True, 0)], [coasting])


@lru_cache(64)
def _hold_path(velocity: float, ticks: int, push: float, inertia: float) -> _Path:
    """Return every point of a hold of about ``ticks`` ticks, of the coasting before it and of the coasting after it."""
    points: list[_PathPoint] = []
    coastings: list[_Coasting] = []
    before = _coasting_from(0.0, velocity, 0, inertia).points()[:MORE_TICKS]
    for waits, start in enumerate([(0.0, velocity), *((point.covered, point.velocity) for point in before)]):
        covered, speed = start
        points.append(_PathPoint(covered, covered, speed, False, 0))
        for held in range(1, ticks + (MORE_TICKS if waits else LAG_TICKS) + 1):
            step = step_of(speed, push)
            covered, speed = covered + step, step * inertia
            points.append(_PathPoint(covered, covered, speed, False, held))
            if held >= ticks - MORE_TICKS and abs(speed) >= STANDSTILL:
                coastings.append(_coasting_from(covered, speed, held, inertia))
    return _Path(points, coastings)
