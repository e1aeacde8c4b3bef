"""Count what playing live took, for a training's summary, and limit the failed episodes that a training accepts.

Failed episodes are thrown away and counted, up to a limit.
"""

import statistics
from dataclasses import dataclass, field
from typing import Any

from mc_nested.errors import LiveError, StoppedError


@dataclass
class Effort:
    """Counts so far: moves and their corrections, those that overlapped with the next; clicks and repeated clicks."""

    moves: int = 0
    corrections: int = 0
    overlapped: int = 0
    clicks: int = 0
    second_clicks: int = 0


@dataclass
class Spent:
    """Where the time of actions went, in seconds.

    Walking: a key was down. Confirming: none was, but an action was not confirmed yet. Deciding: between two actions of
    an episode.
    """

    walking: float = 0.0
    confirming: float = 0.0
    deciding: float = 0.0

    def __str__(self) -> str:
        """Return the shares in words; empty before the first action."""
        whole = self.walking + self.confirming + self.deciding
        return ", ".join(f"{name} {100 * part / whole:.0f} %" for name, part in vars(self).items()) if whole else ""


@dataclass
class ActionLog:
    """Counts of one session. ``effort`` is the body's own; ``seconds`` has the time of each confirmed action."""

    effort: Effort
    seconds: list[float] = field(default_factory=list)
    spent: Spent = field(default_factory=Spent)
    failed_actions: int = 0
    failed_resets: int = 0
    recoveries: int = 0
    _began: float = 0.0
    _ended: float | None = None
    _held_s: float = 0.0

    def begins(self, at: float, held_s: float) -> None:
        """Take note that an action begins; ``held_s`` is for how long keys have been down until then."""
        if self._ended is not None:
            self.spent.deciding += at - self._ended
        self._began, self._held_s = at, held_s

    def ends(self, at: float, held_s: float) -> None:
        """Take note that an action was confirmed."""
        self.seconds.append(at - self._began)
        self.spent.walking += held_s - self._held_s
        self.spent.confirming += at - self._began - (held_s - self._held_s)
        self._ended = at

    def pauses(self) -> None:
        """Take note that what comes before the next action is none of the three."""
        self._ended = None

    def summary(self) -> dict[str, Any]:
        """Return all counts as plain numbers; the seconds as percentiles, None before the first action."""
        return {
            "actions": len(self.seconds),
            "action_s": {f"p{share}": percentile(self.seconds, share) for share in (50, 95, 99)},
            "share": str(self.spent),
            "overlapped": self.effort.overlapped,
            "moves": self.effort.moves,
            "corrections": self.effort.corrections,
            "clicks": self.effort.clicks,
            "second_clicks": self.effort.second_clicks,
            "failed_actions": self.failed_actions,
            "failed_resets": self.failed_resets,
            "recoveries": self.recoveries,
        }


def percentile(values: list[float], share: int) -> float | None:
    """Return the percentile of values in seconds, to the millisecond; None if there are no values."""
    if len(values) < 2:
        return round(values[0], 3) if values else None
    return round(statistics.quantiles(values, n=100, method="inclusive")[share - 1], 3)


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
        """Return how many episodes failed, and what the last errors said."""
        return {"spoiled_episodes": len(self._reasons), "last_problems": self._reasons[-3:]}
