"""The virtual clock: time passes only during waits, and events that fall due meanwhile happen at their times.

Frames are such events. The game acts only at its frames: it takes the input that has come, and runs the ticks due.
"""

import heapq
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass

Event = Callable[[], None]


class VirtualClock:
    """Seconds on its own scale, and events due at their times. Nothing really sleeps."""

    def __init__(self, start: float = 100.0) -> None:
        self._now = start
        self._events: list[tuple[float, int, Event]] = []
        self._order = itertools.count()

    def now(self) -> float:
        return self._now

    def sleep_until(self, at: float) -> None:
        while self._events and self._events[0][0] <= at:
            due, _, event = heapq.heappop(self._events)
            self._now = max(self._now, due)
            event()
        self._now = max(self._now, at)

    def sleep(self, seconds: float) -> None:
        """Let some seconds pass."""
        self.sleep_until(self._now + seconds)

    def call_at(self, at: float, event: Event) -> None:
        """Run ``event`` at the time ``at``, or as soon as time passes; at equal times, in the order of the calls."""
        heapq.heappush(self._events, (at, next(self._order), event))


_EXACT = 1e-6
"""How far a time may be from a frame's own and still count as it, in frames: floating point sums are inexact."""


@dataclass(frozen=True)
class Frames:
    """Frames at ``fps`` a second, one of them at ``phase_s``. With ``math.inf`` there is a frame at any time.

    A frame takes the input that has come, then runs the ticks that are due, at most ten, then is shown (FACTS: Keys).
    """

    fps: float
    phase_s: float = 0.0

    def at_or_after(self, time_s: float) -> float:
        """Return the time of the first frame that isn't before ``time_s``."""
        if math.isinf(self.fps):
            return time_s
        return self.phase_s + math.ceil((time_s - self.phase_s) * self.fps - _EXACT) / self.fps

    def at_or_before(self, time_s: float) -> float:
        """Return the time of the last frame that isn't after ``time_s``."""
        if math.isinf(self.fps):
            return time_s
        return self.phase_s + math.floor((time_s - self.phase_s) * self.fps + _EXACT) / self.fps
