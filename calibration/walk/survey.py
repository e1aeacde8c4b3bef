"""The holds that a walk's calibration rests on: first sneaking, to find keys and free floor; then walking, there.

Sneaking comes first because who sneaks falls off no edge, and stops at a wall without harm: where it has led, walking
is safe. Every hold goes towards where it all began, or from there, and never farther than sneaking went.
"""

import statistics
from collections.abc import Mapping
from dataclasses import dataclass

from calibration.walk.fit import Track
from calibration.walk.keys import WAYS, Way, keys_found, way_of
from calibration.walk.timing import Steps
from calibration.walk.walker import Pose, Walked, Walker, seen_from
from mc_nested.errors import NotConfirmedError, UserError
from mc_nested.live.devices import Clock
from mc_nested.live.profile_tables import Keys
from mc_nested.live.walk import TICK_S, Gait

REACH = 2.0
"""Blocks from where it began that are walked in: nine ticks of walking."""

NEEDED = 1.6
"""Blocks that have to be free on each side: seven ticks, and a little that a lost key may lead on."""

PROBE_S, OUT_S = 5 * TICK_S, 31 * TICK_S
"""Seconds of a sneaking step that shows where a key leads, and of the longest way out: 0.3 and 2.0 blocks."""

LONGEST, SHORTEST = 9, 4
"""Ticks of the longest hold, where the free floor allows it, and of the one that has to be possible."""

LONG_ENOUGH_S = 35.0
"""Seconds of walking after which no longer holds are begun, as on ice, where each of them coasts for seconds."""

TRIES = 3
"""How often a key is tried that seemed to do nothing: on a busy machine a press may be lost."""

CARRIED_OFF = 4.0
"""Blocks from where it began at which nobody could have walked by these holds."""

GOLDEN = 0.618
"""Of a tick, from each hold to the next: so they begin at every phase of the tick, evenly."""

Axis = tuple[Way, Way]
SIDES: Axis = ("left", "right")
AHEAD: Axis = ("back", "forward")

OPPOSITE: Mapping[Way, Way] = {"forward": "back", "back": "forward", "left": "right", "right": "left"}


@dataclass(frozen=True)
class Held:
    """A hold as it was: its way and gait, the ticks asked for, and what was seen."""

    way: Way
    gait: Gait
    asked: float
    walked: Walked

    @property
    def track(self) -> Track | None:
        """Its places along its way, as far as they go on; None where nothing moved."""
        axis, sign = _axis_of(self.way)
        along: list[float] = []
        for place in self.walked.places:
            covered = place[axis] * sign
            if covered > (along[-1] if along else 0.0):
                along.append(covered)
        return Track(self.gait, self.walked.released - self.walked.pressed, tuple(along)) if along else None

    @property
    def aside(self) -> float:
        """Blocks that it led aside: none, unless something pushed."""
        return max((abs(place[1 - _axis_of(self.way)[0]]) for place in self.walked.places), default=0.0)

    def steps(self, at_tick: tuple[int, ...], ticks: int) -> Steps:
        """Its steps in time, each of the track's places having been reached after so many ticks."""
        seen = zip(at_tick, self.walked.sightings, strict=False)
        return Steps(
            self.walked.pressed,
            self.walked.released,
            ticks,
            tuple((tick, sighting.since, sighting.at) for tick, sighting in seen if tick),
        )


class Survey:
    """Makes the holds, and keeps them.

    Args:
        walker: who walks.
        keys: the keys, perhaps not yet the right ones.
        clock: the clock that the walker uses.
    """

    def __init__(self, walker: Walker, keys: Keys, clock: Clock) -> None:
        self._walker, self.keys, self._clock = walker, keys, clock
        self.home: Pose = walker.stand()
        self.holds: list[Held] = []
        self.reach = REACH

    def find_keys(self) -> Keys:
        """A short sneaking step with each key: the keys as they really go; UserError where they don't."""
        went: dict[Way, Way | None] = {way: self._led(way) for way in WAYS}
        self.keys = keys_found(self.keys, went)
        return self.keys

    def find_floor(self) -> None:
        """Sneak out and back along each way: how far it is free; UserError where that is too little."""
        for way in WAYS:
            covered = self._sneak_out(way)
            if covered < NEEDED:
                raise UserError(
                    f"{covered:.1f} blocks {way} of where you stand something is in the way, or the floor ends: stand "
                    f"where it is flat and free for {REACH + 1:g} blocks on every side"
                )
            self.reach = min(self.reach, covered)
            self._hold(OPPOSITE[way], "sneak", OUT_S / TICK_S, farthest=covered)

    def walk(self) -> None:
        """Walking holds of 1, 2, 3 ticks and more, there and back, as far as the floor is known to be free."""
        until = self._clock.now() + LONG_ENOUGH_S
        for ticks in range(1, LONGEST + 1):
            if ticks > SHORTEST and (ticks * self._step() > self.reach or self._clock.now() >= until):
                break
            for axis in (AHEAD, SIDES):
                for _ in range(2):
                    self.hold_homewards(axis, ticks + self._uneven())

    def hold_homewards(self, axis: Axis, ticks: float, phase: float | None = None) -> Held:
        """A walking hold along an axis, to the side on which there is more floor."""
        offset = self.offset(axis)
        if abs(offset) > CARRIED_OFF:
            raise NotConfirmedError("you were carried off: leave mouse and keys alone while this walks")
        return self._hold(axis[offset < 0 or (offset == 0 and len(self.holds) % 2)], "walk", ticks, phase)

    def offset(self, axis: Axis) -> float:
        """Blocks along an axis from where it all began."""
        return seen_from(self.home, self._walker.look().xyz)[_axis_of(axis[1])[0]]

    def _step(self) -> float:
        """Blocks that a tick of walking covers, by the longest holds so far."""
        longest = [held.track for held in self.holds[-8:] if held.gait == "walk"]
        return statistics.median(track.covered[-1] / track.held_s * TICK_S for track in longest if track)

    def _led(self, way: Way) -> Way | None:
        """Where the key that should go this way leads, and a step back with whichever key undoes it later."""
        for _ in range(TRIES):
            self._hold(way, "sneak", PROBE_S / TICK_S)
            if found := way_of(seen_from(self.holds[-1].walked.begin, self.holds[-1].walked.end)):
                self.holds[-1] = Held(found, "sneak", self.holds[-1].asked, self.holds[-1].walked)
                return found
        return None

    def _sneak_out(self, way: Way) -> float:
        """How far that leads. A short way is tried again: a picture that stalls looks like a wall."""
        axis, sign = _axis_of(way)
        covered = 0.0
        for _ in range(TRIES):
            self._hold(way, "sneak", OUT_S / TICK_S, farthest=REACH - covered)
            covered = seen_from(self.home, self.holds[-1].walked.end)[axis] * sign
            if covered >= NEEDED:
                break
        return covered

    def _hold(
        self, way: Way, gait: Gait, ticks: float, phase: float | None = None, farthest: float = float("inf")
    ) -> Held:
        keys = [self.keys.sneak] if gait == "sneak" else []
        phase = phase if phase is not None else len(self.holds) * GOLDEN * TICK_S
        walked = self._walker.hold(ticks * TICK_S, *keys, getattr(self.keys, way), phase=phase, farthest=farthest)
        held = Held(way, gait, (walked.released - walked.pressed) / TICK_S, walked)
        self.holds.append(held)
        return held

    def _uneven(self) -> float:
        """Of a tick, longer or shorter than whole ones, so that releases come at every phase, too."""
        return (len(self.holds) * GOLDEN * GOLDEN) % 0.8 - 0.4


def _axis_of(way: Way) -> tuple[int, int]:
    """The axis (0 right, 1 forward) and the sign of a way."""
    return (0 if way in SIDES else 1), (1 if way in ("right", "forward") else -1)
