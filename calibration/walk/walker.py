"""Walker: holds keys for a time from rest, and records every position that is seen until standstill."""

import math
from dataclasses import dataclass
from itertools import pairwise

from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.deadline import Deadline
from mc_nested.live.model.coordinates import GroundVector, turn_between
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.profile.tables import Profile

LOOK_S = 0.008
"""Seconds between two looks: two a frame, so that each step is seen within a frame of being drawn."""

SETTLE_S, STALL_S = 0.25, 1.0
"""Seconds at one position after which the walker stands: five ticks; and the same for one that wasn't seen to move, or
whose picture stalled while it moved: a busy machine shows nothing for a while, too."""

GAPS = 3
"""A new position is awaited for this many times the longest time between two positions so far."""

RUNAWAY_S = 0.3
"""Seconds after which a walker whose keys are up, but who goes on, has them released once more."""

HEIGHT_TOLERANCE = 0.05
"""Blocks that the feet may rise or sink: a level floor has no step, and nobody flies."""

VIEW_TOLERANCE = 0.5
"""Degrees that the view may turn: the debug screen shows tenths."""

ARRIVAL_TOLERANCE = 0.01
"""Blocks that a player may be off the position of a teleport."""

XYZ = tuple[float, float, float]


@dataclass(frozen=True)
class WorldPose:
    """The position of the feet, in blocks, and the view, in degrees."""

    xyz: XYZ
    yaw: float
    pitch: float


@dataclass(frozen=True)
class Sighting:
    """A position that was first seen ``at``, and not yet by the look before, at ``since``."""

    since: float
    at: float
    xyz: XYZ


@dataclass(frozen=True)
class RecordedHold:
    """A hold: when its keys went down and up, where it began, and each new position until standstill, in order."""

    pressed: float
    released: float
    begin: WorldPose
    sightings: tuple[Sighting, ...]

    @property
    def held_s(self) -> float:
        """Seconds that its keys were down."""
        return self.released - self.pressed

    @property
    def end(self) -> XYZ:
        """Where the walker stands after it."""
        return self.sightings[-1].xyz if self.sightings else self.begin.xyz

    @property
    def positions(self) -> tuple[GroundVector, ...]:
        """Each new position relative to the beginning."""
        return tuple(offset_from(self.begin, sighting.xyz) for sighting in self.sightings)


class Walker:
    """Walks by holding keys, watching the debug screen.

    Raises (everything): UnreadableError if that can't be read for the profile's patience; NotConfirmedError if the
    player is pushed, turned, rises, sinks or doesn't come to a stop; what the input controller raises.
    """

    def __init__(self, connection: GameConnection, profile: Profile) -> None:
        self._controller = connection.controller
        self._clock = connection.devices.clock
        self._patience_s = profile.body.patience_s
        self._screen = connection.screen
        self._rest: XYZ | None = None

    def look(self) -> WorldPose:
        """The player's pose; waits while the debug screen can't be read."""
        return self._look()[1]

    def stand(self) -> WorldPose:
        """Wait until the player stands still; the pose then. No wait is needed where the last one ended."""
        pose = self.look()
        return pose if pose.xyz == self._rest else self._wait_for_rest(pose, [], self._clock.now())

    def arrives(self, pose: WorldPose) -> bool:
        """Wait until the player is seen there, as after a teleport; False if that isn't seen within the patience."""
        patience = Deadline(self._clock, self._patience_s)
        while not _is_at(pose, self.look()):
            if patience.has_passed:
                return False
            self._controller.wait(LOOK_S)
        return True

    def hold(
        self, seconds: float, *keys: str, phase: float | None = None, max_distance: float = math.inf
    ) -> RecordedHold:
        """Hold keys of the world from rest, and follow the walker until standstill.

        Args:
            seconds: how long.
            keys: which, together.
            phase: a time of the clock; the keys go down a whole number of ticks after it. None presses at once.
            max_distance: blocks from the beginning at which the keys go up early.
        """
        begin = self.stand()
        if self._screen.is_chat_open():
            raise NotConfirmedError("the chat is open: leave mouse and keys alone while this walks")
        self._controller.confirm_screen("world")
        if phase is not None:
            from_now = (phase - self._clock.now()) % TICK_S
            self._controller.wait_until(self._clock.now() + from_now)
        pressed = self._clock.now()
        released = pressed + seconds
        seen: list[Sighting] = []
        try:
            self._controller.press(released, *keys)
            released = self._follow(begin, seen, pressed, released, keys, max_distance)
        except BaseException:
            self._controller.release_all()
            raise
        return RecordedHold(pressed, released, begin, tuple(seen))

    def _follow(
        self,
        begin: WorldPose,
        seen: list[Sighting],
        since: float,
        released: float,
        keys: tuple[str, ...],
        max_distance: float,
    ) -> float:
        """Follow the walker while the keys are down, and until standstill; when they went up."""
        while self._clock.now() < released:
            # A look takes a while: the last one must not make the release late.
            soon = self._clock.now() + LOOK_S
            self._controller.wait_until(soon if soon + LOOK_S < released else released)
            if self._clock.now() >= released:
                break
            since = self._record(begin, seen, since)
            if seen and math.dist(seen[-1].xyz, begin.xyz) >= max_distance:
                released = self._clock.now()
                self._controller.keep_until(released, *keys)
        self._controller.wait_until(released)
        released = self._clock.now()
        self._wait_for_rest(begin, seen, since, is_held=True)
        return released

    def _wait_for_rest(
        self, begin: WorldPose, seen: list[Sighting], since: float, *, is_held: bool = False
    ) -> WorldPose:
        """Follow the walker to a standstill, with its keys up; ``is_held`` if they were down until just now."""
        began = self._clock.now()
        patience, release_again_at = Deadline(self._clock, self._patience_s), began + RUNAWAY_S
        while True:
            now = self._clock.now()
            last = max(began, seen[-1].at) if seen else began
            if now - last >= (_settle_s(seen) if is_held else SETTLE_S):
                self._rest = seen[-1].xyz if seen else begin.xyz
                return WorldPose(self._rest, begin.yaw, begin.pitch)
            if patience.has_passed:
                raise NotConfirmedError("you don't come to a stop: does something push you, or is a key held down?")
            if now >= release_again_at:
                self._controller.release_again()
                release_again_at = now + RUNAWAY_S
            self._controller.wait(LOOK_S)
            since = self._record(begin, seen, since)

    def _look(self) -> tuple[float, WorldPose]:
        """When a readable picture was taken, and what it says."""
        patience = Deadline(self._clock, self._patience_s)
        while True:
            at = self._clock.now()
            reading = self._screen.read()
            if reading.xyz is not None and reading.yaw is not None and reading.pitch is not None:
                return at, WorldPose(reading.xyz, reading.yaw, reading.pitch)
            # A window in front of the game can't be read, but it is the reason.
            self._controller.check_front()
            if patience.has_passed:
                raise UnreadableError(
                    f"the debug screen was unreadable for {self._patience_s:g} s: {reading.problem or 'no Facing line'}"
                )
            self._controller.wait(LOOK_S)

    def _record(self, begin: WorldPose, seen: list[Sighting], since: float) -> float:
        """Look, and record a position that is new; when the look was."""
        # Waits this short don't check whether the window is still in front.
        self._controller.check_front()
        at, pose = self._look()
        if abs(pose.xyz[1] - begin.xyz[1]) > HEIGHT_TOLERANCE:
            raise NotConfirmedError(
                f"your feet went from y = {begin.xyz[1]:g} to {pose.xyz[1]:g}: stand on a level floor, don't fly, and "
                "turn auto-jump off"
            )
        if turn_between(pose.yaw, begin.yaw) > VIEW_TOLERANCE or abs(pose.pitch - begin.pitch) > VIEW_TOLERANCE:
            raise NotConfirmedError("your view has turned: leave mouse and keys alone while this walks")
        if pose.xyz != (seen[-1].xyz if seen else begin.xyz):
            seen.append(Sighting(since, at, pose.xyz))
        return at


def _settle_s(seen: list[Sighting]) -> float:
    if len(seen) < 2:
        return STALL_S
    longest = max(after.at - before.at for before, after in pairwise(seen))
    return min(STALL_S, max(SETTLE_S, GAPS * longest))


def _is_at(pose: WorldPose, seen: WorldPose) -> bool:
    off = max(map(abs, offset_from(pose, seen.xyz)))
    is_view_same = turn_between(pose.yaw, seen.yaw) <= VIEW_TOLERANCE and abs(pose.pitch - seen.pitch) <= VIEW_TOLERANCE
    return off <= ARRIVAL_TOLERANCE and is_view_same


def offset_from(pose: WorldPose, xyz: XYZ) -> GroundVector:
    """From a pose to a position. Yaw 0 is south, 90 west (FACTS: Standing, looking, placing)."""
    sine, cosine = math.sin(math.radians(pose.yaw)), math.cos(math.radians(pose.yaw))
    east, south = xyz[0] - pose.xyz[0], xyz[2] - pose.xyz[2]
    return GroundVector(-east * cosine - south * sine, -east * sine + south * cosine)
