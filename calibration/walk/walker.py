"""A walker: holds keys for so long from rest, and notes every place that is seen until standstill."""

import math
from dataclasses import dataclass
from itertools import pairwise

from calibration.step import Bench
from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.coordinates import turn_between
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.profile import Profile
from mc_nested.live.walk import TICK_S

LOOK_S = 0.008
"""Seconds between two looks: two a frame, so that each step is seen within a frame of being drawn."""

SETTLE_S, STALL_S = 0.25, 1.0
"""Seconds of the same place, five ticks, after which the walker stands; and after which so does one who wasn't seen to
move, or whose picture stalled on the way: a busy machine shows nothing for a while, too."""

GAPS = 3
"""So many times the longest time from one new place to the next is waited for another one."""

RUNAWAY_S = 0.3
"""Seconds after which a walker whose keys are up, and who still goes on, has them released once more."""

RISE = 0.05
"""Blocks that the feet may rise or sink: a level floor has no step, and nobody flies."""

TURN = 0.5
"""Degrees that the view may turn: the debug screen shows tenths."""

ARRIVED = 0.01
"""Blocks that somebody may be off where a command has put them."""

XYZ = tuple[float, float, float]


@dataclass(frozen=True)
class Pose:
    """Where the feet are, in blocks, and where the eyes look, in degrees."""

    xyz: XYZ
    yaw: float
    pitch: float


@dataclass(frozen=True)
class Sighting:
    """A place that was first seen ``at``, and not yet at the look before, at ``since``."""

    since: float
    at: float
    xyz: XYZ


@dataclass(frozen=True)
class Walked:
    """A hold: when its keys went down and up, where it began, and each new place until standstill, in order."""

    pressed: float
    released: float
    begin: Pose
    sightings: tuple[Sighting, ...]

    @property
    def end(self) -> XYZ:
        """Where the walker stands after it."""
        return self.sightings[-1].xyz if self.sightings else self.begin.xyz

    @property
    def places(self) -> tuple[tuple[float, float], ...]:
        """Each new place as blocks (right, forward) of the beginning, as the walker looks."""
        return tuple(seen_from(self.begin, sighting.xyz) for sighting in self.sightings)


class Walker:
    """Walks by holding keys, watching the debug screen.

    Raises (everything): UnreadableError where that can't be read for the profile's patience; NotConfirmedError where
    the player is pushed, turned, rises, sinks or doesn't come to a stop; what the hands raise.
    """

    def __init__(self, bench: Bench, profile: Profile, screen: GameScreen) -> None:
        self._hands = bench.hands
        self._clock = bench.desktop.clock
        self._patience_s = profile.body.patience_s
        self._screen = screen
        self._rest: XYZ | None = None

    def look(self) -> Pose:
        """Where the player is seen; waits while the debug screen can't be read."""
        return self._look()[1]

    def stand(self) -> Pose:
        """Wait until the player stands still; where that is. Where the last wait ended nothing has to be waited for."""
        pose = self.look()
        return pose if pose.xyz == self._rest else self._settled(pose, [], self._clock.now())

    def arrives(self, pose: Pose) -> bool:
        """Wait until the player is seen there, as after a teleport; False where that isn't seen within the patience."""
        until = self._clock.now() + self._patience_s
        while not _is_at(pose, self.look()):
            if self._clock.now() >= until:
                return False
            self._hands.wait(LOOK_S)
        return True

    def hold(self, seconds: float, *keys: str, phase: float | None = None, farthest: float = math.inf) -> Walked:
        """Hold keys of the world from rest, and follow the walker until standstill.

        Args:
            seconds: how long.
            keys: which, together.
            phase: seconds of the clock, any tick of which the keys go down at; without it, at once.
            farthest: blocks from the beginning at which the keys go up before that.
        """
        begin = self.stand()
        if self._screen.is_chat_open():
            raise NotConfirmedError("the chat is open: leave mouse and keys alone while this walks")
        self._hands.saw("world")
        if phase is not None:
            from_now = (phase - self._clock.now()) % TICK_S
            self._hands.wait_until(self._clock.now() + from_now)
        pressed = self._clock.now()
        released = pressed + seconds
        seen: list[Sighting] = []
        try:
            self._hands.press(released, *keys)
            released = self._follow(begin, seen, pressed, released, keys, farthest)
        except BaseException:
            self._hands.release_all()
            raise
        return Walked(pressed, released, begin, tuple(seen))

    def _follow(
        self, begin: Pose, seen: list[Sighting], since: float, released: float, keys: tuple[str, ...], farthest: float
    ) -> float:
        """Follow the walker while the keys are down, and until standstill; when they went up."""
        while self._clock.now() < released:
            # A look takes a while: the last of them must not make the release late.
            soon = self._clock.now() + LOOK_S
            self._hands.wait_until(soon if soon + LOOK_S < released else released)
            if self._clock.now() >= released:
                break
            since = self._note(begin, seen, since)
            if seen and math.dist(seen[-1].xyz, begin.xyz) >= farthest:
                released = self._clock.now()
                self._hands.keep_until(released, *keys)
        self._hands.wait_until(released)
        released = self._clock.now()
        self._settled(begin, seen, since, is_held=True)
        return released

    def _settled(self, begin: Pose, seen: list[Sighting], since: float, *, is_held: bool = False) -> Pose:
        """Follow the walker, whose keys are up, ``is_held`` until just now, to a standstill."""
        began = self._clock.now()
        until, again = began + self._patience_s, began + RUNAWAY_S
        while True:
            now = self._clock.now()
            last = max(began, seen[-1].at) if seen else began
            if now - last >= (_settle_s(seen) if is_held else SETTLE_S):
                self._rest = seen[-1].xyz if seen else begin.xyz
                return Pose(self._rest, begin.yaw, begin.pitch)
            if now >= until:
                raise NotConfirmedError("you don't come to a stop: does something push you, or is a key held down?")
            if now >= again:
                self._hands.release_again()
                again = now + RUNAWAY_S
            self._hands.wait(LOOK_S)
            since = self._note(begin, seen, since)

    def _look(self) -> tuple[float, Pose]:
        """When a picture was taken that can be read, and what it says."""
        until = self._clock.now() + self._patience_s
        while True:
            at = self._clock.now()
            reading = self._screen.read()
            if reading.xyz is not None and reading.yaw is not None and reading.pitch is not None:
                return at, Pose(reading.xyz, reading.yaw, reading.pitch)
            # What covers the game can't be read, but it is why.
            self._hands.check_front()
            if self._clock.now() >= until:
                raise UnreadableError(
                    f"the debug screen was unreadable for {self._patience_s:g} s: {reading.problem or 'no Facing line'}"
                )
            self._hands.wait(LOOK_S)

    def _note(self, begin: Pose, seen: list[Sighting], since: float) -> float:
        """Look, and note a place that is new; when that was."""
        # Waits this short don't look whether the window is still in front.
        self._hands.check_front()
        at, pose = self._look()
        if abs(pose.xyz[1] - begin.xyz[1]) > RISE:
            raise NotConfirmedError(
                f"your feet went from y = {begin.xyz[1]:g} to {pose.xyz[1]:g}: stand on a level floor, don't fly, and "
                "turn auto-jump off"
            )
        if turn_between(pose.yaw, begin.yaw) > TURN or abs(pose.pitch - begin.pitch) > TURN:
            raise NotConfirmedError("your view has turned: leave mouse and keys alone while this walks")
        if pose.xyz != (seen[-1].xyz if seen else begin.xyz):
            seen.append(Sighting(since, at, pose.xyz))
        return at


def _settle_s(seen: list[Sighting]) -> float:
    if len(seen) < 2:
        return STALL_S
    longest = max(after.at - before.at for before, after in pairwise(seen))
    return min(STALL_S, max(SETTLE_S, GAPS * longest))


def _is_at(pose: Pose, seen: Pose) -> bool:
    off = max(map(abs, seen_from(pose, seen.xyz)))
    return off <= ARRIVED and turn_between(pose.yaw, seen.yaw) <= TURN and abs(pose.pitch - seen.pitch) <= TURN


def seen_from(pose: Pose, xyz: XYZ) -> tuple[float, float]:
    """Blocks (right, forward) from a pose to a place. Yaw 0 is south, 90 west (FACTS: Standing, looking, placing)."""
    sine, cosine = math.sin(math.radians(pose.yaw)), math.cos(math.radians(pose.yaw))
    east, south = xyz[0] - pose.xyz[0], xyz[2] - pose.xyz[2]
    return -east * cosine - south * sine, -east * sine + south * cosine
