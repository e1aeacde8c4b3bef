"""What is pressed when, so that the next action's walk begins before the last action is confirmed.

Ticks are numbered. Gap n lies between ticks n and n + 1; what reaches the game in it is felt from tick n + 1 on. One
key is down at a time, so the axes are independent: while the walker coasts along one, the next key moves it along the
other, and where that ends is known to a rounding (docs/explanation/timing.md).

A click in gap g finds the walker where tick g has left it. It is planned only where one that is felt a tick too early,
or two too late, would place the same block or none.
"""

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import front_of, is_inside
from mc_nested.live.model.coordinates import EYES, STRAY_CELLS, GroundVector, cell_at, hits_floor
from mc_nested.live.motion.walk_tracker import AT_REST, CoastingState

REFUSED = 0.8
"""Blocks between a player's middle and that of a block on the same floor, below which they touch on that axis."""

VISIBLE_BESIDE, VISIBLE_MARGIN, NOT_TOO_NEAR = 0.48, 0.01, 0.2
"""Blocks: how far to a side of its middle a block is surely looked at, how far within its other bounds, and how far
toward the block."""

LONGEST_HOLD, MOST_WAIT = 12, 5
"""Ticks: the longest hold of one cell, and the longest wait before the next action's walk begins."""

SEEN_TICKS = 5
"""Ticks after the last change of a key within which what was done is seen."""

FORWARD = (1, 1)
"""The axis and the direction of the forward key."""


class Leg(NamedTuple):
    """One action to do: the cell it ends in, the way there along an axis (0 right, 1 forward), whether it places.

    ``sign`` is the direction on the axis; 0 where it moves nowhere.
    """

    cell: Cell
    axis: int
    sign: int
    places: bool

    def push(self, size: float) -> GroundVector:
        """Return what its key adds to each tick's step, for a push of that size."""
        return GroundVector(self.sign * size, 0.0) if self.axis == 0 else GroundVector(0.0, self.sign * size)


class KeyChange(NamedTuple):
    """From the tick after this gap on, the keys that are down push by so much."""

    gap: int
    push: GroundVector


class WalkPlan(NamedTuple):
    """The gaps in which an action's walk is over, the next one's key goes down and up, and the click is sent.

    ``start`` is None where no other key goes down: no walk follows, or the same key stays down until ``stop``.
    ``click`` is None for a plain move. ``changes`` are all that were sent, and these.
    """

    release: int
    start: int | None
    stop: int
    click: int | None
    changes: tuple[KeyChange, ...]


@dataclass(frozen=True)
class Walk:
    """A walker whose state after one tick is known, and the changes of its keys.

    Args:
        tick: which one.
        state: where it was seen then, and its velocity.
        changes: those that it has felt or will feel, in their order.
    """

    tick: int
    state: CoastingState
    changes: tuple[KeyChange, ...] = ()

    def states(self, until: int) -> list[CoastingState]:
        """Return its state after each tick, from the known one to ``until``."""
        found = [self.state]
        for tick in range(self.tick, until):
            push = next((change.push for change in reversed(self.changes) if change.gap <= tick), AT_REST)
            found.append(found[-1].ticked(push))
        return found

    def positions(self, until: int) -> dict[int, GroundVector]:
        """Return its position after each tick, by tick."""
        return {self.tick + past: state.position for past, state in enumerate(self.states(until))}

    def end(self, last_change: int) -> GroundVector:
        """Return where it stops; no key is down after ``last_change``."""
        return self.states(max(last_change, self.tick) + 1)[-1].end

    def also(self, *changes: KeyChange) -> "Walk":
        """Return the same walker, whose keys change so as well."""
        return replace(self, changes=(*self.changes, *changes))


@dataclass(frozen=True)
class Surroundings:
    """What stands around the walker.

    Args:
        size: the arena's.
        solid: the cells that hold a block.
        ahead: blocks from the eyes to where the view meets the floor, on the ground.
    """

    size: int
    solid: Collection[Cell]
    ahead: float

    @classmethod
    def seen_at(cls, pitch: float, size: int, solid: Collection[Cell]) -> "Surroundings":
        """Return those of a view of so many degrees down."""
        return cls(size, solid, EYES / math.tan(math.radians(pitch)))

    def looked_at(self, eyes: GroundVector) -> Cell | None:
        """Return the cell whose floor or block is looked at from there; None too near to a border between two."""
        right, forward = eyes.right + 0.5, eyes.forward + self.ahead + 0.5
        if any(abs(each - round(each)) < VISIBLE_MARGIN for each in (right, forward)):
            return None
        return math.floor(right), math.floor(forward)

    def sees(self, eyes: GroundVector, cell: Cell) -> bool:
        """Return whether the floor of the cell in front of ``cell``, or a block there, is surely looked at."""
        right, forward = eyes.right - cell[0], eyes.forward - cell[1]
        return abs(right) <= VISIBLE_BESIDE and VISIBLE_MARGIN - (self.ahead - 0.5) <= forward <= NOT_TOO_NEAR

    def landing(self, position: GroundVector) -> Cell | None:
        """Return where a click from there places a block; None if the game refuses it.

        It is refused where it would touch the player. A block that stands is hit on its near side, and what would be
        placed there touches the player, too (FACTS: Standing, looking, placing).
        """
        cell = cell_at((position.right, position.forward + self.ahead))
        touches = max(abs(position.right - cell[0]), abs(position.forward - cell[1])) < REFUSED
        return None if touches or cell in self.solid else cell

    def is_free(self, position: GroundVector) -> bool:
        """Return whether a player fits there."""
        x, y = cell_at(position)
        near = ((x + right, y + forward) for right in (-1, 0, 1) for forward in (-1, 0, 1))
        return not any(
            cell in self.solid and max(abs(position.right - cell[0]), abs(position.forward - cell[1])) < REFUSED
            for cell in near
        )


@dataclass(frozen=True)
class Planner:
    """Plans one action at a time, and how the next one begins.

    Args:
        around: what stands there.
        push: what a held key adds to each tick's step, in blocks.
        lag: gaps from a tick to the first press that can follow from seeing its step.
        tolerance: blocks that the walker may stop off a cell's middle.
    """

    around: Surroundings
    push: float
    lag: int
    tolerance: float

    def plan(
        self, walk: Walk, leg: Leg, press: int | None, first: int, after: Leg | None, no_forward: int
    ) -> WalkPlan | None:
        """Return how an action is done; None if there is no way without standing still.

        Args:
            walk: the walker, and the changes that are sent.
            leg: the action.
            press: the gap in which its key goes down; None if it is down.
            first: the first gap in which something can still be sent.
            after: the action that follows, if it is known.
            no_forward: the gaps before this one in which forward must not be pressed.
        """
        if press is not None:
            walk = walk.also(KeyChange(press, leg.push(self.push)))
        release = self._release(walk, leg, first if press is None else press + 1)
        if release is None:
            return None
        if after is None:
            return self._try(walk, leg, KeyChange(release, AT_REST), (release, None), first)
        goes_on = (after.axis, after.sign) == (leg.axis, leg.sign)
        if goes_on and (stop := self._release(walk, after, release + 1)) is not None:
            plan = self._try(walk, leg, KeyChange(stop, AT_REST), (release, None), first)
            if plan is not None:
                return plan
        is_forward = (after.axis, after.sign) == FORWARD
        if goes_on and is_forward:
            return None  # pressed again so soon, it would sprint
        earliest = max(release + goes_on, no_forward if is_forward else release)
        starts = range(earliest, release + MOST_WAIT + 1)
        turns = (self._turn(walk, leg, after, (release, start), first) for start in starts)
        return next((plan for plan in turns if plan is not None), None)

    def _turn(self, walk: Walk, leg: Leg, after: Leg, gaps: tuple[int, int], first: int) -> WalkPlan | None:
        """Return the plan in which the key goes up in the first of these gaps, and the next one down in the second."""
        turned = walk.also(KeyChange(gaps[0], AT_REST), KeyChange(gaps[1], after.push(self.push)))
        stop = self._release(turned, after, gaps[1] + 1)
        return None if stop is None else self._try(turned, leg, KeyChange(stop, AT_REST), gaps, first)

    def _release(self, walk: Walk, leg: Leg, first: int) -> int | None:
        """Return the gap from ``first`` on in which the leg's key has to go up; None if it can't end well."""
        target, axis = leg.cell[leg.axis], leg.axis
        ends = {
            gap: abs(walk.also(KeyChange(gap, AT_REST)).end(gap)[axis] - target)
            for gap in range(first, first + LONGEST_HOLD)
        }
        best = min(ends, key=lambda gap: ends[gap])
        return best if ends[best] <= self.tolerance else None

    def _try(self, walk: Walk, leg: Leg, last: KeyChange, gaps: tuple[int, int | None], first: int) -> WalkPlan | None:
        """Return the plan with that last change, if nothing is in its way and the action can be seen to be done."""
        whole = walk.also(last)
        positions = whole.positions(last.gap + SEEN_TICKS)
        if not all(self.around.is_free(position) for position in positions.values()):
            return None
        release, start = gaps
        if not leg.places:
            seen = (cell_at(each) == leg.cell and self.around.sees(each, leg.cell) for each in positions.values())
            return WalkPlan(release, start, last.gap, None, whole.changes) if any(seen) else None
        possible = range(max(first, walk.tick + 1), last.gap + SEEN_TICKS - 2)
        click = next((gap for gap in possible if self._may_click(whole, positions, leg, gap)), None)
        return None if click is None else WalkPlan(release, start, last.gap, click, whole.changes)

    def _may_click(self, walk: Walk, positions: dict[int, GroundVector], leg: Leg, gap: int) -> bool:
        """Return whether a click in that gap is right, also a little early or late, and its block can be seen."""
        here, later = positions[gap], positions[gap + 1]
        front = front_of(leg.cell)
        if not hits_floor(here, leg.cell) or not all(self.around.sees(eyes, leg.cell) for eyes in (here, later)):
            return False
        felt = [positions[tick] for tick in range(gap - 1, gap + 3) if tick in positions]
        if any(self.around.landing(each) not in (front, None) for each in felt):
            return False
        if (leg.axis, leg.sign) != (1, -1) and not self._sees_before(positions, leg.cell, gap):
            return False
        return all(self._may_stray(leg.cell, change.push) for change in self._unseen(walk.changes, gap))

    def _sees_before(self, positions: dict[int, GroundVector], cell: Cell, gap: int) -> bool:
        """Return whether the floor is seen before the click: a frame shows what the eyes saw a tick before."""
        return any(self.around.sees(eyes, cell) for tick, eyes in positions.items() if tick < gap - self.lag)

    def _unseen(self, changes: Sequence[KeyChange], gap: int) -> list[KeyChange]:
        """Return the changes after which a key may be down in a gap: the last one seen to be felt, and all after it."""
        sent = [change for change in changes if change.gap <= gap]
        felt = [at for at, change in enumerate(sent) if change.gap + 1 <= gap - self.lag]
        return sent[felt[-1] if felt else 0 :]

    def _may_stray(self, cell: Cell, push: GroundVector) -> bool:
        """Return whether what a click may hit is known if that key is felt for too long: the game may stall."""
        beyond = [at + STRAY_CELLS * ((way > 0) - (way < 0)) for at, way in zip(cell, push, strict=True)]
        return is_inside((beyond[0], beyond[1]), self.around.size)
