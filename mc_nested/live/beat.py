"""The beat: when the game's ticks come, told from when their steps are first seen.

A step is seen some time after its tick: the game draws a frame, the desktop shows it, a look comes by. So one sighting
says little, but ticks come every 50 ms, and the mean of many sightings within that lies a fixed time behind them.
"""

import cmath
import math

from mc_nested.live.walk import TICK_S

SEEN_AFTER_S = 0.028
"""From a tick until its step is on the screen, on average: half a frame, and 10 to 30 ms for the picture."""

FELT_AFTER_S = 0.0125
"""From a press until the game has it, on average: 5 to 20 ms."""

KEPT = 0.9
"""What a sighting leaves of those before it: about the last ten count."""

STEADY = 0.35
"""How much sightings must agree, of 1: those of a game without a beat reach 0.23, those with one 0.5."""

ENOUGH = 6.0
"""Sightings, older ones counted less, before anything is believed."""


class Beat:
    """When ticks come, in seconds of the clock that the sightings are given in.

    Args:
        seen_after_s: from a tick until its step is on the screen, on average.
    """

    def __init__(self, seen_after_s: float = SEEN_AFTER_S) -> None:
        self._seen_after_s = seen_after_s
        self._sum = 0j
        self._weight = 0.0

    def saw_step(self, since: float, at: float) -> None:
        """A step was seen at a look, and not yet at the one before."""
        tick = (since + at) / 2 - self._seen_after_s
        self._sum = KEPT * self._sum + cmath.exp(2j * math.pi * tick / TICK_S)
        self._weight = KEPT * self._weight + 1.0

    @property
    def is_known(self) -> bool:
        """Whether the sightings agree."""
        return self._weight >= ENOUGH and abs(self._sum) >= STEADY * self._weight

    def next(self, after: float, offset: float = 0.0) -> float:
        """The first time from ``after`` on that is ``offset`` seconds behind a tick."""
        first = cmath.phase(self._sum) / (2 * math.pi) * TICK_S + offset
        return after + (first - after) % TICK_S
