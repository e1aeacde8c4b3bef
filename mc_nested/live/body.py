"""Body: one cell, one block, each confirmed on the debug screen before it counts.

move:  look where the agent is -> hold the key that ends nearest -> wait for standstill -> look again
place: look at the floor ahead -> click -> wait until the debug screen names the new block there
"""

from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.arena.rules import Cell, front_of
from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.coordinates import cell_at, turn_between
from mc_nested.live.devices import Clock
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.reading import Block, Reading, Target
from mc_nested.live.standstill import Standstill
from mc_nested.live.walk import nearest_ticks

POLL_S = 0.01
"""Seconds between two looks at the screen: far below a tick, so that no wait is longer than it must be."""

TURN = 0.5
"""Degrees that the view may be off: the debug screen shows tenths (FACTS: The F3 debug screen)."""

RISE = 0.05
"""Blocks that the feet may be above or below the arena's floor: standing on a full block there is no difference."""

FAR = 2.0
"""Blocks: whoever is so far from a neighbouring cell did not get there by walking to it."""

Read = Callable[[], Reading]
"""Take a picture of the debug screen and read it, now."""


@dataclass(frozen=True)
class Stance:
    """A reading seen from the arena: the place in cells as (right, forward), and what is wrong with the stance."""

    place: tuple[float, float]
    trouble: str | None
    target: Target | None

    @property
    def cell(self) -> Cell:
        """The cell that holds the place."""
        return cell_at(self.place)

    def offset_to(self, cell: Cell) -> tuple[float, float]:
        """Blocks to walk to the cell's middle, as (right, forward)."""
        return cell[0] - self.place[0], cell[1] - self.place[1]

    def __str__(self) -> str:
        return f"({self.place[0]:.2f}, {self.place[1]:.2f})"


class Body:
    """Moves the agent from cell to cell and places blocks, closed over what the debug screen says.

    Raises (everything): UnreadableError where the debug screen can't be read for the profile's patience;
    NotConfirmedError where what was asked is not seen in the profile's tries; NotInFrontError from the hands.
    """

    def __init__(self, profile: Profile, hands: Hands, read: Read, clock: Clock) -> None:
        self._arena = profile.marked_arena()
        self._keys = profile.keys
        self._limits = profile.body
        self._covered = profile.walk.covered
        self._hands = hands
        self._read = read
        self._clock = clock

    def check_screen(self) -> None:
        """See that the debug screen can be read at all; presses nothing."""
        self._look()

    def stay_in(self, cell: Cell) -> Cell:
        """See that the agent still is in a cell, and return the cell seen; presses nothing."""
        stance = self._look_straight()
        if stance.cell != cell:
            raise NotConfirmedError(f"the agent left cell {cell} by itself, it is at {stance}: does something push it?")
        return stance.cell

    def arrive(self, cell: Cell) -> None:
        """Wait until the agent stands in the middle of a cell, as after a teleport; presses nothing."""

        def has_arrived(stance: Stance) -> bool:
            return stance.trouble is None and self._is_near(stance, cell)

        stance = self._watch(has_arrived, self._limits.patience_s)
        if not has_arrived(stance):
            raise NotConfirmedError(
                f"the teleport to cell {cell} was not seen, the agent is at {stance}"
                f"{f' and {stance.trouble}' if stance.trouble else ''}: are cheats on, and is this the arena's world?"
            )

    def move_to(self, cell: Cell) -> Cell:
        """Walk to within the tolerance of a cell's middle and return the cell seen then.

        Nothing is pressed where the agent is near enough already.
        """
        stance = self._look_straight()
        for _ in range(self._limits.tries):
            if self._is_near(stance, cell):
                break
            offset = stance.offset_to(cell)
            if max(abs(offset[0]), abs(offset[1])) >= FAR:
                raise NotConfirmedError(
                    f"cell {cell} is no neighbour of the agent's, it is at {stance}: was it carried off?"
                )
            self._walk(offset)
            stance = self._stand_still(stance)
        if not self._is_near(stance, cell):
            raise NotConfirmedError(
                f"cell {cell} was not reached in {self._limits.tries} tries, the agent is at {stance}: "
                "is something in the way, the chat or a menu open, or auto-jump on?"
            )
        return stance.cell

    def place(self, cell: Cell, shown_id: str) -> Cell:
        """Place a block in front of ``cell``, where the agent stands, and return the cell where it was seen.

        A click goes out only while the floor there is looked at, so never onto a block that stands already.

        Args:
            cell: where the agent stands, within the tolerance.
            shown_id: the block's id as the debug screen shows it.
        """
        front = front_of(cell)
        block = self._arena.block_of(front)
        for _ in range(self._limits.tries):
            self._aim_at_floor(cell, block)
            self._hands.click("right")
            if self._is_placed(block, shown_id):
                return front
        raise NotConfirmedError(
            f"no {shown_id} was seen at {block} after {self._limits.tries} clicks: is the block in the agent's hand?"
        )

    def _walk(self, offset: tuple[float, float]) -> None:
        """One hold, along the axis that is farther off."""
        right, forward = offset
        if abs(forward) >= abs(right):
            key = self._keys.forward if forward > 0 else self._keys.back
        else:
            key = self._keys.right if right > 0 else self._keys.left
        # One tick at least: whoever is outside the tolerance must not wait for a smaller step than there is.
        self._hands.hold(key, max(1, nearest_ticks(max(abs(right), abs(forward)), self._covered)))

    def _aim_at_floor(self, cell: Cell, block: Block) -> None:
        floor = (block[0], block[1] - 1, block[2])

        def is_aimed(stance: Stance) -> bool:
            return stance.target is not None and stance.target.pos == floor

        stance = self._checked(self._watch(is_aimed, self._limits.confirm_s))
        if not is_aimed(stance):
            raise NotConfirmedError(
                f"the floor at {floor} must be looked at before placing, the screen says {_words(stance.target)}: "
                "is the cell free, and the looked-at block on the debug screen?"
            )
        if not self._is_near(stance, cell):
            raise NotConfirmedError(
                f"the agent left cell {cell} before placing, it is at {stance}: does something push it?"
            )

    def _is_placed(self, block: Block, shown_id: str) -> bool:
        """Whether the block is seen in time; another one there is an error."""
        placed = Target(block, shown_id)
        seen = self._watch(lambda stance: stance.target == placed, self._limits.confirm_s).target
        if seen is not None and seen.pos == block and seen.id != shown_id:
            raise NotConfirmedError(f"{_words(seen)} was placed, not {shown_id}: mend [blocks] in the profile")
        return seen == placed

    def _stand_still(self, before: Stance) -> Stance:
        standstill = Standstill(before.place, self._clock.now(), self._limits.settle_s)

        def stands(stance: Stance) -> bool:
            return standstill.is_reached(stance.place, self._clock.now())

        stance = self._checked(self._watch(stands, self._limits.patience_s))
        if not stands(stance):
            raise NotConfirmedError(f"the agent does not stand still, it is at {stance}: does something push it?")
        return stance

    def _is_near(self, stance: Stance, cell: Cell) -> bool:
        right, forward = stance.offset_to(cell)
        return max(abs(right), abs(forward)) <= self._limits.tolerance

    def _look_straight(self) -> Stance:
        return self._checked(self._look())

    def _checked(self, stance: Stance) -> Stance:
        if stance.trouble is not None:
            raise NotConfirmedError(f"{stance.trouble}: leave mouse and keys alone while the agent plays")
        return stance

    def _watch(self, done: Callable[[Stance], bool], seconds: float) -> Stance:
        """Look until ``done`` or for so long; the last stance either way."""
        deadline = self._clock.now() + seconds
        while not done(stance := self._look()) and self._clock.now() < deadline:
            self._clock.sleep_until(self._clock.now() + POLL_S)
        return stance

    def _look(self) -> Stance:
        deadline = self._clock.now() + self._limits.patience_s
        while True:
            reading = self._read()
            if reading.xyz is not None and reading.yaw is not None and reading.pitch is not None:
                return Stance(
                    self._arena.place_of(reading.xyz),
                    self._trouble(reading.xyz[1], reading.yaw, reading.pitch),
                    reading.target,
                )
            # What covers the game can't be read, but it is why.
            self._hands.check_front()
            if self._clock.now() >= deadline:
                reason = reading.problem or "it shows no Facing line"
                raise UnreadableError(f"the debug screen was unreadable for {self._limits.patience_s:g} s: {reason}")
            self._clock.sleep_until(self._clock.now() + POLL_S)

    def _trouble(self, height: float, yaw: float, pitch: float) -> str | None:
        if turn_between(yaw, self._arena.yaw) > TURN or abs(pitch - self._limits.pitch) > TURN:
            return f"the agent looks {yaw:g} / {pitch:g}, not {self._arena.yaw:g} / {self._limits.pitch:g}"
        if abs(height - self._arena.origin[1]) > RISE:
            return f"its feet are at y = {height:g}, not {self._arena.origin[1]}"
        return None


def _words(target: Target | None) -> str:
    if target is None:
        return "that no block is looked at"
    return f"{target.id or 'a block'} at {target.pos or 'no place'}"
