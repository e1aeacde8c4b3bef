"""Person: follows a player who has taken over, and says what they do as the agent's actions, from the screen alone.

look: where they are, and what they look at -> a block that wasn't there, or a few cells walked -> the actions for it

The last moves are held back: a block may follow, and then the last of them is the one that placed it. Nothing is
pressed here.
"""

from collections import deque
from collections.abc import Mapping

from mc_nested.arena.action import Cell
from mc_nested.arena.game import Outcome
from mc_nested.arena.rules import is_inside
from mc_nested.errors import LiveError, TakenOverError
from mc_nested.live.connection import GameConnection
from mc_nested.live.input.stops import Takeover
from mc_nested.live.model.coordinates import cell_at
from mc_nested.live.model.person_moves import broken, new_block, outcomes_of, placed_from
from mc_nested.live.model.reading import Block, Reading, Target, WorldPose
from mc_nested.live.model.timing import FRAME_S
from mc_nested.live.motion.pose_observer import PoseFrame
from mc_nested.live.profile.tables import Profile

STILL_S = 0.25
"""Seconds without a change after which a player stands still, and looks at what the screen names (five ticks)."""

STOPPED = "the run was stopped while the player had the game"

MOST_HELD = 2
"""Moves that are held back: the screen may show a block when its player has gone on from there."""


class Person:
    """A player who may take over, and what was seen of them that wasn't said yet.

    Args:
        profile: where the arena is.
        connection: the running game.
        size: the number of cells along each side of the scenario's arena.
        takeover: how the run lets them.
    """

    def __init__(self, profile: Profile, connection: GameConnection, size: int, takeover: Takeover) -> None:
        self._arena, self._size = profile.marked_arena(), size
        self._frame = PoseFrame.of_arena(profile)
        self._must_look_ahead = profile.world is not None
        self._key = profile.keys.takeover
        self._screen, self._display = connection.screen, connection.devices.display
        self._clock, self._controller = connection.devices.clock, connection.controller
        self._journal = connection.journal
        self._takeover, self._said = takeover, ""
        self.forget()

    def forget(self) -> None:
        """Take the agent to play from here on."""
        self.is_followed = False
        """Whether a player has had the game since then."""
        self._walk: list[Cell] = []
        self._ahead: deque[Outcome] = deque()
        self._pose: WorldPose | None = None
        self._since = 0.0
        self._looked_at: Target | None = None

    def follow(self, cell: Cell, built: Mapping[Cell, str], shown_id: str) -> Outcome | None:
        """Wait for the player's next whole action; return None once the game is given back, and nothing is left.

        ``cell`` is where the last action ended, ``built`` the cells that hold a block, with its id, and ``shown_id``
        the id of the block in hand. Raise LiveError if the player did what no action does, or the run stops.
        """
        self.is_followed = True
        if not self._ahead and self._controller.has_yielded:
            self._journal.note("follows")
            self._walk = self._walk or [cell]
            self._say_once(f"You play now: give back with {self._key}.")
            while not self._ahead and self._controller.has_yielded:
                self.check_running()
                self._look(built, shown_id)
                self._clock.sleep_until(self._clock.now() + FRAME_S)
        return self._ahead.popleft() if self._ahead else None

    def check_running(self) -> None:
        """Raise StoppedError after a panic, TakenOverError where the run shall stop."""
        self._controller.check_stopped()
        if self._takeover.is_stopped():
            raise TakenOverError(STOPPED)

    def _look(self, built: Mapping[Cell, str], shown_id: str) -> None:
        """Take in what is seen now. What can't be read, as behind a menu, is the player's own business."""
        reading = self._screen.read() if self._display.is_in_front() else Reading()
        if reading.xyz is None or reading.yaw is None or reading.pitch is None:
            self._pose = None
            return
        pose, target = WorldPose(reading.xyz, reading.yaw, reading.pitch), reading.target
        is_still = self._is_still(pose, target, built)
        cell = cell_at(self._arena.position_of(pose.xyz))
        if not is_inside(cell, self._size):
            self._say_once(f"You have left the arena: come back, or give back with {self._key}.")
            if is_still and self._controller.take_back():
                raise LiveError("the game was given back outside the arena")
            return
        if cell != self._walk[-1]:
            self._walk.append(cell)
        block = None
        if target and target.pos and target.id:
            block = new_block(*self._cell_of(target.pos), target.id, built, shown_id, self._size)
        if block:
            self._tell(placed_from(self._walk, block), block, built)
        elif len(self._walk) > MOST_HELD + 1:
            self._tell(1, None, built)
        elif is_still and self._looks_right(pose) and self._controller.take_back():
            self._tell(len(self._walk) - 1, None, built)
            self._walk = []
            self._say_once("The agent plays again.")

    def _tell(self, place: int, block: Cell | None, built: Mapping[Cell, str]) -> None:
        """Tell the walk up to a place in it, and a block that was placed there."""
        self._ahead.extend(outcomes_of(self._walk[: place + 1], block, built, self._size))
        self._walk = self._walk[place:]

    def _is_still(self, pose: WorldPose, target: Target | None, built: Mapping[Cell, str]) -> bool:
        """Return whether the player stands still; raise LiveError if a block is gone that they looked at then."""
        if pose != self._pose:
            self._pose, self._since, self._looked_at = pose, self._clock.now(), None
        if self._clock.now() - self._since < STILL_S:
            return False
        before, self._looked_at = self._looked_at, target
        if before and before.pos and target != before:
            cell, level = self._cell_of(before.pos)
            if cell in built and level == 0:
                raise LiveError(broken(cell))
        return True

    def _cell_of(self, block: Block) -> tuple[Cell, int]:
        """Return the cell that a block is in, and how many blocks above the floor's top it lies."""
        x, y, z = block
        return cell_at(self._arena.position_of((x + 0.5, y, z + 0.5))), y - self._arena.origin[1]

    def _looks_right(self, pose: WorldPose) -> bool:
        """Return whether the agent can go on from there; without cheats, only the player can turn the view back."""
        problem = self._frame.problem(pose) if self._must_look_ahead else None
        if problem is not None:
            self._say_once(f"Before the agent can go on: {problem}.")
        return problem is None

    def _say_once(self, line: str) -> None:
        if line != self._said:
            self._takeover.say(line)
        self._said = line
