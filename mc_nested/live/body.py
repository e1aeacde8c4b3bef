"""Body: one cell, one block, each confirmed on the debug screen before it counts.

move:  look where the agent is, and where it will stop -> hold the key that ends nearest from there -> look until it is
       certain where that ends: a tick after the key is up, long before the agent stands
place: see the floor ahead -> click, perhaps while coasting -> wait until the debug screen names the new block there
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass

from mc_nested.arena.rules import Cell, front_of, is_inside
from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.beat import FELT_AFTER_S, Beat
from mc_nested.live.coordinates import cell_at, turn_between
from mc_nested.live.devices import Clock
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.reading import Block, Target
from mc_nested.live.standstill import Standstill
from mc_nested.live.stride import Going, Hold, Pair, Stride
from mc_nested.live.walk import SNEAKING, TICK_S, best_steps, push_of

FRAME_S = 1 / 60
"""Seconds between two looks at the screen: a frame of the game, so that no wait is much longer than it must be."""

SOONEST_S = 0.015
"""Seconds in which nothing that was pressed is seen: an event takes 5 ms to the game, a picture 10 back."""

TURN = 0.5
"""Degrees that the view may be off: the debug screen shows tenths (FACTS: The F3 debug screen)."""

RISE = 0.05
"""Blocks that the feet may be above or below the arena's floor: standing on a full block there is no difference."""

FAR = 2.0
"""Blocks: whoever is so far from a neighbouring cell did not get there by walking to it."""

SHORT = 2
"""Ticks of a hold that ends before its first ones can be seen."""

SURELY_SEEN_S, LIKELY_SEEN_S = 0.053, 0.028
"""Seconds after a tick at which its step is on the screen in any case, and the next one's can't be; and at which looks
for it begin: a frame and a picture take 10 to 47 ms."""

SAME_FRAME_S = 0.005
"""Seconds after a look in which another one would see the same frame."""

SOON_LOOKS = 3
"""Looks that come twice a frame, since a click that goes out a little sooner is felt a tick sooner."""

LOST_RELEASE = 20
"""Looks at an agent whose way has no explanation, after which its keys are released once more."""

COASTING_CLICK = 0.19
"""Blocks off the middle that a click is right from, if the agent comes to a stop within the tolerance: the game refuses
a block from 0.2 on (FACTS: Standing, looking, placing), and at 65 degrees the next cell's floor is hit from there."""


@dataclass(frozen=True)
class Stance:
    """A reading seen from the arena: the place in cells as (right, forward), and what is wrong with the stance."""

    place: Pair
    trouble: str | None
    target: Target | None

    @property
    def cell(self) -> Cell:
        """The cell that holds the place."""
        return cell_at(self.place)

    def __str__(self) -> str:
        return f"({self.place[0]:.2f}, {self.place[1]:.2f})"


@dataclass
class Effort:
    """What it took so far: moves and the corrections after them, clicks and those that had to be repeated."""

    moves: int = 0
    corrections: int = 0
    clicks: int = 0
    second_clicks: int = 0


class Body:
    """Moves the agent from cell to cell and places blocks, closed over what the debug screen says.

    Raises (everything): UnreadableError where the debug screen can't be read for the profile's patience;
    NotConfirmedError where what was asked is not seen in the profile's tries; what the hands raise.
    """

    def __init__(self, profile: Profile, hands: Hands, screen: GameScreen, clock: Clock) -> None:
        self._arena = profile.marked_arena()
        self._keys = profile.keys
        self._limits = profile.body
        self._covered = profile.walk.covered
        self._push = push_of(profile.walk.covered)
        self._hands = hands
        self._screen = screen
        self._clock = clock
        self._stride = Stride(Going((0.0, 0.0), (0.0, 0.0)))
        self._beat = Beat()
        self._timed_look = 0.0
        self._looked: tuple[float, Stance] | None = None
        self.effort = Effort()

    def check_screen(self) -> None:
        """See that the debug screen can be read at all, and the chat is closed; presses nothing."""
        self._look()
        self._check_chat()

    def stay_in(self, cell: Cell) -> Cell:
        """See that the agent still is in a cell, and return the cell seen; presses nothing."""
        stance = self._look_straight()
        if stance.cell != cell:
            raise NotConfirmedError(f"the agent left cell {cell} by itself, it is at {stance}: does something push it?")
        return stance.cell

    def arrive(self, cell: Cell) -> None:
        """Wait until the agent stands in the middle of a cell, as after a teleport; presses nothing."""

        def has_arrived(stance: Stance) -> bool:
            return stance.trouble is None and self._is_near(stance.place, cell)

        stance = self._watch(has_arrived, self._limits.patience_s)
        if not has_arrived(stance):
            raise NotConfirmedError(
                f"the teleport to cell {cell} was not seen, the agent is at {stance}"
                f"{f' and {stance.trouble}' if stance.trouble else ''}: are cheats on, and is this the arena's world?"
            )
        self._stride = Stride(Going(stance.place, (0.0, 0.0)))
        self._going_now(stance)

    def move_to(self, cell: Cell) -> Stance:
        """Walk to where the agent comes to a stop within the tolerance of a cell's middle; what was seen then.

        Nothing is pressed where it does so already.
        """
        stance = self._look_straight()
        going = self._going_now(stance)
        for attempt in range(self._limits.tries):
            if self._ends_in(going, cell):
                break
            self._check_chat()
            offset = cell[0] - going.end[0], cell[1] - going.end[1]
            if max(abs(offset[0]), abs(offset[1])) >= FAR:
                raise NotConfirmedError(
                    f"cell {cell} is no neighbour of the agent's, it is at {stance}: was it carried off?"
                )
            self.effort.moves += attempt == 0
            self.effort.corrections += attempt > 0
            stance = self._walk(going, offset)
            going = self._going_now(stance)
            stance = self._seen
        if not self._ends_in(going, cell):
            raise NotConfirmedError(
                f"cell {cell} was not reached in {self._limits.tries} tries, the agent is at {stance}: "
                "is something in the way, the chat or a menu open, or auto-jump on?"
            )
        return stance

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
            seen = self._watch(is_right, self._limits.confirm_s)
            if not is_right(seen):
                raise NotConfirmedError(
                    f"{shown_id if is_built else 'only the floor'} should be at {block}, the screen says "
                    f"{_words(seen.target)}: did somebody else build there?"
                )

    def see_floor_ahead(self) -> None:
        """See that no block is left in front of the cell in which the agent stands; presses nothing."""
        self.check_front(self._look_straight(), (), "")

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
            self._aim_at_floor(cell, block, stance if attempt == 0 else None)
            self._check_chat()
            self._hands.click("right")
            self.effort.clicks += attempt == 0
            self.effort.second_clicks += attempt > 0
            if self._is_placed(cell, block, shown_id):
                return front
        raise NotConfirmedError(
            f"no {shown_id} was seen at {block} after {self._limits.tries} clicks: is the block in the agent's hand?"
        )

    def _walk(self, going: Going, offset: Pair) -> Stance:
        """One hold, along the axis that is farther off; what is seen after it."""
        axis = 1 if abs(offset[1]) >= abs(offset[0]) else 0
        sign = 1 if offset[axis] > 0 else -1
        steps = best_steps(abs(offset[axis]), self._covered, self._limits.tolerance)
        sneaks = steps.gait == "sneak"
        hold = Hold(axis, sign, steps.ticks, self._push * (SNEAKING if sneaks else 1.0))
        self._stride = Stride(going, hold)
        keys = self._keys
        key = ((keys.left, keys.right), (keys.back, keys.forward))[axis][sign > 0]
        self._hold(steps.ticks, *([keys.sneak] if sneaks else []), key)
        return self._look_straight()

    def _hold(self, ticks: int, *keys: str) -> None:
        """Hold keys so that exactly so many ticks feel them, as far as the beat is known; then wait for what follows.

        A key that goes down or up just when a tick comes is felt by that tick or by the next. So a short hold waits for
        a time between two ticks, and a long one looks on its way how many ticks have felt it, and ends between two.
        """
        now, beat = self._clock.now(), self._beat
        middle = TICK_S / 2 - FELT_AFTER_S
        if not beat.is_known:
            self._hands.hold(keys[-1], ticks, *keys[:-1])
            self._hands.wait(SOONEST_S)
            return
        if ticks <= SHORT:
            self._hands.wait_until(beat.next(now, middle))
            until = self._clock.now() + ticks * TICK_S
            self._hands.press(until, *keys)
        else:
            until = now + ticks * TICK_S
            self._hands.press(until, *keys)
            tick = beat.next(now + TICK_S / 2)
            self._hands.wait_until(tick + SURELY_SEEN_S)
            felt = self._ticks_felt()
            if felt is not None:
                until = tick + (ticks - felt) * TICK_S + middle
                self._hands.keep_until(until, *keys)
        self._hands.wait_until(until)
        self._wait_for_step(until - middle + TICK_S)

    def _ticks_felt(self) -> int | None:
        """How many ticks have felt the key that is held, by a look at the screen; None where it doesn't tell."""
        reading = self._screen.read()
        return self._stride.ticks_held(self._arena.place_of(reading.xyz)) if reading.xyz else None

    def _going_now(self, stance: Stance) -> Going:
        """How the agent goes who was seen like that: by the stride that it is in, or else once it stands.

        What was seen last is in ``_seen``.
        """
        standstill = Standstill(stance.place, self._clock.now(), self._limits.settle_s)
        began = self._clock.now()
        looks = 0
        while True:
            self._seen = stance
            going = self._stride.see(stance.place)
            if going is None and standstill.is_reached(stance.place, self._clock.now()):
                going = Going(stance.place, (0.0, 0.0))
            if going is not None:
                self._note_timely()
                self._stride = Stride(going)
                return going
            if self._clock.now() >= began + self._limits.patience_s:
                raise NotConfirmedError(f"the agent does not stand still, it is at {stance}: does something push it?")
            looks += 1
            if looks % LOST_RELEASE == 0:
                self._hands.release_again()
            self._hands.wait(FRAME_S if looks > SOON_LOOKS else FRAME_S / 2)
            stance = self._look_straight()

    def _aim_at_floor(self, cell: Cell, block: Block, stance: Stance | None) -> None:
        floor = (block[0], block[1] - 1, block[2])

        def is_aimed(stance: Stance) -> bool:
            return stance.target is not None and stance.target.pos == floor and self._may_click(stance, cell)

        if stance is None or not is_aimed(stance):
            stance = self._checked(self._watch(is_aimed, self._limits.confirm_s))
        if stance.target is None or stance.target.pos != floor:
            raise NotConfirmedError(
                f"the floor at {floor} must be looked at before placing, the screen says {_words(stance.target)}: "
                "is the cell free, and the looked-at block on the debug screen?"
            )
        if not self._may_click(stance, cell):
            raise NotConfirmedError(
                f"the agent left cell {cell} before placing, it is at {stance}: does something push it?"
            )

    def _may_click(self, stance: Stance, cell: Cell) -> bool:
        """Whether the agent stands or coasts where a click is right, from now until it stops."""
        going = self._stride.see(stance.place)
        if going is None:
            return self._is_near(stance.place, cell)
        return self._is_near(going.end, cell) and self._is_near(stance.place, cell, COASTING_CLICK)

    def _is_placed(self, cell: Cell, block: Block, shown_id: str) -> bool:
        """Whether the block is seen in time; another one there, or the agent elsewhere, is an error."""
        placed = Target(block, shown_id)
        if self._beat.is_known:
            self._wait_for_step(self._beat.next(self._clock.now() + FELT_AFTER_S))
        else:
            self._hands.wait(SOONEST_S)
        stance = self._checked(self._watch(lambda stance: stance.target == placed, self._limits.confirm_s))
        seen = stance.target
        if seen is not None and seen.pos == block and seen.id != shown_id:
            raise NotConfirmedError(f"{_words(seen)} was placed, not {shown_id}: mend [blocks] in the profile")
        if seen != placed:
            return False
        self._note_timely()
        if stance.cell != cell:
            raise NotConfirmedError(f"the agent left cell {cell} while placing, it is at {stance}")
        return True

    def _ends_in(self, going: Going, cell: Cell) -> bool:
        return self._is_near(going.end, cell) and cell_at(going.place) == cell

    def _is_near(self, place: Pair, cell: Cell, within: float | None = None) -> bool:
        off = max(abs(cell[0] - place[0]), abs(cell[1] - place[1]))
        return off <= (self._limits.tolerance if within is None else within)

    def _look_straight(self) -> Stance:
        return self._checked(self._look())

    def _checked(self, stance: Stance) -> Stance:
        if stance.trouble is not None:
            raise NotConfirmedError(f"{stance.trouble}: leave mouse and keys alone while the agent plays")
        return stance

    def _check_chat(self) -> None:
        """See that the next press goes into the world, the debug screen having just been read."""
        if self._screen.is_chat_open():
            raise NotConfirmedError("the chat is open: leave mouse and keys alone while the agent plays")
        self._hands.saw("world")

    def _watch(self, done: Callable[[Stance], bool], seconds: float) -> Stance:
        """Look until ``done`` or for so long; the last stance either way."""
        deadline = self._clock.now() + seconds
        while not done(stance := self._look()) and self._clock.now() < deadline:
            self._hands.wait(FRAME_S)
        return stance

    def _look(self) -> Stance:
        deadline = self._clock.now() + self._limits.patience_s
        while True:
            now = self._clock.now()
            if self._looked is not None and now - self._looked[0] < SAME_FRAME_S:
                return self._looked[1]
            reading = self._screen.read()
            if reading.xyz is not None and reading.yaw is not None and reading.pitch is not None:
                trouble = self._trouble(reading.xyz[1], reading.yaw, reading.pitch)
                stance = Stance(self._arena.place_of(reading.xyz), trouble, reading.target)
                self._note(now, stance)
                return stance
            self._looked = None
            # What covers the game can't be read, but it is why.
            self._hands.check_front()
            if self._clock.now() >= deadline:
                reason = reading.problem or "it shows no Facing line"
                raise UnreadableError(f"the debug screen was unreadable for {self._limits.patience_s:g} s: {reason}")
            self._hands.wait(FRAME_S)

    def _note(self, now: float, stance: Stance) -> None:
        if self._looked is not None and stance != self._looked[1] and now - self._looked[0] < 1.5 * FRAME_S:
            self._beat.saw_step(self._looked[0], now)
        self._looked = now, stance

    def _wait_for_step(self, tick: float) -> None:
        """Wait until the step of a tick is likely to be seen."""
        self._hands.wait_until(tick + LIKELY_SEEN_S)
        self._timed_look = self._clock.now()

    def _note_timely(self) -> None:
        """Where the step that was waited for was seen at the first look, count it as seen since a frame before.

        Without it, only steps that are seen late would be sighted.
        """
        if self._looked is not None and self._looked[0] == self._timed_look:
            self._beat.saw_step(self._timed_look - FRAME_S, self._timed_look)

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
