"""Fit both gaits and the latencies to the holds of a walk's calibration, and measure how well all of it fits.

Where a player moves with every frame, no hold fits a path of whole ticks. What is left is a straight line through how
far holds of each length led. Playing needs no more: where it recognises no path, it looks until the player stands
still.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from calibration.walk.gait_fit import FEWEST, GaitModel, HoldTrace, MatchedHold, fit_gait, match_hold, rms
from calibration.walk.round_trip import HoldTiming, disagreeing, latencies, round_trip_of
from calibration.walk.survey import SurveyHold
from mc_nested.errors import NotConfirmedError
from mc_nested.live.model.kinematics import INERTIA, TICK_S, Gait, displacement
from mc_nested.live.model.timing import CAPTURE_LATENCY_S, INPUT_LATENCY_S
from mc_nested.live.profile.tables import WalkTable

TICKS = 12
"""Ticks up to which a profile says how far a hold leads."""

HELD_OUT = 4
"""Every fourth hold is held out to validate the fit."""

MAX_ASIDE = 0.05
"""Blocks that a hold may lead sideways."""

MAX_ERROR = 0.02
"""Blocks (RMS) by which predictions may be off; if they are off by more, the profile is left as it was."""

PLAIN_SPEED = displacement(200) / 200 / TICK_S
"""Blocks a second of a plain walker on most blocks: 4.317 (FACTS: Walking)."""

OTHER_SPEED, OTHER_INERTIA = 0.015, 0.01
"""How far speed (relative) and inertia (absolute) may be off the plain walker's before a warning says so."""

SLOW_FRAMES, SURELY_SLOW = 0.15, 0.25
"""The share of presses and releases that don't fit the round trip where frames are slow: 0.17 and more at up to 18
frames a second, 0.34 and more at up to 13. In a game of 60 that stalls every second or so it is 0.20 at most, and some
holds are late or not of whole ticks: at 14 to 18 frames a second none is."""

LAGGING = 0.1
"""The share of all holds that may be outliers or late before a warning says so."""


@dataclass(frozen=True)
class WalkModel:
    """A model of how the player of this game walks, and the evidence for it.

    Attributes:
        walking, sneaking: the models of the two gaits.
        round_trip_s: seconds from a press to its step on the screen, without the wait for a tick.
        disagreeing: the share of presses and releases that don't fit this round trip.
        good: the holds that it rests on, in order, each with its path.
        outliers: how many holds were not of whole ticks.
        late: how many holds had ticks that came late.
        held_out_rms: root of the mean square, in blocks, of the end errors of held-out holds.
        tick_phase: a time, in seconds of the clock, at which a tick's step was seen: others are whole ticks from there.
    """

    walking: GaitModel
    sneaking: GaitModel
    round_trip_s: float
    disagreeing: float
    good: tuple[MatchedHold, ...]
    outliers: int
    late: int
    held_out_rms: float
    tick_phase: float

    @property
    def fit_rms(self) -> float:
        """The root of the mean square, in blocks, of the end errors of the good holds."""
        return rms([hold.end_error for hold in self.good])

    @property
    def speed(self) -> float:
        """Blocks a second of steady walking."""
        return self.walking.steady / TICK_S

    @property
    def table(self) -> WalkTable:
        """The profile's table."""
        # Where several ticks come in a frame, the round trip looks too short.
        shortest_s = INPUT_LATENCY_S + CAPTURE_LATENCY_S if self.has_slow_frames else 0.0
        input_latency_s, capture_latency_s = latencies(max(self.round_trip_s, shortest_s))
        return WalkTable(
            covered=tuple(round(self.walking.covered(ticks), 4) for ticks in range(1, TICKS + 1)),
            inertia=round(self.walking.inertia, 4),
            sneaking=round(self.sneaking.push / self.walking.push, 4),
            input_latency_s=round(input_latency_s, 4),
            capture_latency_s=round(capture_latency_s, 4),
        )

    @property
    def has_slow_frames(self) -> bool:
        """Whether frames are slower than ticks, all of them: stalls make some holds late, or of no whole ticks."""
        has_stalls = self.outliers + self.late > 0
        return self.disagreeing > (SURELY_SLOW if has_stalls else SLOW_FRAMES)

    @property
    def is_lagging(self) -> bool:
        """Whether so many holds were outliers or late that a warning is due."""
        return self.outliers + self.late > LAGGING * (len(self.good) + self.outliers)

    @property
    def is_plain(self) -> bool:
        """Whether this is how a player walks on most blocks, without an effect."""
        return abs(self.speed / PLAIN_SPEED - 1) <= OTHER_SPEED and abs(self.walking.inertia - INERTIA) <= OTHER_INERTIA


def fit_walk_model(holds: Sequence[SurveyHold]) -> WalkModel:
    """Return the model that fits the holds.

    Raises:
        NotConfirmedError: too few of them could be followed, or they don't agree, or sneaking isn't slower.
    """
    straight = [hold for hold in holds if hold.trace is not None and hold.aside <= MAX_ASIDE]
    walked = [hold.trace for hold in straight if hold.trace and hold.gait == "walk"]
    sneaked = [hold.trace for hold in straight if hold.trace and hold.gait == "sneak"]
    walking = fit_gait(walked)
    sneaking = fit_gait(sneaked, walking.inertia)
    if sneaking.push > 0.95 * walking.push:
        raise NotConfirmedError(
            "sneaking is no slower than walking: set keys.sneak in the profile to the game's own key, Sneak to Hold in "
            "its controls, and stand on the ground"
        )
    good: list[MatchedHold] = []
    timings: list[HoldTiming] = []
    for hold in straight:
        matched = hold.trace and match_hold(hold.trace, walking if hold.gait == "walk" else sneaking)
        if matched and not matched.is_outlier:
            good.append(matched)
            timings.append(hold.timing(matched.at_tick, matched.ticks))
    timely = [timing for timing in timings if not timing.late_steps]
    if not timely:
        raise NotConfirmedError("every hold's ticks came late: close other programs, and calibrate again")
    round_trip_s = round_trip_of(timely)
    walk_model = WalkModel(
        walking,
        sneaking,
        round_trip_s,
        disagreeing(timely, round_trip_s),
        tuple(good),
        outliers=sum(hold.trace is not None for hold in holds) - len(good),
        late=len(timings) - len(timely),
        held_out_rms=_held_out_rms(walked),
        tick_phase=timely[-1].first_seen,
    )
    error = max(walk_model.fit_rms, walk_model.held_out_rms)
    if error > MAX_ERROR:
        raise NotConfirmedError(
            f"predictions and measurements are {error:.3f} blocks apart, more than {MAX_ERROR}: close other programs, "
            "stand on a floor of one block, and calibrate again"
        )
    return walk_model


def _held_out_rms(traces: Sequence[HoldTrace]) -> float:
    """Return the RMS of the held-out traces' end errors, predicted by a fit of the other traces, in blocks."""
    others = [trace for index, trace in enumerate(traces) if index % HELD_OUT]
    model = fit_gait(others)
    held_out = [match_hold(trace, model) for index, trace in enumerate(traces) if not index % HELD_OUT]
    return rms([hold.end_error for hold in held_out if not hold.is_outlier])


SHORTEST_STEP = 0.01
"""On a line that would begin below zero, every further tick leads at least so many blocks farther."""

MAX_ERROR_OF_LINE = 0.05
"""Blocks (RMS) that holds may end off the line: Minecraft's own, of whole ticks, end 0.06 off and more."""


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
    """Fit lines through the holds; None if there are too few, or they don't lie on one, or sneaking isn't slower.

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
    if error > MAX_ERROR_OF_LINE or not 0 < sneaking_speed < 0.95 * speed:
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
    """Fit a line to the holds' ends; return its speed, in blocks a second, and its blocks at a hold of no length."""
    held = np.array([trace.held_s for trace in traces], np.float64)
    ends = np.array([trace.covered[-1] for trace in traces], np.float64)
    slope, start = np.polyfit(held, ends, 1)
    return float(slope), float(start)
