"""How many failed live episodes a training accepts: they are thrown away and counted, up to a limit."""

from typing import Any

from mc_nested.errors import LiveError, StoppedError

MOST_IN_A_ROW = 5
"""Episodes that may fail one after the other, without PROGRESS between them."""

PROGRESS = 20
"""Confirmed steps after which the game counts as working again: about as many as make an episode."""


class FailureBudget:
    """Counts the episodes that were thrown away, and raises when a person stops the game or too many fail in a row."""

    def __init__(self) -> None:
        self._reasons: list[str] = []
        self._in_a_row = 0
        self._steps_at_last = 0

    def record_failure(self, error: LiveError, steps: int) -> None:
        """Count one more failed episode, at that number of confirmed steps.

        Raises:
            LiveError: ``error`` itself, where a person stopped the game, or too many episodes failed in a row.
        """
        has_progressed = steps >= self._steps_at_last + PROGRESS
        self._in_a_row = 1 if has_progressed else self._in_a_row + 1
        self._steps_at_last = steps
        self._reasons.append(str(error))
        if isinstance(error, StoppedError) or self._in_a_row > MOST_IN_A_ROW:
            raise error

    def summary(self) -> dict[str, Any]:
        """How many episodes failed, and what the last errors said."""
        return {"spoiled_episodes": len(self._reasons), "last_problems": self._reasons[-3:]}
