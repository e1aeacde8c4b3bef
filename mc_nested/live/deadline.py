"""A deadline on a device clock: it bounds every wait of the live path and of calibration."""

from mc_nested.live.devices import Clock


class Deadline:
    """The time ``seconds`` from now, on ``clock``."""

    def __init__(self, clock: Clock, seconds: float) -> None:
        self._clock = clock
        self.at = clock.now() + seconds

    @property
    def has_passed(self) -> bool:
        """Whether the clock has reached it."""
        return self._clock.now() >= self.at
