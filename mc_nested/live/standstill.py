"""Standstill, told from a picture that has stalled: on a busy machine both look the same for a while.

After the key is up, each tick's step is 0.546 of the one before (FACTS: Walking): 0.118, 0.064, 0.035 ... 0.003 blocks.
A last step that is small was taken with the key up, and nothing follows it. After a larger one, or none, the game may
only be late.
"""

TAIL = 0.03
"""Blocks: longer than the last four steps of coasting to a stop, shorter than the first step of setting off (0.098)."""

STALL_S = 1.0
"""Seconds of the same place that count as standstill where no tail was seen: long for a picture to stall."""


class Standstill:
    """Follows the places seen after a hold, and says when the walker stands.

    Args:
        place: where the walker was before the hold, in cells as (right, forward).
        now: when the key went up, in seconds.
        settle_s: seconds of the same place that are enough after a coasting tail.
    """

    def __init__(self, place: tuple[float, float], now: float, settle_s: float) -> None:
        self._place = place
        self._since = now
        self._settle_s = settle_s
        self._has_coasted = False

    def is_reached(self, place: tuple[float, float], now: float) -> bool:
        """Take in the place seen now, and say whether it is the last."""
        if place != self._place:
            step = max(abs(place[0] - self._place[0]), abs(place[1] - self._place[1]))
            self._place, self._since, self._has_coasted = place, now, step < TAIL
        return now - self._since >= (self._settle_s if self._has_coasted else STALL_S)
