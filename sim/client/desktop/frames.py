"""When the game draws a frame. All it does, it does then: it takes the input that came, and runs the ticks due."""

import math
from dataclasses import dataclass

_EXACT = 1e-6
"""The part of a frame by which a time may miss a frame's own, as sums of floating point numbers do."""


@dataclass(frozen=True)
class Frames:
    """Frames at ``fps`` a second, one of them at ``phase_s``. With ``math.inf`` there is a frame at any time.

    A frame takes the input that has come, then runs the ticks that are due, at most ten, then is shown (FACTS: Keys).
    """

    fps: float
    phase_s: float = 0.0

    def at_or_after(self, time_s: float) -> float:
        """The time of the first frame that isn't before ``time_s``."""
        if math.isinf(self.fps):
            return time_s
        return self.phase_s + math.ceil((time_s - self.phase_s) * self.fps - _EXACT) / self.fps

    def at_or_before(self, time_s: float) -> float:
        """The time of the last frame that isn't after ``time_s``."""
        if math.isinf(self.fps):
            return time_s
        return self.phase_s + math.floor((time_s - self.phase_s) * self.fps + _EXACT) / self.fps
