"""The round trip from a key to the screen, estimated from many holds: when a press is felt and its step is seen.

press ... the game has it ... [up to a tick] ... the tick ... its step is seen
release ... the game has it ... [up to a tick] ... the first tick without it ... its step would be seen

Each edge of a hold, press or release, says only this: the tick that it decides on comes between 0 and 50 ms after the
game has it. So the time from the edge to that tick's step lies between the round trip and 50 ms more, evenly if holds
begin at all phases of the tick. The round trip is the value that most edges agree with. How much of it is input latency
and how much is capture latency can't be seen from outside. It needn't be: presses are timed by steps that were seen, so
only the sum matters.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.timing import CAPTURE_LATENCY_S, INPUT_LATENCY_S

LATE_S = 0.045
"""Seconds that a step may be seen off its hold's tick phase: late frames are off by less, late ticks by more."""

LONGEST_S = 0.4
"""Seconds: the longest round trip that is considered."""

FITS_S = 0.004
"""Seconds by which an edge may lie outside its bounds and still fit: half of the time between two looks."""

INPUT_SHARE = INPUT_LATENCY_S / (INPUT_LATENCY_S + CAPTURE_LATENCY_S)
"""The input latency's share of a round trip, by the default latencies."""


@dataclass(frozen=True)
class HoldTiming:
    """A hold in time: when its key went down and up, and its steps as (tick, since, at).

    ``tick`` counts from 1, the first that felt the key; the step was first seen by the look ``at``, and not yet by the
    one at ``since``; ``ticks`` is how many felt the key. All in seconds of one clock.
    """

    pressed: float
    released: float
    ticks: int
    steps: tuple[tuple[int, float, float], ...]

    @property
    def first_seen(self) -> float:
        """The time at which the first tick's step is seen, the median over all steps."""
        return float(np.median([_middle(step) - (step[0] - 1) * TICK_S for step in self.steps]))

    @property
    def late_steps(self) -> int:
        """The number of steps that were seen too far off the others' tick phase."""
        first = self.first_seen
        return sum(abs(_middle(step) - (step[0] - 1) * TICK_S - first) > LATE_S for step in self.steps)


def round_trip_of(holds: Sequence[HoldTiming]) -> float:
    """Return the seconds from a press until its step is seen if a tick comes at once; the estimate from many holds."""
    trips = np.arange(0.0, LONGEST_S, 0.0005)
    outside = _outside(_edges(holds), trips[:, np.newaxis]).sum(1)
    return float(np.median(trips[outside <= outside.min() + 1e-9]))


def disagreeing(holds: Sequence[HoldTiming], round_trip_s: float) -> float:
    """Return the share of edges that don't fit a round trip: few if a game stalls, many if frames are slow.

    In slow frames input waits for a frame and ticks come several at a time, so that edges spread over more than a tick.
    """
    return float(np.mean(_outside(_edges(holds), round_trip_s) > FITS_S))


def _edges(holds: Sequence[HoldTiming]) -> NDArray[np.float64]:
    """Return the seconds from each press, then each release, until the step of the tick that it decides on is seen."""
    first = [hold.first_seen for hold in holds]
    pressed = [at - hold.pressed for hold, at in zip(holds, first, strict=True)]
    released = [at + hold.ticks * TICK_S - hold.released for hold, at in zip(holds, first, strict=True)]
    return np.array([*pressed, *released])


def _outside(edges: NDArray[np.float64], trips: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Return the seconds by which each edge is shorter than a round trip, or longer than it and a tick."""
    return np.maximum(trips - edges, 0) + np.maximum(edges - trips - TICK_S, 0)


def latencies(round_trip_s: float) -> tuple[float, float]:
    """Return a round trip split into input latency and capture latency, in seconds."""
    return round_trip_s * INPUT_SHARE, round_trip_s * (1 - INPUT_SHARE)


def _middle(step: tuple[int, float, float]) -> float:
    return (step[1] + step[2]) / 2
