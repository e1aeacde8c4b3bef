"""What playing live took, for a training's summary: seconds per action, retries, corrections, recoveries."""

import statistics
from dataclasses import dataclass, field
from typing import Any

from mc_nested.live.motion.effort import Effort


@dataclass
class ActionLog:
    """Counts of one session. ``effort`` is the body's own; ``seconds`` has the time of each confirmed action."""

    effort: Effort
    seconds: list[float] = field(default_factory=list)
    failed_actions: int = 0
    failed_resets: int = 0
    recoveries: int = 0

    def summary(self) -> dict[str, Any]:
        """Everything as plain numbers; the seconds as percentiles, None before the first action."""
        return {
            "actions": len(self.seconds),
            "action_s": {f"p{share}": percentile(self.seconds, share) for share in (50, 95, 99)},
            "moves": self.effort.moves,
            "corrections": self.effort.corrections,
            "clicks": self.effort.clicks,
            "second_clicks": self.effort.second_clicks,
            "failed_actions": self.failed_actions,
            "failed_resets": self.failed_resets,
            "recoveries": self.recoveries,
        }


def percentile(values: list[float], share: int) -> float | None:
    """The percentile of values in seconds, to the millisecond; None if there are no values."""
    if len(values) < 2:
        return round(values[0], 3) if values else None
    return round(statistics.quantiles(values, n=100, method="inclusive")[share - 1], 3)
