"""PoseObserver: the agent's position and the block it looks at, read from the debug screen, and the game's tick phase.

Every press needs a look first: only what was just seen permits a press. Nothing is pressed while the view or the height
is not the expected one.
"""

from collections.abc import Callable
from dataclasses import dataclass, field

from mc_nested.arena.action import Cell
from mc_nested.errors import NotConfirmedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.deadline import Deadline
from mc_nested.live.model.coordinates import GroundVector, cell_at, offset_from, turn_between
from mc_nested.live.model.reading import XYZ, Target, WorldPose
from mc_nested.live.model.timing import EARLY_LOOK_S, FRAME_S, HALF_FRAME_S, SAME_FRAME_S
from mc_nested.live.motion.pose_reader import PoseReader
from mc_nested.live.motion.tick_phase import TickPhase
from mc_nested.live.profile.tables import Profile

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
    """What poses are measured in: coordinates on the ground, and the view and the height of the feet expected there."""

    position_of: Callable[[XYZ], GroundVector]
    yaw: float
    pitch: float
    height: float

    @classmethod
    def of_arena(cls, profile: Profile) -> "PoseFrame":
        """The arena's cells; ProfileError if none is marked."""
        arena = profile.marked_arena()
        return cls(arena.position_of, arena.yaw, profile.body.pitch, arena.origin[1])

    @classmethod
    def around(cls, pose: WorldPose) -> "PoseFrame":
        """Blocks right and forward of a pose."""
        return cls(lambda xyz: offset_from(pose, xyz), pose.yaw, pose.pitch, pose.xyz[1])

    def problem(self, pose: WorldPose) -> str | None:
        """What is wrong with a pose, in words; None if nothing is."""
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
        """What is seen now, or as soon as the screen can be read."""
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
        """The same, and the view and the height are the frame's."""
        return check_pose(self.look())

    def watch(self, is_done: Callable[[PoseEstimate], bool], seconds: float) -> PoseEstimate:
        """Look until ``is_done`` or for so many seconds; the last pose in both cases."""
        deadline = Deadline(self._clock, seconds)
        while not is_done(pose := self.look()) and not deadline.has_passed:
            self._controller.wait(HALF_FRAME_S)
        return pose

    def read_position(self) -> GroundVector | None:
        """The agent's position, in one quick look, while a key is down; None if it can't be read."""
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
    """The pose; NotConfirmedError if something is wrong with it."""
    if pose.problem is not None:
        raise NotConfirmedError(f"{pose.problem}: leave mouse and keys alone")
    return pose
