"""The game's window on its desktop: whether it is in front, how late keys reach it; and the desktop's clipboard."""

from collections import deque
from dataclasses import dataclass

import numpy as np

from sim.client.desktop.clock import Event, Frames, VirtualClock
from sim.client.settings import Size


@dataclass(frozen=True)
class Stray:
    """A press that went to another window: the key or button, and when, in seconds."""

    name: str
    at: float


class VirtualWindow:
    """Brings events to the game in order, each after its own latency, at the game's next frame; or to another window.

    Args:
        clock: the time of the events.
        frames: when the game takes events.
        rng: draws the latencies.
        size: width and height in framebuffer pixels.
        latency_s: the shortest and the longest latency.
    """

    def __init__(
        self,
        clock: VirtualClock,
        frames: Frames,
        rng: np.random.Generator,
        size: Size,
        latency_s: tuple[float, float],
    ) -> None:
        self._clock, self._frames, self._rng, self._latency_s = clock, frames, rng, latency_s
        self.size = size
        self.is_in_front = True
        self.pointer = (size[0] // 2, size[1] // 2)
        self.down: set[str] = set()
        """The keys and buttons that are down on this desktop, whatever window got them."""
        self.strays: list[Stray] = []
        self.to_drop = 0
        """Key events that will be lost on the way."""
        self._next_late_s = 0.0
        self._last_arrival = 0.0
        self._arriving: deque[tuple[float, Event]] = deque()
        self._is_stalled = False

    def press(self, name: str, event: Event) -> None:
        """A key or button goes down on the desktop; ``event`` passes it to the game."""
        self.down.add(name)
        if self.is_in_front:
            self._send_input(event)
        else:
            self.strays.append(Stray(name, self._clock.now()))

    def release(self, name: str, event: Event) -> None:
        """A key or button goes up on the desktop."""
        self.down.discard(name)
        if self.is_in_front:
            self._send_input(event)

    def deliver(self, event: Event) -> None:
        """Bring something else to the game, after the events that are on their way."""
        self._send(event, 0.0)

    def drop_next(self) -> None:
        """Lose one more key event on the way."""
        self.to_drop += 1

    def delay_next(self, late_s: float) -> None:
        """Deliver the next key event later than usual, by so many seconds."""
        self._next_late_s = late_s

    def stall(self) -> None:
        """The game takes no events for now; they wait."""
        self._is_stalled = True

    def resume(self) -> None:
        """The game takes the events that waited."""
        self._is_stalled = False
        self.poll()

    def poll(self) -> None:
        """Let the game take every event that has arrived by now, as it does at the beginning of a frame."""
        while not self._is_stalled and self._arriving and self._arriving[0][0] <= self._clock.now():
            self._arriving.popleft()[1]()

    def _send_input(self, event: Event) -> None:
        if self.to_drop:
            self.to_drop -= 1
            return
        late, self._next_late_s = self._next_late_s, 0.0
        self._send(event, late)

    def _send(self, event: Event, late: float) -> None:
        least, most = self._latency_s
        arrival = self._clock.now() + late + least + (most - least) * float(self._rng.random())
        self._last_arrival = max(self._last_arrival, arrival)
        self._arriving.append((self._last_arrival, event))
        self._clock.call_at(self._frames.at_or_after(self._last_arrival), self.poll)


class VirtualClipboard:
    """The desktop's clipboard: a text, empty at first."""

    def __init__(self) -> None:
        self._text = ""

    def read(self) -> str:
        return self._text

    def write(self, text: str) -> None:
        self._text = text
