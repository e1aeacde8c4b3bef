"""PoseObserver reads the agent's position, the block it looks at and the game's tick phase from the debug screen.

Every press needs a look first: only what was just seen permits a press. Nothing is pressed while the view or the height
is not the expected one. PoseReader is the part of it that calibration shares: the next pose that can be read.

TickPhase estimates when the game's ticks come. A step is seen some time after its tick: the game draws a frame, the
desktop shows it, and only then does a look see it. So one observation says little. But ticks come every 50 ms, and the
mean of many observations modulo 50 ms lies a fixed time behind them.
"""

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass, field

from mc_nested.arena.action import Cell
from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Deadline
from mc_nested.live.model.coordinates import GroundVector, cell_at, offset_from, turn_between
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.reading import XYZ, Target, WorldPose, facts_of
from mc_nested.live.model.timing import CAPTURE_LATENCY_S, EARLY_LOOK_S, FRAME_S, HALF_FRAME_S, SAME_FRAME_S
from mc_nested.live.profile.tables import Profile


class PoseReader:
    """Reads poses from the debug screen; waits while it can't be read.

    Raises (every read): UnreadableError if that takes longer than ``patience_s``; what the input controller raises.
    """

    def __init__(self, connection: GameConnection, patience_s: float) -> None:
        self._controller = connection.controller
        self._screen = connection.screen
        self._clock = connection.devices.clock
        self._journal = connection.journal
        self._patience_s = patience_s
        self.is_delayed = False
        """Whether the last pose was read only after frames that couldn't be read."""

    def read(self) -> tuple[float, WorldPose, Target | None]:
        """Return when a readable picture was taken, the pose on it, and the block looked at."""
        self.is_delayed = False
        patience = Deadline(self._clock, self._patience_s)
        while True:
            at = self._clock.now()
            reading = self._screen.read()
            self._journal.note("reads", **facts_of(reading))
            if reading.xyz is not None and reading.yaw is not None and reading.pitch is not None:
                return at, WorldPose(reading.xyz, reading.yaw, reading.pitch), reading.target
            self.is_delayed = True
            # A window in front of the game can't be read, but it is the reason.
            self._controller.check_front()
            if patience.has_passed:
                reason = reading.problem or "it shows no Facing line"
                raise UnreadableError(f"the debug screen was unreadable for {self._patience_s:g} s: {reason}")
            self._controller.wait(FRAME_S)


DECAY = 0.9
"""The weight that earlier observations keep with each new one: about the last ten count."""

MIN_AGREEMENT = 0.35
"""How much observations must agree, of 1: those of a game without ticks reach 0.23, those of one with ticks 0.5."""

ENOUGH = 6.0
"""Weight of observations that the estimate needs; older ones weigh less."""


class TickPhase:
    """The times at which ticks come, in seconds of the clock that the observations are given in.

    Args:
        capture_latency_s: from a tick until its step is on the screen, on average.
    """

    def __init__(self, capture_latency_s: float = CAPTURE_LATENCY_S) -> None:
        self._capture_latency_s = capture_latency_s
        self._sum = 0j
        self._weight = 0.0

    @property
    def state(self) -> tuple[float, float, float]:
        """The observations so far, to go on from: the sum of directions, and their weight."""
        return self._sum.real, self._sum.imag, self._weight

    def go_on_from(self, state: tuple[float, float, float]) -> None:
        """Take the estimate that had this state."""
        real, imaginary, self._weight = state
        self._sum = complex(real, imaginary)

    def saw_step(self, since: float, at: float) -> None:
        """Take in that a step was first seen by the look ``at``, and not yet by the one before, at ``since``."""
        tick = (since + at) / 2 - self._capture_latency_s
        self._sum = DECAY * self._sum + cmath.exp(2j * math.pi * tick / TICK_S)
        self._weight = DECAY * self._weight + 1.0

    @property
    def is_known(self) -> bool:
        """Whether there are enough observations and they agree."""
        return self._weight >= ENOUGH and abs(self._sum) >= MIN_AGREEMENT * self._weight

    def next(self, after: float, offset: float = 0.0) -> float:
        """Return the first time from ``after`` on that is ``offset`` seconds behind a tick."""
        first = cmath.phase(self._sum) / (2 * math.pi) * TICK_S + offset
        return after + (first - after) % TICK_S


VIEW_TOLERANCE = 0.5
"""Degrees that the view may be off: the debug screen shows tenths (FACTS: The F3 debug screen)."""

HEIGHT_TOLERANCE = 0.05
"""Blocks that the feet may be above or below the floor: standing on a full block there is no difference."""


@dataclass(frozen=True)
class PoseEstimate:
    """A reading in a frame's coordinates: the position, what is wrong with the pose, the block looked at, and when."""

    position: GroundVector
    problem: str | None
    target: Target | None
    at: float = field(default=0.0, compare=False)

    @property
    def cell(self) -> Cell:
        """The cell that holds the position, in the arena's frame."""
        return cell_at(self.position)

    def __str__(self) -> str:
        return f"({self.position.right:.2f}, {self.position.forward:.2f})"


@dataclass(frozen=True)
class PoseFrame:
    """The frame that poses are measured in: ground coordinates, and the view and height of the feet expected there."""

    position_of: Callable[[XYZ], GroundVector]
    yaw: float
    pitch: float
    height: float

    @classmethod
    def of_arena(cls, profile: Profile) -> "PoseFrame":
        """Return the arena's cells; raise ProfileError if none is marked."""
        arena = profile.marked_arena()
        return cls(arena.position_of, arena.yaw, profile.body.pitch, arena.origin[1])

    @classmethod
    def around(cls, pose: WorldPose) -> "PoseFrame":
        """Return a frame that counts blocks right and forward of a pose."""
        return cls(lambda xyz: offset_from(pose, xyz), pose.yaw, pose.pitch, pose.xyz[1])

    def problem(self, pose: WorldPose) -> str | None:
        """Return what is wrong with a pose, in words; None if nothing is."""
        if turn_between(pose.yaw, self.yaw) > VIEW_TOLERANCE or abs(pose.pitch - self.pitch) > VIEW_TOLERANCE:
            return f"the view is {pose.yaw:g} / {pose.pitch:g}, not {self.yaw:g} / {self.pitch:g}"
        if abs(pose.xyz[1] - self.height) > HEIGHT_TOLERANCE:
            return f"the feet are at y = {pose.xyz[1]:g}, not {self.height:g} (the floor must be level, auto-jump off)"
        return None


class PoseObserver:
    """Looks at the game, and notes when steps are first seen.

    Raises (every look): UnreadableError if the debug screen can't be read for the profile's patience; what the input
    controller raises. A checked look: NotConfirmedError if the view or the height isn't the frame's.
    """

    def __init__(self, profile: Profile, connection: GameConnection, frame: PoseFrame) -> None:
        self._frame = frame
        self._reader = PoseReader(connection, profile.body.patience_s)
        self._controller = connection.controller
        self._screen = connection.screen
        self._clock = connection.devices.clock
        self._timed_look = 0.0
        self._last: PoseEstimate | None = None
        self._capture_latency_s = profile.walk.capture_latency_s
        self.tick_phase = TickPhase(profile.walk.capture_latency_s)

    def forget(self) -> None:
        """Take no pose that was seen before for one that is seen now."""
        self._last = None

    def look(self) -> PoseEstimate:
        """Look now, or as soon as the screen can be read, and return what is seen."""
        if self._last is not None and self._clock.now() - self._last.at < SAME_FRAME_S:
            return self._last
        at, world_pose, target = self._reader.read()
        position = self._frame.position_of(world_pose.xyz)
        pose = PoseEstimate(position, self._frame.problem(world_pose), target, at)
        last, self._last = self._last, pose
        if last is not None and not self._reader.is_delayed and pose != last and at - last.at < 1.5 * FRAME_S:
            self.tick_phase.saw_step(last.at, at)
        return pose

    def look_and_check(self) -> PoseEstimate:
        """Look as ``look`` does, and check that the view and the height are the frame's."""
        return check_pose(self.look())

    def watch(self, is_done: Callable[[PoseEstimate], bool], seconds: float) -> PoseEstimate:
        """Look until ``is_done`` or for so many seconds, and return the last pose in both cases."""
        deadline = Deadline(self._clock, seconds)
        while not is_done(pose := self.look()) and not deadline.has_passed:
            self._controller.wait(HALF_FRAME_S)
        return pose

    def read_position(self) -> GroundVector | None:
        """Return the agent's position, in one quick look, while a key is down; None if it can't be read."""
        xyz = self._screen.read_position()
        return self._frame.position_of(xyz) if xyz else None

    def permit_press(self, is_right: Callable[[PoseEstimate], bool] = lambda _: True) -> None:
        """Permit the next press into the world, if that is seen then; the debug screen must just have been read.

        If the look is too old when the press comes, another one is taken: it must be as good, and ``is_right``.
        """
        self._controller.confirm_screen("world", lambda: self._look_again(is_right))

    def _look_again(self, is_right: Callable[[PoseEstimate], bool]) -> None:
        if not is_right(pose := self.look_and_check()):
            raise NotConfirmedError(
                f"the agent is at {pose} now, where this must not be pressed: does something push it?"
            )
        self.permit_press(is_right)

    def wait_for_step(self, tick: float) -> None:
        """Wait until the step of a tick may be seen (FACTS: Latencies)."""
        self._controller.wait_until(tick + self._capture_latency_s - EARLY_LOOK_S)
        self._timed_look = self._clock.now()

    def note_awaited_step(self) -> None:
        """If the awaited step was seen by the first look, count it as not seen a frame before.

        Otherwise only steps that are seen late would count.
        """
        if self._last is not None and self._last.at == self._timed_look:
            self.tick_phase.saw_step(self._timed_look - FRAME_S, self._timed_look)


def check_pose(pose: PoseEstimate) -> PoseEstimate:
    """Return the pose; raise NotConfirmedError if something is wrong with it."""
    if pose.problem is not None:
        raise NotConfirmedError(f"{pose.problem}: leave mouse and keys alone")
    return pose
