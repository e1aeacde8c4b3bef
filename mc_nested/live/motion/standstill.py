"""Tells a walker that stands still from a picture that has stalled: on a busy machine both look the same for a while.

After the key is up, each tick's step is 0.546 of the one before (FACTS: Walking): 0.118, 0.064, 0.035 ... 0.003 blocks.
A small last step was taken with the key up, and nothing follows it. After a larger one, or none, the game may only be
late.
"""

TAIL = 0.03
"""Blocks: longer than the last four steps of coasting to a stop, shorter than the first step of setting off (0.098)."""

STALL_S = 1.0
"""Seconds at one position that count as standstill if no coasting tail was seen: a long time for a picture to stall."""


CAREFUL_SETTLE_S = 0.25
"""Seconds at one position after a coasting tail, for a game whose lag isn't known yet: five ticks."""


class Standstill:
    """Follows the positions seen after a hold, and says when the walker stands still.

    Args:
        position: where the walker was before the hold, in cells as (right, forward).
        now: when the key went up, in seconds.
        settle_s: seconds at one position that are enough after a coasting tail.
        stall_s: seconds at one position that are enough without one.
    """

    def __init__(self, position: tuple[float, float], now: float, settle_s: float, stall_s: float = STALL_S) -> None:
        self._position = position
        self._since = now
        self._settle_s = settle_s
        self._stall_s = stall_s
        self._has_coasted = False

    def is_reached(self, position: tuple[float, float], now: float) -> bool:
        """Take in the position seen now, and say whether it is the last."""
        if position != self._position:
            step = max(abs(position[0] - self._position[0]), abs(position[1] - self._position[1]))
            self._position, self._since, self._has_coasted = position, now, step < TAIL
        return now - self._since >= (self._settle_s if self._has_coasted else self._stall_s)
