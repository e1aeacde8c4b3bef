"""Real time as the client's time, a frame at a time, and the player's eye between two ticks."""

from sim.client.client import MOST_TICKS, TICK_S
from sim.client.desktop.clock import VirtualClock
from sim.client.game.game import VirtualGame
from sim.client.game.view import Eye


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


_JUMP = 4.0
"""A move by more blocks than this in a tick is a teleport, which is seen at once."""


class SmoothEye:
    """Follows a game's player; between two ticks it moves evenly from the last eye to the present one."""

    def __init__(self, game: VirtualGame) -> None:
        self._game = game
        self._ticks, self._since = game.ticks, 0.0
        self._before = self._now = game.realm.eye()

    def at(self, now: float) -> Eye:
        """Return the eye at a time of the client's clock, in seconds; times never go back."""
        game = self._game
        if game.ticks != self._ticks:
            self._ticks, self._since = game.ticks, now
            self._before, self._now = self._now, game.realm.eye()
            if max(abs(one - other) for one, other in zip(self._before, self._now, strict=True)) > _JUMP:
                self._before = self._now
        part = min(1.0, (now - self._since) / TICK_S)
        x, y, z = (one + (other - one) * part for one, other in zip(self._before, self._now, strict=True))
        return Eye((x, y, z), game.realm.player.yaw, game.realm.player.pitch)
