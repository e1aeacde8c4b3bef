"""Real time as the client's time, a frame at a time."""

from sim.client.client import MOST_TICKS, TICK_S
from sim.client.desktop.clock import VirtualClock


class FramePacer:
    """Says when the next frame is due, and lets the client's clock catch up with it.

    Args:
        clock: the client's.
        fps: frames a second.
        now: the real time, in seconds.
    """

    def __init__(self, clock: VirtualClock, fps: float, now: float) -> None:
        self._clock, self._frame_s = clock, 1 / fps
        self._behind_s = now - clock.now()
        self.next_frame = now

    def begin_frame(self, now: float) -> None:
        """Bring the client's clock to this frame. Of a stall, ten ticks are made up for (FACTS: Keys)."""
        passed = now - self._behind_s - self._clock.now()
        self._behind_s += max(0.0, passed - MOST_TICKS * TICK_S)
        self._clock.sleep_until(now - self._behind_s)
        # A late frame doesn't make the next ones early.
        self.next_frame = max(self.next_frame + self._frame_s, now)
