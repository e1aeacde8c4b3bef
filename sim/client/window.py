"""The game's window on its desktop: what is in front, where keys go, and how long they take to get there."""

from dataclasses import dataclass

import numpy as np

from sim.client.clock import Event, VirtualClock
from sim.client.settings import Size


@dataclass(frozen=True)
class Stray:
    """A press that went to another window: the key or button, and when, in seconds."""

    name: str
    at: float


class Window:
    """Carries events to the game, in their order, each after a latency of its own; or to another window.

    Args:
        clock: the time that everything happens in.
        rng: draws the latencies.
        size: width and height in framebuffer pixels.
        latency_s: the shortest and the longest latency.
    """

    def __init__(
        self, clock: VirtualClock, rng: np.random.Generator, size: Size, latency_s: tuple[float, float]
    ) -> None:
        self._clock, self._rng, self._latency_s = clock, rng, latency_s
        self.size = size
        self.is_in_front = True
        self.pointer = (size[0] // 2, size[1] // 2)
        self.down: set[str] = set()
        """The keys and buttons that are down on this desktop, whichever window they went to."""
        self.strays: list[Stray] = []
        self.to_drop = 0
        """Key events that will be lost on the way."""
        self.next_late_s = 0.0
        """How much later than usual the next key event arrives."""
        self._last_arrival = 0.0
        self._stalled: list[Event] | None = None

    def press(self, name: str, event: Event) -> None:
        """A key or button goes down on the desktop; ``event`` is what the game makes of it."""
        self.down.add(name)
        if self.is_in_front:
            self._carry(event)
        else:
            self.strays.append(Stray(name, self._clock.now()))

    def release(self, name: str, event: Event) -> None:
        """A key or button goes up on the desktop."""
        self.down.discard(name)
        if self.is_in_front:
            self._carry(event)

    def tell(self, event: Event) -> None:
        """Something else reaches the game, behind the events that are on their way."""
        self._send(event, 0.0)

    def stall(self) -> None:
        """The game stops to take events; they wait."""
        self._stalled = []

    def resume(self) -> None:
        """The game takes what has waited."""
        waiting, self._stalled = self._stalled or [], None
        for event in waiting:
            event()

    def _carry(self, event: Event) -> None:
        if self.to_drop:
            self.to_drop -= 1
            return
        late, self.next_late_s = self.next_late_s, 0.0
        self._send(event, late)

    def _send(self, event: Event, late: float) -> None:
        least, most = self._latency_s
        arrival = self._clock.now() + late + least + (most - least) * float(self._rng.random())
        self._last_arrival = max(self._last_arrival, arrival)
        self._clock.call_at(self._last_arrival, lambda: self._arrive(event))

    def _arrive(self, event: Event) -> None:
        if self._stalled is None:
            event()
        else:
            self._stalled.append(event)
