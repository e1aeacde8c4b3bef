"""A stride: a hold followed from reading to reading, so that where it ends is known long before the walker stands.

A walker's tick (FACTS: Walking): what is left of the last step is the carry, a held key adds its push, the place moves
by the sum, and 0.546 of that is the next carry. So from a known place and carry only few places can be seen later: so
many ticks before the key was felt, so many with it, so many coasting. A place that is one of them, by the decimals on
the screen, says where the walker ends; one that is none of them says nothing, and standstill has to be waited for.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice

from mc_nested.live.walk import INERTIA, STANDSTILL

Pair = tuple[float, float]
"""Right and forward, in cells."""

MATCH = 0.0016
"""Blocks that a place may lie off a path: two roundings to three decimals, and a little."""

AGREE = 0.02
"""Blocks that the ends of all that a place can mean may lie apart."""

MORE_TICKS = 3
"""Ticks that a hold may be felt longer, and ticks that may pass before it: lateness, not lag."""


@dataclass(frozen=True)
class Going:
    """Where a walker with every key up was seen, and the carry: what the next tick moves by."""

    place: Pair
    carry: Pair

    @property
    def end(self) -> Pair:
        """Where the walker comes to a stop."""
        return self.place[0] + rest(self.carry[0]), self.place[1] + rest(self.carry[1])


@dataclass(frozen=True)
class Hold:
    """A held key: the axis (0 right, 1 forward), its direction, the ticks, and the push of a tick, in blocks."""

    axis: int
    sign: int
    ticks: int
    push: float


@dataclass(frozen=True)
class _Moment:
    """One moment of a path: how far from its beginning, the carry, whether the key is up for good, and ticks held."""

    place: float
    carry: float
    is_up: bool
    held: int = 0


class Stride:
    """Knows where a walker can be seen, from ``begin`` on, with one hold or none.

    Args:
        begin: where the walker was, and how fast.
        hold: the key that is held then; None where none is.
    """

    def __init__(self, begin: Going, hold: Hold | None = None) -> None:
        self._begin = begin
        self._hold = hold
        self._paths = [
            _held(begin.carry[axis] * hold.sign, hold.ticks, hold.push)
            if hold and hold.axis == axis
            else _coasted(begin.carry[axis])
            for axis in (0, 1)
        ]
        self._signs = [hold.sign if hold and hold.axis == axis else 1 for axis in (0, 1)]

    def see(self, place: Pair) -> Going | None:
        """What the walker does who is seen there; None where that isn't certain, or can't be."""
        right, forward = (self._carry(axis, place[axis]) for axis in (0, 1))
        return None if right is None or forward is None else Going(place, (right, forward))

    def ticks_held(self, place: Pair) -> int | None:
        """How many ticks a walker seen there has felt the key, and still feels it; None where that isn't certain."""
        if self._hold is None:
            return None
        axis, sign = self._hold.axis, self._hold.sign
        covered = (place[axis] - self._begin.place[axis]) * sign
        moments = [moment for moment in self._paths[axis] if abs(moment.place - covered) <= MATCH]
        counts = {moment.held for moment in moments}
        return counts.pop() if len(counts) == 1 and not any(moment.is_up for moment in moments) else None

    def _carry(self, axis: int, place: float) -> float | None:
        sign = self._signs[axis]
        covered = (place - self._begin.place[axis]) * sign
        moments = [moment for moment in self._paths[axis] if abs(moment.place - covered) <= MATCH]
        if not moments or not all(moment.is_up for moment in moments):
            return None
        ends = [moment.place + rest(moment.carry) for moment in moments]
        if max(ends) - min(ends) > AGREE:
            return None
        return min(moments, key=lambda moment: abs(moment.place - covered)).carry * sign


def rest(carry: float) -> float:
    """Blocks that a walker with this carry still moves by, to a stop."""
    if abs(carry) < STANDSTILL:
        return 0.0
    # Steps shrink to the one below the standstill, which isn't taken.
    steps = math.floor(math.log(STANDSTILL / abs(carry)) / math.log(INERTIA)) + 1
    return carry * (1 - INERTIA**steps) / (1 - INERTIA)


def _coasted(carry: float) -> list[_Moment]:
    return [_Moment(place, left, True) for place, left in _coasting(0.0, carry)]


@lru_cache(64)
def _held(carry: float, ticks: int, push: float) -> list[_Moment]:
    """Every moment of a hold of about ``ticks`` ticks, with what came before and what comes after."""
    moments: list[_Moment] = []
    for start, slower in islice(_coasting(0.0, carry), MORE_TICKS + 1):
        place, left = start, slower
        moments.append(_Moment(place, left, False))
        for held in range(1, ticks + MORE_TICKS + 1):
            step = (left if abs(left) >= STANDSTILL else 0.0) + push
            place, left = place + step, step * INERTIA
            moments.append(_Moment(place, left, False, held))
            if held >= ticks - MORE_TICKS:
                later = _coasting(place, left)
                next(later)
                moments += [_Moment(there, rest_of, True, held) for there, rest_of in later]
    return moments


def _coasting(place: float, carry: float) -> Iterator[tuple[float, float]]:
    """This place and carry, and those of each tick until standstill."""
    yield place, carry
    while abs(carry) >= STANDSTILL:
        place, carry = place + carry, carry * INERTIA
        yield place, carry
