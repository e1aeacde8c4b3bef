"""The virtual clock: time passes only during waits, and events that fall due meanwhile happen at their times."""

import heapq
import itertools
from collections.abc import Callable

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
