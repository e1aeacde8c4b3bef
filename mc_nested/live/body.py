"""Body: one cell, one block, each confirmed on the debug screen before it counts.

move:  look where the agent is, and where it will stop -> hold the key that ends nearest from there -> look until it is
       certain where that ends: a tick after the key is up, long before the agent stands
place: see the floor ahead -> click, perhaps on the way -> wait until the debug screen names the new block there
"""

from collections.abc import Callable, Collection

from mc_nested.arena.rules import Cell, front_of, is_inside
from mc_nested.errors import NotConfirmedError
from mc_nested.live.coordinates import cell_at
from mc_nested.live.devices import Clock
from mc_nested.live.effort import Effort
from mc_nested.live.eyes import Eyes, Stance, checked
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.hands import Hands
from mc_nested.live.legs import SOONEST_S, Legs
from mc_nested.live.profile import Profile
from mc_nested.live.reading import Block, Target
from mc_nested.live.stride import Going, Pair

FAR = 2.0
"""Blocks: whoever is so far from a neighbouring cell did not get there by walking to it."""

COASTING_CLICK = 0.19
"""Blocks off the middle that a click is right from, if the agent comes to a stop within the tolerance: the game refuses
a block from 0.2 on (FACTS: Standing, looking, placing), and at 65 degrees the next cell's floor is hit from there."""

BESIDE, BEHIND = 0.4, 0.2
"""Blocks off the middle, to a side and back, from which the same floor is hit: it is, at 65 degrees, from 0.5 and 0.25
(FACTS: Standing, looking, placing)."""

STRAY = 2
"""Cells that an agent who is carried on may click beyond: an early click is only right where they are arena."""


class Body:
    """Moves the agent from cell to cell and places blocks, closed over what the debug screen says.

    Raises (everything): UnreadableError where the debug screen can't be read for the profile's patience;
    NotConfirmedError where what was asked is not seen in the profile's tries; what the hands raise.
    """

    def __init__(self, profile: Profile, hands: Hands, screen: GameScreen, clock: Clock) -> None:
        self._arena = profile.marked_arena()
        self._limits = profile.body
        self._felt_after_s = profile.walk.felt_after_s
        self._hands = hands
        self._clock = clock
        self._eyes = Eyes(profile, hands, screen, clock)
        self._legs = Legs(profile, hands, self._eyes, clock)
        self.effort = Effort()

    def check_screen(self) -> None:
        """See that the debug screen can be read at all, and the chat is closed; presses nothing."""
        self._eyes.look()
        self._eyes.permit_press()

    def stay_in(self, cell: Cell) -> Cell:
        """See that the agent still is in a cell, and return the cell seen; presses nothing."""
        stance = self._eyes.look_straight()
        if stance.cell != cell:
            raise NotConfirmedError(f"the agent left cell {cell} by itself, it is at {stance}: does something push it?")
        return stance.cell

    def arrive(self, cell: Cell) -> None:
        """Wait until the agent stands in the middle of a cell, as after a teleport; presses nothing."""

        def has_arrived(stance: Stance) -> bool:
            return stance.trouble is None and self._is_near(stance.place, cell)

        stance = self._eyes.watch(has_arrived, self._limits.patience_s)
        if not has_arrived(stance):
            raise NotConfirmedError(
                f"the teleport to cell {cell} was not seen, the agent is at {stance}"
                f"{f' and {stance.trouble}' if stance.trouble else ''}: are cheats on, and is this the arena's world?"
            )
        self._legs.stand(stance)

    def move_to(self, cell: Cell, tries_made: int = 0) -> Stance:
        """Walk to where the agent comes to a stop within the tolerance of a cell's middle; what was seen then.

        Nothing is pressed where it does so already. ``tries_made`` are presses that this move took before.
        """
        going, stance = self._legs.settle(self._eyes.look_straight())
        for attempt in range(tries_made, self._limits.tries):
            if self._ends_in(going, cell):
                break
            going, stance = self._step(going, stance, cell, attempt)
        if not self._ends_in(going, cell):
            raise NotConfirmedError(
                f"cell {cell} was not reached in {self._limits.tries} tries, the agent is at {stance}: "
                "is something in the way, the chat or a menu open, or auto-jump on?"
            )
        return stance

    def build(self, cell: Cell, built: Collection[Cell], shown_id: str) -> Cell:
        """Walk to a cell and place a block in front of it; the cell where it was seen.

        The click goes out on the way where that is right wherever the agent comes to a stop. It comes to the game
        after the release of the key, in order, so that it finds the agent between where it was seen then and its end.

        Args:
            cell: where to stand.
            built: the cells that hold a block already.
            shown_id: the block's id as the debug screen shows it.
        """
        front = front_of(cell)
        block = self._arena.block_of(front)
        clicked: list[Stance] = []

        def on_the_way(stance: Stance) -> None:
            if not clicked and self._looks_at_floor(stance, block) and self._is_right_from(stance.place, cell):
                self._click(0)
                clicked.append(stance)

        going, stance = self._legs.settle(self._eyes.look_straight())
        is_there = self._ends_in(going, cell)
        if not is_there:
            going, stance = self._step(going, stance, cell, 0, on_the_way)
        if not clicked:
            stance = self.move_to(cell, tries_made=0 if is_there else 1)
            self.check_front(stance, built, shown_id)
            return self.place(cell, shown_id, stance)
        if not _hits_the_floor(going.end, cell):
            raise NotConfirmedError(
                f"the agent was carried on while it clicked, past cell {cell}, to {stance}: does something push it?"
            )
        is_placed = self._is_placed(cell, block, shown_id)
        return front if is_placed else self.place(cell, shown_id)

    def check_front(self, stance: Stance, built: Collection[Cell], shown_id: str) -> None:
        """See that what the agent looks at is what should be there: a block of its own in the next cell, or the floor.

        A block too many, or one that is gone, is an error however it came about. Outside the arena nothing is known.
        """
        front = front_of(stance.cell)
        if not is_inside(front):
            return
        x, y, z = block = self._arena.block_of(front)
        is_built = front in built

        def is_right(seen: Stance) -> bool:
            if seen.target is None or seen.target.pos is None:
                return not is_built
            return seen.target == Target(block, shown_id) if is_built else seen.target.pos == (x, y - 1, z)

        if not is_right(stance):
            seen = self._eyes.watch(is_right, self._limits.confirm_s)
            if not is_right(seen):
                raise NotConfirmedError(
                    f"{shown_id if is_built else 'only the floor'} should be at {block}, the screen says "
                    f"{_words(seen.target)}: did somebody else build there?"
                )

    def see_floor_ahead(self) -> None:
        """See that no block is left in front of the cell in which the agent stands; presses nothing."""
        self.check_front(self._eyes.look_straight(), (), "")

    def place(self, cell: Cell, shown_id: str, stance: Stance | None = None) -> Cell:
        """Place a block in front of ``cell``, where the agent stands or stops, and return the cell where it was seen.

        A click goes out only while the floor there is looked at, so never onto a block that stands already.

        Args:
            cell: where the agent stands, or stops, within the tolerance.
            shown_id: the block's id as the debug screen shows it.
            stance: what was just seen; without it, that is looked at first.
        """
        front = front_of(cell)
        block = self._arena.block_of(front)
        for attempt in range(self._limits.tries):
            if attempt or stance is None or not self._is_aimed(stance, cell, block):
                stance = self._aim(cell, block, may_walk=attempt == 0)
            self._click(attempt)
            self._wait_for_click()
            if self._is_placed(cell, block, shown_id):
                return front
        raise NotConfirmedError(
            f"no {shown_id} was seen at {block} after {self._limits.tries} clicks: is the block in the agent's hand?"
        )

    def _step(
        self,
        going: Going,
        stance: Stance,
        cell: Cell,
        attempt: int,
        on_the_way: Callable[[Stance], None] | None = None,
    ) -> tuple[Going, Stance]:
        """One hold towards a cell: how the agent goes after it, and what was seen last."""
        self._eyes.permit_press()
        offset = cell[0] - going.end[0], cell[1] - going.end[1]
        if max(abs(offset[0]), abs(offset[1])) >= FAR:
            raise NotConfirmedError(
                f"cell {cell} is no neighbour of the agent's, it is at {stance}: was it carried off?"
            )
        self.effort.moves += attempt == 0
        self.effort.corrections += attempt > 0
        return self._legs.settle(self._legs.walk(going, offset), on_the_way)

    def _click(self, attempt: int) -> None:
        self._eyes.permit_press()
        self._hands.click("right")
        self.effort.clicks += attempt == 0
        self.effort.second_clicks += attempt > 0

    def _is_right_from(self, place: Pair, cell: Cell) -> bool:
        """Whether a click is right from there, and from everywhere up to where a tick more would carry the agent."""
        farthest = self._legs.farthest
        way = farthest[0] - place[0], farthest[1] - place[1]
        axis = 1 if abs(way[1]) >= abs(way[0]) else 0
        beyond = list(cell)
        beyond[axis] += STRAY if way[axis] > 0 else -STRAY
        return is_inside((beyond[0], beyond[1])) and _hits_the_floor(place, cell) and _hits_the_floor(farthest, cell)

    def _aim(self, cell: Cell, block: Block, *, may_walk: bool) -> Stance:
        """Wait until the floor below ``block`` is looked at from ``cell``.

        An agent that a late release carried on walks back for it where it may: as long as nothing was clicked.
        """
        stance = checked(self._eyes.watch(lambda seen: self._is_aimed(seen, cell, block), self._limits.confirm_s))
        if may_walk and not self._may_click(stance, cell):
            stance = self.move_to(cell)
        if not self._looks_at_floor(stance, block):
            raise NotConfirmedError(
                f"the floor at {_below(block)} must be looked at before placing, the screen says "
                f"{_words(stance.target)}: is the cell free, and the looked-at block on the debug screen?"
            )
        if not self._may_click(stance, cell):
            raise NotConfirmedError(
                f"the agent left cell {cell} before placing, it is at {stance}: does something push it?"
            )
        return stance

    def _is_aimed(self, stance: Stance, cell: Cell, block: Block) -> bool:
        return self._looks_at_floor(stance, block) and self._may_click(stance, cell)

    def _looks_at_floor(self, stance: Stance, block: Block) -> bool:
        return stance.target is not None and stance.target.pos == _below(block)

    def _may_click(self, stance: Stance, cell: Cell) -> bool:
        """Whether the agent stands or coasts where a click is right, from now until it stops.

        One whose place has no explanation may still be walking, and only pass by.
        """
        going = self._legs.explain(stance.place)
        return (
            going is not None and self._is_near(going.end, cell) and self._is_near(stance.place, cell, COASTING_CLICK)
        )

    def _wait_for_click(self) -> None:
        """Wait until what a click does is likely to be seen."""
        beat = self._eyes.beat
        if beat.is_known:
            self._eyes.wait_for_step(beat.next(self._clock.now() + self._felt_after_s))
        else:
            self._hands.wait(SOONEST_S)

    def _is_placed(self, cell: Cell, block: Block, shown_id: str) -> bool:
        """Whether the block is seen in time; another one there, or the agent elsewhere, is an error."""
        placed = Target(block, shown_id)
        stance = checked(self._eyes.watch(lambda stance: stance.target == placed, self._limits.confirm_s))
        seen = stance.target
        if seen is not None and seen.pos == block and seen.id != shown_id:
            raise NotConfirmedError(f"{_words(seen)} was placed, not {shown_id}: mend [blocks] in the profile")
        if seen != placed:
            return False
        self._eyes.note_timely()
        if stance.cell != cell:
            raise NotConfirmedError(f"the agent left cell {cell} while placing, it is at {stance}")
        return True

    def _ends_in(self, going: Going, cell: Cell) -> bool:
        return self._is_near(going.end, cell) and cell_at(going.place) == cell

    def _is_near(self, place: Pair, cell: Cell, within: float | None = None) -> bool:
        off = max(abs(cell[0] - place[0]), abs(cell[1] - place[1]))
        return off <= (self._limits.tolerance if within is None else within)


def _hits_the_floor(place: Pair, cell: Cell) -> bool:
    """Whether a click from there lands on the floor in front of a cell, and the game does not refuse it."""
    right, forward = place[0] - cell[0], place[1] - cell[1]
    return abs(right) <= BESIDE and -BEHIND <= forward <= COASTING_CLICK


def _below(block: Block) -> Block:
    return block[0], block[1] - 1, block[2]


def _words(target: Target | None) -> str:
    if target is None:
        return "that no block is looked at"
    return f"{target.id or 'a block'} at {target.pos or 'no place'}"
