"""Episodes that a mishap spoiled: they are thrown away, counted, and not borne for ever."""

from typing import Any

from mc_nested.errors import LiveError, StoppedError

MOST_IN_A_ROW = 5
"""Episodes that may be spoiled one after the other, without as many steps between them as make an episode."""

PROGRESS = 20
"""Confirmed steps after which the game counts as well again."""


class Spoiled:
    """Counts the episodes that were thrown away, and ends it where that leads nowhere."""

    def __init__(self) -> None:
        self._reasons: list[str] = []
        self._in_a_row = 0
        self._steps = 0

    def count(self, error: LiveError, steps: int) -> None:
        """One more, at so many confirmed steps.

        Raises:
            LiveError: ``error`` itself, where a person stopped the game, or too many came in a row.
        """
        self._in_a_row = 1 if steps >= self._steps + PROGRESS else self._in_a_row + 1
        self._steps = steps
        self._reasons.append(str(error))
        if isinstance(error, StoppedError) or self._in_a_row > MOST_IN_A_ROW:
            raise error

    def summary(self) -> dict[str, Any]:
        """How many, and what the last ones said."""
        return {"spoiled_episodes": len(self._reasons), "last_problems": self._reasons[-3:]}
