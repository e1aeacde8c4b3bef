"""What the holds of a walk's calibration say: the pace of both gaits, the latencies, and how well all of it fits."""

from collections.abc import Sequence
from dataclasses import dataclass

from calibration.walk.fit import Matched, Pace, Track, fit, matched, rms
from calibration.walk.survey import Held
from calibration.walk.timing import Steps, latencies, round_trip
from mc_nested.errors import NotConfirmedError
from mc_nested.live.profile_tables import Walk
from mc_nested.live.walk import INERTIA, TICK_S, displacement

TICKS = 12
"""Ticks up to which a profile says how far a hold leads."""

HELD_OUT = 4
"""Each so manieth hold is kept out of a first fit, and predicted by it."""

ASIDE = 0.05
"""Blocks that a hold may lead aside."""

WORST = 0.02
"""Blocks, as the root of the mean square, that a prediction may be off; the profile stays as it was beyond it."""

PLAIN_SPEED = displacement(200) / 200 / TICK_S
"""Blocks a second of a plain walker on most blocks: 4.317 (FACTS: Walking)."""

OTHER_SPEED, OTHER_INERTIA = 0.015, 0.01
"""How far, as a part and as it is, speed and inertia may be off the plain walker's before it is said."""

LAGGING = 0.1
"""The part of all holds that lag may spoil or delay before it is said."""


@dataclass(frozen=True)
class Gauge:
    """How the player of this game walks, and how it was found.

    ``walking`` and ``sneaking`` are paces; ``trip`` the seconds from a press to its step on the screen without the wait
    for a tick; ``good`` the holds that it rests on, in order, each with the path it lies beside. ``lost`` counts those
    that were no holds of whole ticks, ``late`` those whose ticks came late. ``held_out`` is how far off those ended
    that a fit without them predicted, as the root of the mean square, in blocks. ``beat`` is a time, in seconds of the
    clock, at which a tick's step was seen: others are whole ticks from there.
    """

    walking: Pace
    sneaking: Pace
    trip: float
    good: tuple[Matched, ...]
    lost: int
    late: int
    held_out: float
    beat: float

    @property
    def off(self) -> float:
        """The root of the mean square, in blocks, of how far off the predicted place holds ended."""
        return rms([each.end_off for each in self.good])

    @property
    def speed(self) -> float:
        """Blocks a second of walking on and on."""
        return self.walking.steady / TICK_S

    @property
    def table(self) -> Walk:
        """The profile's table."""
        felt, seen = latencies(self.trip)
        return Walk(
            covered=tuple(round(self.walking.covered(ticks), 4) for ticks in range(1, TICKS + 1)),
            inertia=round(self.walking.inertia, 4),
            sneaking=round(self.sneaking.push / self.walking.push, 4),
            felt_after_s=round(felt, 4),
            seen_after_s=round(seen, 4),
        )

    @property
    def is_lagging(self) -> bool:
        """Whether so many holds were spoiled or late that it should be said."""
        return self.lost + self.late > LAGGING * (len(self.good) + self.lost)

    @property
    def is_plain(self) -> bool:
        """Whether this is how a player walks on most blocks, without an effect."""
        return abs(self.speed / PLAIN_SPEED - 1) <= OTHER_SPEED and abs(self.walking.inertia - INERTIA) <= OTHER_INERTIA


def gauged(holds: Sequence[Held]) -> Gauge:
    """What the holds say.

    Raises:
        NotConfirmedError: too few of them could be followed, or they don't agree, or sneaking isn't slower.
    """
    straight = [held for held in holds if held.track is not None and held.aside <= ASIDE]
    walked = [held.track for held in straight if held.track and held.gait == "walk"]
    sneaked = [held.track for held in straight if held.track and held.gait == "sneak"]
    walking = fit(walked)
    sneaking = fit(sneaked, walking.inertia)
    if sneaking.push > 0.95 * walking.push:
        raise NotConfirmedError(
            "sneaking is no slower than walking: set keys.sneak in the profile to the game's own key, Sneak to Hold in "
            "its controls, and stand on the ground"
        )
    good: list[Matched] = []
    steps: list[Steps] = []
    for held in straight:
        track = held.track
        if track is None or (beside := matched(track, walking if held.gait == "walk" else sneaking)).is_spoiled:
            continue
        good.append(beside)
        steps.append(held.steps(beside.at_tick, beside.ticks))
    timely = [each for each in steps if not each.late]
    if not timely:
        raise NotConfirmedError("every hold's ticks came late: close other programs, and calibrate again")
    gauge = Gauge(
        walking,
        sneaking,
        round_trip(timely),
        tuple(good),
        lost=sum(held.track is not None for held in holds) - len(good),
        late=len(steps) - len(timely),
        held_out=_held_out(walked),
        beat=timely[-1].first_seen,
    )
    if max(gauge.off, gauge.held_out) > WORST:
        raise NotConfirmedError(
            f"what was predicted and what was measured lie {max(gauge.off, gauge.held_out):.3f} blocks apart, more "
            f"than {WORST}: close other programs, stand on a floor of one block, and calibrate again"
        )
    return gauge


def _held_out(tracks: Sequence[Track]) -> float:
    """How far off tracks ended that the others predicted, as the root of the mean square, in blocks."""
    others = [track for index, track in enumerate(tracks) if index % HELD_OUT]
    pace = fit(others)
    kept = [matched(track, pace) for index, track in enumerate(tracks) if not index % HELD_OUT]
    return rms([each.end_off for each in kept if not each.is_spoiled])
