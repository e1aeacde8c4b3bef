"""When a press is felt and a step is seen: the round trip from a key to the screen, told from many holds.

press ... the game has it ... [up to a tick] ... the tick ... its step is seen
release ... the game has it ... [up to a tick] ... the first tick without it ... its step would be seen

Of each edge of a hold only this is known: the tick that it decides on comes between 0 and 50 ms after the game has it.
So the time from the edge to that tick's step lies between the round trip and 50 ms more, evenly where holds begin at
all phases of the tick, and the round trip is what most edges agree to. How much of it is the way in and how much the
way out can't be seen from outside, and needn't be: whoever times presses by steps that were seen needs their sum.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mc_nested.live.beat import FELT_AFTER_S, SEEN_AFTER_S
from mc_nested.live.walk import TICK_S

LATE_S = 0.045
"""Seconds that a step may be seen off the beat of its hold: frames are late by less, a tick that comes late by more."""

LONGEST_S = 0.4
"""Seconds: no round trip that is longer than this is looked for."""

FELT_SHARE = FELT_AFTER_S / (FELT_AFTER_S + SEEN_AFTER_S)
"""What the way in takes of a round trip, where nothing says otherwise."""


@dataclass(frozen=True)
class Steps:
    """A hold in time: when its key went down and up, and its steps as (tick, since, at).

    ``tick`` counts from 1, the first that felt the key; the step was first seen at the look ``at``, and not yet at the
    one at ``since``; ``ticks`` is how many felt it. All in seconds of one clock.
    """

    pressed: float
    released: float
    ticks: int
    seen: tuple[tuple[int, float, float], ...]

    @property
    def first_seen(self) -> float:
        """When the first tick's step is seen, as all of them together tell it."""
        return float(np.median([_middle(step) - (step[0] - 1) * TICK_S for step in self.seen]))

    @property
    def late(self) -> int:
        """How many of the steps were seen too far off the others' beat."""
        first = self.first_seen
        return sum(abs(_middle(step) - (step[0] - 1) * TICK_S - first) > LATE_S for step in self.seen)


def round_trip(holds: Sequence[Steps]) -> float:
    """Seconds from a press, by way of a tick that comes at once, until its step is seen; the mean of many."""
    first = [hold.first_seen for hold in holds]
    edges = np.array(
        [
            *(at - hold.pressed for hold, at in zip(holds, first, strict=True)),
            *(at + hold.ticks * TICK_S - hold.released for hold, at in zip(holds, first, strict=True)),
        ]
    )
    trips = np.arange(0.0, LONGEST_S, 0.0005)[:, np.newaxis]
    short, long = trips - edges, edges - trips - TICK_S
    outside = (np.maximum(short, 0) + np.maximum(long, 0)).sum(1)
    return float(np.median(trips[outside <= outside.min() + 1e-9]))


def latencies(trip: float) -> tuple[float, float]:
    """A round trip as (felt after, seen after), in seconds."""
    return trip * FELT_SHARE, trip * (1 - FELT_SHARE)


def _middle(step: tuple[int, float, float]) -> float:
    return (step[1] + step[2]) / 2
