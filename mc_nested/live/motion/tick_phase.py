"""TickPhase: when the game's ticks come, estimated from when their steps are first seen.

A step is seen some time after its tick: the game draws a frame, the desktop shows it, and only then does a look see it.
So one observation says little. But ticks come every 50 ms, and the mean of many observations modulo 50 ms lies a fixed
time behind them.
"""

import cmath
import math

from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.timing import CAPTURE_LATENCY_S

DECAY = 0.9
"""The weight that earlier observations keep with each new one: about the last ten count."""

MIN_AGREEMENT = 0.35
"""How much observations must agree, of 1: those of a game without ticks reach 0.23, those of one with ticks 0.5."""

ENOUGH = 6.0
"""Weight of observations that the estimate needs; older ones weigh less."""


class TickPhase:
    """When ticks come, in seconds of the clock that the observations are given in.

    Args:
        capture_latency_s: from a tick until its step is on the screen, on average.
    """

    def __init__(self, capture_latency_s: float = CAPTURE_LATENCY_S) -> None:
        self._capture_latency_s = capture_latency_s
        self._sum = 0j
        self._weight = 0.0

    @property
    def state(self) -> tuple[float, float, float]:
        """What the estimate rests on, to go on from: the sum of directions, and their weight."""
        return self._sum.real, self._sum.imag, self._weight

    def go_on_from(self, state: tuple[float, float, float]) -> None:
        """Take the estimate that had this state."""
        real, imaginary, self._weight = state
        self._sum = complex(real, imaginary)

    def saw_step(self, since: float, at: float) -> None:
        """Take in that a step was first seen by the look ``at``, and not yet by the one before, at ``since``."""
        tick = (since + at) / 2 - self._capture_latency_s
        self._sum = DECAY * self._sum + cmath.exp(2j * math.pi * tick / TICK_S)
        self._weight = DECAY * self._weight + 1.0

    @property
    def is_known(self) -> bool:
        """Whether there are enough observations and they agree."""
        return self._weight >= ENOUGH and abs(self._sum) >= MIN_AGREEMENT * self._weight

    def next(self, after: float, offset: float = 0.0) -> float:
        """The first time from ``after`` on that is ``offset`` seconds behind a tick."""
        first = cmath.phase(self._sum) / (2 * math.pi) * TICK_S + offset
        return after + (first - after) % TICK_S
