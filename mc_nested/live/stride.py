"""A stride: a hold followed from reading to reading, so that where it ends is known long before the walker stands.

A walker's tick (FACTS: Walking): what is left of the last step is the carry, a held key adds its push, the place moves
by the sum, and the inertia, 0.546 on stone, is what it leaves as the next carry. So from a known place and carry only
few places can be seen later: so many ticks before the key was felt, so many with it, so many coasting. A place that is
one of them, by the decimals on the screen, says where the walker ends; one that is none of them, or more than one, says
nothing, and standstill has to be waited for.
"""

import math
from bisect import bisect_left, bisect_right
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

from mc_nested.live.walk import INERTIA, STANDSTILL

Pair = tuple[float, float]
"""Right and forward, in cells."""

MATCH = 0.0016
"""Blocks that a place may lie off a path: two roundings to three decimals, and a little."""

AGREE = 0.02
"""Blocks that the ends of all that a place can mean may lie apart."""

MORE_TICKS = 3
"""Ticks that a hold may be felt shorter, and ticks that may pass before it: lateness, not lag."""

LAG_TICKS = 12
"""Ticks that a hold may be felt longer: a game that stalls takes a release for late (FACTS: Keys; ten at once)."""


@dataclass(frozen=True)
class Going:
    """Where a walker with every key up was seen, and the carry: what the next tick moves by.

    ``inertia`` is what a tick leaves of a step.
    """

    place: Pair
    carry: Pair
    inertia: float = INERTIA

    @property
    def end(self) -> Pair:
        """Where the walker comes to a stop."""
        right, forward = (rest(carry, self.inertia) for carry in self.carry)
        return self.place[0] + right, self.place[1] + forward


@dataclass(frozen=True)
class Hold:
    """A held key: the axis (0 right, 1 forward), its direction, the ticks, and the push of a tick, in blocks."""

    axis: int
    sign: int
    ticks: int
    push: float


class _Moment(NamedTuple):
    """One moment of a path: how far from its beginning, where it ends, the carry, whether the key is up for good."""

    place: float
    end: float
    carry: float
    is_up: bool
    held: int


class _Path:
    """All moments along one axis, to be found by their place."""

    def __init__(self, moments: list[_Moment]) -> None:
        self._moments = sorted(moments)
        self._places = [moment.place for moment in self._moments]

    def at(self, place: float) -> list[_Moment]:
        """The moments that a place may be."""
        return self._moments[bisect_left(self._places, place - MATCH) : bisect_right(self._places, place + MATCH)]

    def longest(self, held: int) -> float:
        """The farthest end of those who felt the key for so many ticks or fewer."""
        return max(moment.end for moment in self._moments if moment.is_up and moment.held <= held)


class Stride:
    """Knows where a walker can be seen, from ``begin`` on, with one hold or none.

    Args:
        begin: where the walker was, and how fast.
        hold: the key that is held then; None where none is.
        inertia: what a tick leaves of a step.
    """

    def __init__(self, begin: Going, hold: Hold | None = None, inertia: float = INERTIA) -> None:
        self._begin = begin
        self._hold = hold
        self._inertia = inertia
        self._paths = [
            _held(begin.carry[axis] * hold.sign, hold.ticks, hold.push, inertia)
            if hold and hold.axis == axis
            else _coasted(begin.carry[axis], inertia)
            for axis in (0, 1)
        ]
        self._signs = [hold.sign if hold and hold.axis == axis else 1 for axis in (0, 1)]

    def see(self, place: Pair) -> Going | None:
        """What the walker does who is seen there; None where that isn't certain, or can't be."""
        right, forward = (self._carry(axis, place[axis]) for axis in (0, 1))
        return None if right is None or forward is None else Going(place, (right, forward), self._inertia)

    def ticks_held(self, place: Pair) -> int | None:
        """How many ticks a walker seen there has felt the key, and still feels it; None where that isn't certain."""
        if self._hold is None:
            return None
        axis, sign = self._hold.axis, self._hold.sign
        moments = self._paths[axis].at((place[axis] - self._begin.place[axis]) * sign)
        counts = {moment.held for moment in moments}
        return counts.pop() if len(counts) == 1 and not any(moment.is_up for moment in moments) else None

    @property
    def farthest(self) -> Pair:
        """Where the walker comes to a stop who feels the key one tick longer than meant."""
        right, forward = (
            self._begin.place[axis] + sign * self._paths[axis].longest(self._hold.ticks + 1 if self._hold else 0)
            for axis, sign in enumerate(self._signs)
        )
        return right, forward

    def _carry(self, axis: int, place: float) -> float | None:
        sign = self._signs[axis]
        covered = (place - self._begin.place[axis]) * sign
        moments = self._paths[axis].at(covered)
        if not moments or not all(moment.is_up for moment in moments):
            return None
        ends = [moment.end for moment in moments]
        if max(ends) - min(ends) > AGREE:
            return None
        return min(moments, key=lambda moment: abs(moment.place - covered)).carry * sign


def rest(carry: float, inertia: float = INERTIA) -> float:
    """Blocks that a walker with this carry still moves by, to a stop."""
    if abs(carry) < STANDSTILL:
        return 0.0
    # Steps shrink to the one below the standstill, which isn't taken.
    steps = math.floor(math.log(STANDSTILL / abs(carry)) / math.log(inertia)) + 1
    return carry * (1 - inertia**steps) / (1 - inertia)


@lru_cache(256)
def _coasted(carry: float, inertia: float) -> _Path:
    return _Path(_coasting(0.0, carry, inertia))


@lru_cache(64)
def _held(carry: float, ticks: int, push: float, inertia: float) -> _Path:
    """Every moment of a hold of about ``ticks`` ticks, with what came before and what comes after."""
    moments: list[_Moment] = []
    for waits, before in enumerate(_coasting(0.0, carry, inertia)[: MORE_TICKS + 1]):
        place, left = before.place, before.carry
        moments.append(_Moment(place, place, left, False, 0))
        for held in range(1, ticks + (MORE_TICKS if waits else LAG_TICKS) + 1):
            step = (left if abs(left) >= STANDSTILL else 0.0) + push
            place, left = place + step, step * inertia
            moments.append(_Moment(place, place, left, False, held))
            if held >= ticks - MORE_TICKS:
                moments += _coasting(place, left, inertia, held)[1:]
    return _Path(moments)


def _coasting(place: float, carry: float, inertia: float, held: int = 0) -> list[_Moment]:
    """The moments from this place and carry on, to standstill, the key being up."""
    end = place + rest(carry, inertia)
    moments = [_Moment(place, end, carry, True, held)]
    while abs(carry) >= STANDSTILL:
        place, carry = place + carry, carry * inertia
        moments.append(_Moment(place, end, carry, True, held))
    return moments
