"""How far a hold leads in a game whose walk has no ticks as Minecraft's has: a straight line through what was measured.

Where a player moves with every frame, no hold fits a path of whole ticks. What is left is how far holds of each length
led. Playing needs no more: where it recognises no path, it looks until the player stands still.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibration.walk.gait_fit import FEWEST, HoldTrace, rms
from calibration.walk.survey import SurveyHold
from mc_nested.live.model.kinematics import TICK_S, Gait
from mc_nested.live.profile.tables import WalkTable

TICKS = 12
"""Ticks up to which a profile says how far a hold leads."""

SHORTEST_STEP = 0.01
"""Blocks that a tick more leads farther, at least, on a line that would begin below zero."""

MAX_ERROR = 0.05
"""Blocks (RMS) that holds may end off the line: Minecraft's own, of whole ticks, end 0.06 off and more."""

_Float64Array = NDArray[np.float64]


@dataclass(frozen=True)
class EmpiricalWalk:
    """Lines through the holds of both gaits.

    Attributes:
        table: the profile's table; inertia and latencies are the usual ones, since they can't be measured here.
        traces: the walking holds that it rests on.
        error: root of the mean square, in blocks, of how far they end off the line.
        speed: blocks a second of steady walking.
        sneaking_speed: the same, sneaking.
    """

    table: WalkTable
    traces: tuple[HoldTrace, ...]
    error: float
    speed: float
    sneaking_speed: float


def empirical_walk(holds: Sequence[SurveyHold], usual: WalkTable) -> EmpiricalWalk | None:
    """Lines through the holds; None where there are too few, or they don't lie on one, or sneaking isn't slower.

    ``usual`` gives the inertia and the latencies.
    """
    traces = [hold.trace for hold in holds if hold.trace is not None]
    gaits: dict[Gait, list[HoldTrace]] = {
        gait: [trace for trace in traces if trace.gait == gait] for gait in ("walk", "sneak")
    }
    if min(len(found) for found in gaits.values()) < FEWEST:
        return None
    (speed, start), (sneaking_speed, _) = (_line(gaits[gait]) for gait in ("walk", "sneak"))
    walked = gaits["walk"]
    error = rms([trace.covered[-1] - start - speed * trace.held_s for trace in walked])
    if error > MAX_ERROR or not 0 < sneaking_speed < 0.95 * speed:
        return None
    covered: list[float] = []
    for ticks in range(1, TICKS + 1):
        least = (covered[-1] if covered else 0.0) + SHORTEST_STEP
        covered.append(max(least, start + speed * ticks * TICK_S))
    table = usual.model_copy(
        update={
            "covered": tuple(round(blocks, 4) for blocks in covered),
            "sneaking": round(sneaking_speed / speed, 4),
        }
    )
    return EmpiricalWalk(table, tuple(walked), error, speed, sneaking_speed)


def _line(traces: Sequence[HoldTrace]) -> tuple[float, float]:
    """The speed, in blocks a second, and the blocks at a hold of no length, of the line nearest the holds' ends."""
    held: _Float64Array = np.array([trace.held_s for trace in traces])
    ends: _Float64Array = np.array([trace.covered[-1] for trace in traces])
    slope, start = np.polyfit(held, ends, 1)
    return float(slope), float(start)
