"""PoseObserver: the agent's position and the block it looks at, read from the debug screen, and the game's tick phase.

Every press needs a look first: only what was just seen permits a press. Nothing is pressed while the view is not the
arena's, or while the chat is open.
"""

from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.arena.rules import Cell
from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.deadline import Deadline
from mc_nested.live.model.coordinates import GroundVector, cell_at, turn_between
from mc_nested.live.model.reading import Target
from mc_nested.live.motion.tick_phase import TickPhase
from mc_nested.live.profile.tables import Profile

FRAME_S = 1 / 60
"""Seconds between two looks at the screen: a frame of the game, so that no wait is much longer than it must be."""

SAME_FRAME_S = 0.005
"""Seconds after a look in which another one would see the same frame."""

LIKELY_SEEN_S = 0.028
"""Seconds after a tick at which looks for its step begin: a frame and a picture take 10 to 47 ms."""

VIEW_TOLERANCE = 0.5
"""Degrees that the view may be off: the debug screen shows tenths (FACTS: The F3 debug screen)."""

HEIGHT_TOLERANCE = 0.05
"""Blocks that the feet may be above or below the arena's floor: standing on a full block there is no difference."""


@dataclass(frozen=True)
class PoseEstimate:
    """A reading in the arena's coordinates: the position in cells, what is wrong with the pose, the block looked at."""

    position: GroundVector
    problem: str | None
    target: Target | None

    @property
    def cell(self) -> Cell:
        """The cell that holds the position."""
        return cell_at(self.position)

    def __str__(self) -> str:
        return f"({self.position.right:.2f}, {self.position.forward:.2f})"


class PoseObserver:
    """Looks at the game, and notes when steps are first seen.

    Raises (every look): UnreadableError if the debug screen can't be read for the profile's patience; what the input
    controller raises. A checked look: NotConfirmedError if the view or the height isn't the arena's.
    """

    def __init__(self, profile: Profile, connection: GameConnection) -> None:
        self._arena = profile.marked_arena()
        self._limits = profile.body
        self._controller = connection.controller
        self._screen = connection.screen
        self._clock = connection.devices.clock
        self._timed_look = 0.0
        self._last_look: tuple[float, PoseEstimate] | None = None
        self.tick_phase = TickPhase(profile.walk.capture_latency_s)

    def look(self) -> PoseEstimate:
        """What is seen now, or as soon as the screen can be read."""
        patience = Deadline(self._clock, self._limits.patience_s)
        while True:
            now = self._clock.now()
            if self._last_look is not None and now - self._last_look[0] < SAME_FRAME_S:
                return self._last_look[1]
            reading = self._screen.read()
            if reading.xyz is not None and reading.yaw is not None and reading.pitch is not None:
                problem = self._problem(reading.xyz[1], reading.yaw, reading.pitch)
                pose = PoseEstimate(self._arena.position_of(reading.xyz), problem, reading.target)
                self._record(now, pose)
                return pose
            self._last_look = None
            # A window in front of the game can't be read, but it is the reason.
            self._controller.check_front()
            if patience.has_passed:
                reason = reading.problem or "it shows no Facing line"
                raise UnreadableError(f"the debug screen was unreadable for {self._limits.patience_s:g} s: {reason}")
            self._controller.wait(FRAME_S)

    def look_and_check(self) -> PoseEstimate:
        """The same, and the view and the height are the arena's."""
        return check_pose(self.look())

    def watch(self, is_done: Callable[[PoseEstimate], bool], seconds: float) -> PoseEstimate:
        """Look until ``is_done`` or for so many seconds; the last pose in both cases."""
        deadline = Deadline(self._clock, seconds)
        while not is_done(pose := self.look()) and not deadline.has_passed:
            self._controller.wait(FRAME_S)
        return pose

    def read_position(self) -> GroundVector | None:
        """The agent's position, in one quick look, while a key is down; None if it can't be read."""
        xyz = self._screen.read_position()
        return self._arena.position_of(xyz) if xyz else None

    def permit_press(self) -> None:
        """Check that the next press goes into the world, and permit it; the debug screen must just have been read."""
        if self._screen.is_chat_open():
            raise NotConfirmedError("the chat is open: leave mouse and keys alone while the agent plays")
        self._controller.confirm_screen("world")

    def wait_for_step(self, tick: float) -> None:
        """Wait until the step of a tick is likely to be seen."""
        self._controller.wait_until(tick + LIKELY_SEEN_S)
        self._timed_look = self._clock.now()

    def note_awaited_step(self) -> None:
        """If the awaited step was seen by the first look, count it as not seen a frame before.

        Otherwise only steps that are seen late would count.
        """
        if self._last_look is not None and self._last_look[0] == self._timed_look:
            self.tick_phase.saw_step(self._timed_look - FRAME_S, self._timed_look)

    def _record(self, now: float, pose: PoseEstimate) -> None:
        if self._last_look is not None and pose != self._last_look[1] and now - self._last_look[0] < 1.5 * FRAME_S:
            self.tick_phase.saw_step(self._last_look[0], now)
        self._last_look = now, pose

    def _problem(self, height: float, yaw: float, pitch: float) -> str | None:
        if turn_between(yaw, self._arena.yaw) > VIEW_TOLERANCE or abs(pitch - self._limits.pitch) > VIEW_TOLERANCE:
            return f"the agent looks {yaw:g} / {pitch:g}, not {self._arena.yaw:g} / {self._limits.pitch:g}"
        if abs(height - self._arena.origin[1]) > HEIGHT_TOLERANCE:
            return f"its feet are at y = {height:g}, not {self._arena.origin[1]}"
        return None


def check_pose(pose: PoseEstimate) -> PoseEstimate:
    """The pose; NotConfirmedError if something is wrong with it."""
    if pose.problem is not None:
        raise NotConfirmedError(f"{pose.problem}: leave mouse and keys alone while the agent plays")
    return pose
