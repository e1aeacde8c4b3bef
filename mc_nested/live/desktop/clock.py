"""The real clock: seconds on a monotonic scale, and waits that end on time."""

import sys
import time

_SLEEPS_IN_STEPS = sys.platform == "win32" and sys.version_info < (3, 11)

SPIN_S = 0.016 if _SLEEPS_IN_STEPS else {"linux": 0.0005}.get(sys.platform, 0.002)
"""The end of a wait, in seconds, spent in a loop: as long as a sleep may overshoot (FACTS: Input and windows)."""


class MonotonicClock:
    """Seconds on a scale that never goes back."""

    def now(self) -> float:
        return time.perf_counter()

    def sleep_until(self, at: float) -> None:
        left = at - time.perf_counter()
        if left > SPIN_S:
            time.sleep(left - SPIN_S)
        while time.perf_counter() < at:
            pass
