"""Walker: holds keys for a time from rest, and records every position that is seen until standstill."""

import math
from dataclasses import dataclass

from mc_nested.live.connection import GameConnection
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.timing import HALF_FRAME_S
from mc_nested.live.motion.key_hold import CAREFUL_SETTLE_S, EVERY_LOOK, KeyHold, Standstill
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseFrame, PoseObserver, PoseReader
from mc_nested.live.profile.tables import Profile


@dataclass(frozen=True)
class Sighting:
    """A position that was first seen ``at``, and not yet by the look before, at ``since``."""

    since: float
    at: float
    position: GroundVector


@dataclass(frozen=True)
class RecordedHold:
    """A hold: when its keys went down and up, where it began, and each new position until standstill, in order."""

    pressed: float
    released: float
    begin: GroundVector
    sightings: tuple[Sighting, ...]

    @property
    def held_s(self) -> float:
        """Seconds that its keys were down."""
        return self.released - self.pressed

    @property
    def end(self) -> GroundVector:
        """The walker's position after the hold."""
        return self.sightings[-1].position if self.sightings else self.begin

    @property
    def offsets(self) -> tuple[GroundVector, ...]:
        """Each new position relative to the beginning."""
        return tuple(sighting.position.minus(self.begin) for sighting in self.sightings)


class _Recording:
    """The new positions of a hold, as poses are seen."""

    def __init__(self, begin: GroundVector, at: float) -> None:
        self.latest, self._since = begin, at
        self.sightings: list[Sighting] = []

    def add(self, pose: PoseEstimate) -> None:
        """Take in a pose; one at another position than the last counts as a sighting."""
        if pose.position != self.latest:
            self.sightings.append(Sighting(self._since, pose.at, pose.position))
        self.latest, self._since = pose.position, pose.at


class Walker:
    """Walks by holding keys, watching the debug screen. Positions are relative to the pose that it is made at.

    Raises (everything): UnreadableError if the screen can't be read for the profile's patience; NotConfirmedError if
    the player is turned, rises, sinks or doesn't come to a stop; what the input controller raises.
    """

    def __init__(self, connection: GameConnection, profile: Profile) -> None:
        _, begin, _ = PoseReader(connection, profile.body.patience_s).read()
        self._controller, self._journal = connection.controller, connection.journal
        self._clock = connection.devices.clock
        self._observer = PoseObserver(profile, connection, PoseFrame.around(begin))
        self._key_hold = KeyHold(connection, self._observer, profile.body.patience_s)
        self._rest: GroundVector | None = None

    def position(self) -> GroundVector:
        """Return where the player is now."""
        return self._look().position

    def stand(self) -> GroundVector:
        """Wait until the player stands still; return the position then. No wait is needed where the last one ended."""
        pose = self._look()
        if pose.position == self._rest:
            return pose.position
        standstill = Standstill(pose.position, self._clock.now(), CAREFUL_SETTLE_S, CAREFUL_SETTLE_S)
        return self._follow(pose, standstill, _Recording(pose.position, pose.at))

    def hold(
        self,
        seconds: float,
        key: str,
        *,
        sneak: str | None = None,
        phase: float | None = None,
        max_distance: float = math.inf,
    ) -> RecordedHold:
        """Hold a key of the world from rest, and follow the walker until standstill.

        Args:
            seconds: how long.
            key: which.
            sneak: the sneak key, which goes down first; None walks.
            phase: a time of the clock; the key goes down a whole number of ticks after it. None presses at once.
            max_distance: blocks from the beginning at which the keys go up early.
        """
        begin = self.stand()
        self._journal.note("plans", key=key, ticks=max(1, round(seconds / TICK_S)), sneak=sneak is not None)
        self._observer.permit_press()
        if sneak:
            self._key_hold.begin_sneaking(sneak)
        if phase is not None:
            look_s = self._controller.look_s
            from_now = (phase - self._clock.now() - look_s) % TICK_S
            self._controller.wait_until(self._clock.now() + from_now)
        pressed = self._clock.now()
        recording = _Recording(begin, pressed)

        def release_if_far() -> float | None:
            pose = self._look()
            recording.add(pose)
            is_far = math.hypot(*pose.position.minus(begin)) >= max_distance
            return self._clock.now() if is_far else None

        look_times = iter(lambda: self._clock.now() + HALF_FRAME_S, None)
        self._key_hold.hold(pressed + seconds, key, sneak=sneak, look_times=look_times, on_look=release_if_far)
        # The look before a press takes a moment.
        pressed, released = self._key_hold.pressed_at, self._clock.now()
        self._follow(self._look(), Standstill(recording.latest, released, CAREFUL_SETTLE_S), recording)
        return RecordedHold(pressed, released, begin, tuple(recording.sightings))

    def _follow(self, pose: PoseEstimate, standstill: Standstill, recording: _Recording) -> GroundVector:
        """Record the walker, with its keys up, until standstill; return where it stands."""

        def is_over(latest: PoseEstimate) -> bool:
            # Waits this short don't check whether the window is still in front.
            self._controller.check_front()
            recording.add(latest)
            return standstill.is_reached(latest.position, latest.at)

        self._rest = self._key_hold.follow(pose, is_over, EVERY_LOOK, HALF_FRAME_S).position
        return self._rest

    def _look(self) -> PoseEstimate:
        # Waits this short don't check whether the window is still in front.
        self._controller.check_front()
        return self._observer.look_and_check()
