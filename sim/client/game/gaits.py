"""Which gait the player has in a tick: walking, sneaking, or sprinting after forward was pressed twice."""

from sim.client.game.edition import Edition
from sim.client.game.physics import Gait

SPRINT_WINDOW = 7
"""Ticks: the second of two presses of forward that come sooner than this after each other sprints (FACTS: Walking)."""


class Gaits:
    """Follows the keys from tick to tick.

    Args:
        edition: the game's version, which decides when sneaking begins to slow the player down.
    """

    def __init__(self, edition: Edition) -> None:
        self._sneaks_at_once = not edition.since(1, 15)
        self._sneaked = False
        self._was_forward = False
        self._is_sprinting = False
        self._window = 0

    def tick(self, *, is_forward: bool, sneaks: bool, may_sprint: bool) -> Gait:
        """The gait of this tick.

        Args:
            is_forward: whether forward is down, and back isn't.
            sneaks: whether the sneak key is down.
            may_sprint: whether the player is on the ground and didn't stop at a wall in the last tick.
        """
        self._window = 0 if self._sneaked else max(0, self._window - 1)
        is_slow = sneaks if self._sneaks_at_once else self._sneaked
        is_fast = is_forward and not is_slow
        if is_fast and not self._was_forward and not self._is_sprinting and may_sprint:
            if self._window:
                self._is_sprinting = True
            else:
                self._window = SPRINT_WINDOW
        if not is_fast or not may_sprint:
            self._is_sprinting = False
        self._was_forward, self._sneaked = is_fast, sneaks
        if is_slow:
            return "sneak"
        return "sprint" if self._is_sprinting else "walk"
