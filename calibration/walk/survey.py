"""Survey: the holds that a walk's calibration rests on. First sneaking, to find keys and free floor; then walking.

Sneaking comes first because a sneaking player falls off no edge, and stops at a wall without harm: where it has led,
walking is safe. Every hold leads towards the starting point or away from it, and never farther than sneaking went. On
floor that is known to be free, as an arena's that a reset has refilled, it sneaks only for the speed of sneaking.
Where a step with each of the four keys ended says which key really goes which way.
"""

import statistics
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, get_args

from calibration.walk.gait_fit import HoldTrace
from calibration.walk.round_trip import HoldTiming
from calibration.walk.walker import RecordedHold, Walker
from mc_nested.errors import NotConfirmedError, UserError
from mc_nested.live.devices import Clock, Deadline
from mc_nested.live.model.kinematics import TICK_S, Gait
from mc_nested.live.profile.tables import KeysTable

Direction = Literal["forward", "back", "left", "right"]
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)

MIN_STEP = 0.1
"""A step of fewer blocks than this has gone nowhere: sneaking for five ticks covers three times as much."""

MAX_SIDE_SHARE = 0.25
"""How far sideways a step may lead, as a share of its length."""


def direction_of(offset: tuple[float, float]) -> Direction | None:
    """Return the direction of an offset in blocks (right, forward); None if too short, or between two directions."""
    right, forward = offset
    along, aside = max(abs(right), abs(forward)), min(abs(right), abs(forward))
    if along < MIN_STEP or aside > MAX_SIDE_SHARE * along:
        return None
    if abs(forward) > abs(right):
        return "forward" if forward > 0 else "back"
    return "right" if right > 0 else "left"


def corrected_keys(keys: KeysTable, observed: Mapping[Direction, Direction | None]) -> KeysTable:
    """Return the keys by the direction that each really goes; ``observed`` says where the key of each led.

    Raises:
        UserError: a key goes nowhere, or two go the same way.
    """
    for direction, found in observed.items():
        if found is None:
            raise UserError(
                f"the key {getattr(keys, direction)} doesn't move the player {direction}: write the game's own keys "
                "into the profile's [keys], and leave a block of free floor on every side"
            )
    found_keys = {str(found): getattr(keys, direction) for direction, found in observed.items()}
    if set(found_keys) != set(DIRECTIONS):
        all_found = ", ".join(f"{getattr(keys, direction)} goes {found}" for direction, found in observed.items())
        raise UserError(
            f"the keys don't go four ways ({all_found}): write the game's own keys into the profile's [keys]"
        )
    return keys.model_copy(update=found_keys)


def describe_keys(before: KeysTable, after: KeysTable) -> str:
    """Say which key goes which way, and which ones the profile had differently."""
    found = ", ".join(f"{getattr(after, direction)} goes {direction}" for direction in DIRECTIONS)
    changed = [direction for direction in DIRECTIONS if getattr(before, direction) != getattr(after, direction)]
    return f"{found}; the profile had {' and '.join(changed)} the other way round" if changed else found


REACH = 2.0
"""How far from the starting point it walks, in blocks: nine ticks of walking."""

NEEDED = 1.6
"""Blocks that have to be free on each side: seven ticks, and a little that a lost key may lead on."""

PROBE_S, OUT_S = 5 * TICK_S, 31 * TICK_S
"""Seconds of a sneaking step that shows where a key leads, and of the longest way out: 0.3 and 2.0 blocks."""

KNOWN_FLOOR_TICKS = 9
"""Ticks of each sneaking hold on floor that is known to be free: enough for the speed of sneaking."""

LONGEST, SHORTEST = 9, 4
"""Ticks of the longest hold, if the free floor allows it, and of the one that has to be possible."""

LONG_ENOUGH_S = 35.0
"""Seconds of walking after which no longer holds are begun, as on ice, where each of them coasts for seconds."""

TRIES = 3
"""How often a key is tried that seems to do nothing: on a busy machine a press may be lost."""

CARRIED_OFF = 4.0
"""More blocks from the starting point than these holds can reach."""

GOLDEN = 0.618
"""Share of a tick by which each hold starts later in the tick than the one before: so all phases are covered evenly."""

Axis = tuple[Direction, Direction]
SIDE_AXIS: Axis = ("left", "right")
FORWARD_AXIS: Axis = ("back", "forward")

OPPOSITE: Mapping[Direction, Direction] = {"forward": "back", "back": "forward", "left": "right", "right": "left"}


@dataclass(frozen=True)
class SurveyHold:
    """A hold of the survey: its direction and gait, its length in ticks, and what was recorded."""

    direction: Direction
    gait: Gait
    held_ticks: float
    recorded: RecordedHold

    @property
    def trace(self) -> HoldTrace | None:
        """Its positions along its direction, as long as they grow; None if nothing moved."""
        axis, sign = _axis_of(self.direction)
        along: list[float] = []
        for offset in self.recorded.offsets:
            if (covered := offset[axis] * sign) > (along[-1] if along else 0.0):
                along.append(covered)
        return HoldTrace(self.gait, self.recorded.held_s, tuple(along)) if along else None

    @property
    def aside(self) -> float:
        """Blocks that it led sideways: none, unless something pushed."""
        return max((abs(offset[1 - _axis_of(self.direction)[0]]) for offset in self.recorded.offsets), default=0.0)

    def timing(self, at_tick: tuple[int, ...], ticks: int) -> HoldTiming:
        """Return its steps in time; ``at_tick`` says after how many ticks each of the trace's positions was reached."""
        seen = zip(at_tick, self.recorded.sightings, strict=False)
        return HoldTiming(
            self.recorded.pressed,
            self.recorded.released,
            ticks,
            tuple((tick, sighting.since, sighting.at) for tick, sighting in seen if tick),
        )


class Survey:
    """Makes the holds, and keeps them.

    Args:
        walker: walks and records.
        keys: the keys, perhaps not yet the right ones.
        clock: the clock that the walker uses.
    """

    def __init__(self, walker: Walker, keys: KeysTable, clock: Clock) -> None:
        self._walker, self.keys, self._clock = walker, keys, clock
        self.home = walker.stand()
        self.holds: list[SurveyHold] = []
        self.reach = REACH

    def find_keys(self) -> KeysTable:
        """Sneak a short step with each key to find where each really goes; UserError if they don't go four ways."""
        observed: dict[Direction, Direction | None] = {each: self._direction_led(each) for each in DIRECTIONS}
        self.keys = corrected_keys(self.keys, observed)
        return self.keys

    def find_floor(self) -> None:
        """Sneak out and back in each direction, to see how far the floor is free; UserError if that is too little."""
        for direction in DIRECTIONS:
            covered = self._sneak_out(direction)
            if covered < NEEDED:
                raise UserError(
                    f"{covered:.1f} blocks {direction} of where you stand something is in the way, or the floor ends: "
                    f"stand where it is flat and free for {REACH + 1:g} blocks on every side"
                )
            self.reach = min(self.reach, covered)
            self._hold(OPPOSITE[direction], "sneak", OUT_S / TICK_S, max_distance=covered)

    def sneak_on_known_floor(self) -> None:
        """Sneak a little there and back in each direction, for the speed of sneaking: the floor is free already."""
        for direction in DIRECTIONS:
            for led in (direction, OPPOSITE[direction]):
                self._hold(led, "sneak", KNOWN_FLOOR_TICKS + self._uneven())

    def walk(self) -> None:
        """Walk holds of 1, 2, 3 ticks and more, there and back, as far as the floor is known to be free."""
        long_enough = Deadline(self._clock, LONG_ENOUGH_S)
        for ticks in range(1, LONGEST + 1):
            if ticks > SHORTEST and (ticks * self._step() > self.reach or long_enough.has_passed):
                break
            for axis in (FORWARD_AXIS, SIDE_AXIS):
                for _ in range(2):
                    self.hold_homewards(axis, ticks + self._uneven())

    def hold_homewards(self, axis: Axis, ticks: float, phase: float | None = None) -> SurveyHold:
        """Walk a hold along an axis, to the side with more floor."""
        offset = self.offset(axis)
        if abs(offset) > CARRIED_OFF:
            raise NotConfirmedError("you were carried off: leave mouse and keys alone while this walks")
        return self._hold(axis[offset < 0 or (offset == 0 and len(self.holds) % 2)], "walk", ticks, phase)

    def offset(self, axis: Axis) -> float:
        """Return the blocks along an axis from the starting point."""
        return self._walker.position().minus(self.home)[_axis_of(axis[1])[0]]

    def _step(self) -> float:
        """Return the blocks that a tick of walking covers, by the longest holds so far."""
        longest = [hold.trace for hold in self.holds[-8:] if hold.gait == "walk"]
        return statistics.median(trace.covered[-1] / trace.held_s * TICK_S for trace in longest if trace)

    def _direction_led(self, direction: Direction) -> Direction | None:
        """Return where the key that should go this way really leads; None if it leads nowhere in a few tries."""
        for _ in range(TRIES):
            hold = self._hold(direction, "sneak", PROBE_S / TICK_S)
            if found := direction_of(hold.recorded.end.minus(hold.recorded.begin)):
                self.holds[-1] = SurveyHold(found, "sneak", hold.held_ticks, hold.recorded)
                return found
        return None

    def _sneak_out(self, direction: Direction) -> float:
        """Return how far sneaking that way leads. A short way is tried again: a stalled picture looks like a wall."""
        axis, sign = _axis_of(direction)
        covered = 0.0
        for _ in range(TRIES):
            hold = self._hold(direction, "sneak", OUT_S / TICK_S, max_distance=REACH - covered)
            covered = hold.recorded.end.minus(self.home)[axis] * sign
            if covered >= NEEDED:
                break
        return covered

    def _hold(
        self,
        direction: Direction,
        gait: Gait,
        ticks: float,
        phase: float | None = None,
        max_distance: float = float("inf"),
    ) -> SurveyHold:
        sneak = self.keys.sneak if gait == "sneak" else None
        phase = phase if phase is not None else len(self.holds) * GOLDEN * TICK_S
        recorded = self._walker.hold(
            ticks * TICK_S, getattr(self.keys, direction), sneak=sneak, phase=phase, max_distance=max_distance
        )
        hold = SurveyHold(direction, gait, recorded.held_s / TICK_S, recorded)
        self.holds.append(hold)
        return hold

    def _uneven(self) -> float:
        """Return a share of a tick, longer or shorter than whole ones, so that releases come at every phase, too."""
        return (len(self.holds) * GOLDEN * GOLDEN) % 0.8 - 0.4


def _axis_of(direction: Direction) -> tuple[int, int]:
    """Return the axis (0 right, 1 forward) and the sign of a direction."""
    return (0 if direction in SIDE_AXIS else 1), (1 if direction in ("right", "forward") else -1)
