"""PoseReader: the next pose that can be read from the debug screen."""

from mc_nested.errors import UnreadableError
from mc_nested.live.connection import GameConnection
from mc_nested.live.deadline import Deadline
from mc_nested.live.model.reading import Target, WorldPose, facts_of
from mc_nested.live.model.timing import FRAME_S


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
        """When a readable picture was taken, the pose on it, and the block looked at."""
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
