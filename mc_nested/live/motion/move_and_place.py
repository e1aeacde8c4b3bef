"""Body: moves the agent by one cell or places one block, each confirmed on the debug screen before it counts.

move:  look where the agent is and where it will stop -> hold the key that ends nearest from there -> look until it is
       certain where that ends: a tick after the key is up, long before the agent stands still
place: see the floor ahead -> click, perhaps while still moving -> wait until the debug screen names the new block there
"""

from collections.abc import Callable, Mapping

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import front_of, is_inside
from mc_nested.errors import NotConfirmedError
from mc_nested.live.action_log import Effort
from mc_nested.live.connection import GameConnection
from mc_nested.live.model.coordinates import COASTING_CLICK, GroundVector, cell_at, hits_floor, is_click_right, is_near
from mc_nested.live.model.debug_entries import NONE_NAMED, switch_on
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.reading import Block, Target
from mc_nested.live.motion.locomotion import Locomotion
from mc_nested.live.motion.overlap import Overlap
from mc_nested.live.motion.overlap_plan import Leg
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseFrame, PoseObserver, TickPhase, check_pose
from mc_nested.live.motion.walk_tracker import AT_REST, CoastingState
from mc_nested.live.profile.tables import Profile

FAR = 2.0
"""Blocks: an agent so far from a neighbouring cell did not get there by walking to it."""


TRUSTED, MOST_LOSSES = 20, 7
"""Actions as planned after which an earlier one that wasn't counts no more; and how many of those count at most."""


class Body:
    """Moves the agent from cell to cell and places blocks, in a closed loop over what the debug screen says.

    Raises (everything): UnreadableError if the debug screen can't be read for the profile's patience; NotConfirmedError
    if what was asked is not seen in the profile's tries; what the input controller raises.
    """

    def __init__(self, profile: Profile, connection: GameConnection) -> None:
        self._arena = profile.marked_arena()
        self._limits = profile.body
        self._input_latency_s = profile.walk.input_latency_s
        self._controller = connection.controller
        self._clock = connection.devices.clock
        self._journal = connection.journal
        self._observer = PoseObserver(profile, connection, PoseFrame.of_arena(profile))
        self._locomotion = Locomotion(profile, connection, self._observer)
        self._overlap = Overlap(profile, connection, self._observer, self._locomotion)
        self._inertia = profile.walk.inertia
        self._waits, self._losses, self._since_loss = 0, 0, 0
        self.effort = Effort()

    @property
    def tick_phase(self) -> TickPhase:
        """The times at which the game's ticks come."""
        return self._observer.tick_phase

    def forget(self) -> None:
        """Look anew before anything else: what comes depends on nothing that was seen before."""
        self._observer.forget()
        self._overlap.end()
        self._locomotion.set_coasting(None)

    def check_screen(self) -> None:
        """Check that the debug screen can be read and that the chat is closed; presses nothing."""
        self._observer.look()
        self._observer.permit_press()

    def take(self, hotbar_key: str) -> None:
        """Take what is in a slot of the hotbar in hand; the keys of a walk that is under way stay down."""
        if self.is_under_way:
            self._controller.press(self._clock.now() + TICK_S, hotbar_key)
            return
        self.check_screen()
        self._controller.tap_alone(hotbar_key)

    def stay_in(self, cell: Cell) -> Cell:
        """Check that the agent is still in a cell, and return the cell seen; presses nothing."""
        pose = self._observer.look_and_check()
        if pose.cell != cell:
            raise NotConfirmedError(f"the agent left cell {cell} by itself, it is at {pose}: does something push it?")
        return pose.cell

    def arrive(self, cell: Cell) -> None:
        """Wait until the agent stands in the middle of a cell, as after a teleport; presses nothing."""

        def has_arrived(pose: PoseEstimate) -> bool:
            return pose.problem is None and is_near(pose.position, cell, self._limits.tolerance)

        pose = self._observer.watch(has_arrived, self._limits.patience_s)
        if not has_arrived(pose):
            raise NotConfirmedError(
                f"the teleport to cell {cell} was not seen, the agent is at {pose}"
                f"{f' and {pose.problem}' if pose.problem else ''}: are cheats on, and is this the arena's world?"
            )
        self._locomotion.set_coasting(CoastingState(pose.position, AT_REST, self._inertia))

    @property
    def is_under_way(self) -> bool:
        """Whether the walk of the next action has begun."""
        return self._overlap.is_under_way

    def go_on(self, leg: Leg, after: Leg | None, built: Mapping[Cell, str], shown_id: str) -> Cell | None:
        """Do an action while the walk of the next one begins; return the cell where its block was seen, if it has one.

        Where the ticks aren't known, or no next action is, each action waits for the end of the one before. Whatever
        isn't as planned ends the walk: every key goes up, and the agent goes back to see what was done.

        Args:
            leg: the action.
            after: the one that follows; None if it isn't known.
            built: the cells that hold a block already, and the block's id there as the debug screen shows it.
            shown_id: the id of the block that is placed.
        """
        overlap = self._overlap
        self._waits -= not overlap.is_under_way and self._waits > 0
        if not leg.sign or (self._waits and not overlap.is_under_way):
            return self._do(leg, built, shown_id)
        if not overlap.is_known and after is not None and self._observer.tick_phase.is_known:
            overlap.begin()
        if not overlap.is_known:
            return self._do(leg, built, shown_id)
        try:
            is_done = overlap.go(leg, after, built, shown_id)
        except NotConfirmedError:
            is_done = False
        if not is_done:
            return self._end_overlap(leg, built, shown_id)
        if not overlap.is_under_way:
            self._locomotion.set_coasting(overlap.state)
        self._losses = 0 if self._losses and self._since_loss >= TRUSTED else self._losses
        self._since_loss += 1
        self.effort.moves += 1
        self.effort.overlapped += overlap.is_under_way
        self.effort.clicks += leg.places
        return front_of(leg.cell) if leg.places else None

    def _end_overlap(self, leg: Leg, built: Mapping[Cell, str], shown_id: str) -> Cell | None:
        """Release every key, and do what is left of the action once the agent stands still.

        The next actions don't overlap, the more of them the more often that happens.
        """
        self._controller.release_all()
        state = None if self._overlap.has_pressed else self._overlap.state
        self._overlap.end()
        self._locomotion.set_coasting(state)
        if state is not None:
            return self._do(leg, built, shown_id)
        self.effort.corrections += 1
        self._losses, self._since_loss = min(self._losses + 1, MOST_LOSSES), 0
        self._waits = 2**self._losses
        self._journal.note("fails", problem=f"a walk was not felt as planned: {self._waits} actions don't overlap now")
        return self._find_out(leg, built, shown_id)

    def _do(self, leg: Leg, built: Mapping[Cell, str], shown_id: str) -> Cell | None:
        """Do an action, and wait for its end."""
        self._overlap.end()
        if leg.places:
            return self.build(leg.cell, built, shown_id)
        self.check_front(self.move_to(leg.cell), built)
        return None

    def _find_out(self, leg: Leg, built: Mapping[Cell, str], shown_id: str) -> Cell | None:
        """Do what is left of an action that didn't come as planned, once the agent stands still."""
        has_clicked = self._overlap.has_clicked
        state, _ = self._locomotion.follow_to_end(self._observer.look_and_check())
        for other in self._overlap.may_have_hit(state.end):
            behind = other[0], other[1] - 1
            if not is_inside(behind, self._arena.size) or behind in built:
                raise NotConfirmedError(
                    f"a click may have placed a block in cell {other}, which can't be looked at: start the episode over"
                )
            self.check_front(self.move_to(behind, tries_made=1), built)
        if not has_clicked:
            return self._do(leg, built, shown_id)
        self.move_to(leg.cell, tries_made=1)
        front = front_of(leg.cell)
        is_placed = self._is_placed(leg.cell, self._arena.block_of(front), shown_id)
        return front if is_placed else self.place(leg.cell, shown_id)

    def move_to(self, cell: Cell, tries_made: int = 0) -> PoseEstimate:
        """Walk until the agent stops within the tolerance of a cell's middle, and return the last pose seen.

        Nothing is pressed if it does so already. ``tries_made`` are the holds that this move has taken before.
        """
        state, pose = self._locomotion.follow_to_end(self._observer.look_and_check())
        for attempt in range(tries_made, self._limits.tries):
            if self._ends_in(state, cell):
                break
            state, pose = self._step(state, pose, cell, attempt)
        if not self._ends_in(state, cell):
            raise NotConfirmedError(
                f"cell {cell} was not reached in {self._limits.tries} tries, the agent is at {pose}: "
                "is something in the way, the chat or a menu open, or auto-jump on?"
            )
        return pose

    def build(self, cell: Cell, built: Mapping[Cell, str], shown_id: str) -> Cell:
        """Walk to a cell, place a block in front of it, and return the cell where the block was seen.

        The click goes out while the agent still moves if it is right wherever the agent comes to a stop. The game gets
        it after the release of the key, in order. So it finds the agent between where it was seen last and its end. An
        agent that was carried on, but is still in the cell, walks back before it looks whether the block is there.

        Args:
            cell: where to stand.
            built: the cells that hold a block already, and the block's id there as the debug screen shows it.
            shown_id: the block's id as the debug screen shows it.
        """
        front = front_of(cell)
        block = self._arena.block_of(front)
        clicked: list[PoseEstimate] = []

        def click_early(pose: PoseEstimate) -> None:
            if clicked or not self._looks_at_floor(pose, block):
                return
            if is_click_right(pose.position, self._locomotion.end_if_late, cell, self._arena.size):
                self._click(0, lambda seen: self._looks_at_floor(seen, block) and hits_floor(seen.position, cell))
                clicked.append(pose)

        state, pose = self._locomotion.follow_to_end(self._observer.look_and_check())
        is_there = self._ends_in(state, cell)
        if not is_there:
            state, pose = self._step(state, pose, cell, 0, click_early)
        if not clicked:
            pose = self.move_to(cell, tries_made=0 if is_there else 1)
            self.check_front(pose, built)
            return self.place(cell, shown_id, pose)
        if cell_at(state.end) != cell:
            raise NotConfirmedError(
                f"the agent was carried on while it clicked, past cell {cell}, to {pose}: does something push it?"
            )
        if not hits_floor(state.end, cell):
            # A click from within the cell places the block in front or none: the game refuses one in its own cell.
            self.move_to(cell, tries_made=1)
        is_placed = self._is_placed(cell, block, shown_id)
        return front if is_placed else self.place(cell, shown_id)

    def check_front(self, pose: PoseEstimate, built: Mapping[Cell, str]) -> None:
        """Check that the agent looks at what should be there: one of its own blocks in the next cell, or the floor.

        A block too many, or a missing one, is an error whatever its cause. Outside the arena nothing is known.
        """
        front = front_of(pose.cell)
        if not is_inside(front, self._arena.size):
            return
        x, y, z = block = self._arena.block_of(front)
        own = built.get(front)

        def is_right(seen: PoseEstimate) -> bool:
            if seen.target is None or seen.target.pos is None:
                return own is None
            return seen.target.pos == (x, y - 1, z) if own is None else seen.target == Target(block, own)

        if not is_right(pose):
            seen = self._observer.watch(is_right, self._limits.confirm_s)
            if not is_right(seen):
                also = f", or is {_USE} not set to Hold" if own is None else ""
                raise NotConfirmedError(
                    f"{own or 'only the floor'} should be at {block}, the screen says "
                    f"{_words(seen.target)}: did somebody else build there{also}?"
                )

    def check_floor_ahead(self) -> None:
        """Check that no block is left in front of the cell in which the agent stands; presses nothing."""
        self.check_front(self._observer.look_and_check(), {})

    def check_ground_is_named(self, version: str) -> None:
        """Check that the debug screen names the block ahead, where there is always one; presses nothing.

        Where the entry is off, it looks as if no block were looked at (FACTS: The F3 debug screen).
        """
        if self._observer.watch(lambda pose: pose.target is not None, self._limits.confirm_s).target is None:
            raise NotConfirmedError(f"{NONE_NAMED}: if that line is off, {switch_on(version)}")

    def place(self, cell: Cell, shown_id: str, pose: PoseEstimate | None = None) -> Cell:
        """Place a block in front of ``cell``, where the agent stands or stops, and return the cell where it was seen.

        A click goes out only while the agent looks at the floor there, so never onto a block that stands already.

        Args:
            cell: where the agent stands, or stops, within the tolerance.
            shown_id: the block's id as the debug screen shows it.
            pose: what was just seen; None looks first.
        """
        front = front_of(cell)
        block = self._arena.block_of(front)
        for attempt in range(self._limits.tries):
            if attempt or pose is None or not self._is_aimed(pose, cell, block):
                pose = self._aim(cell, block, may_walk=attempt == 0)
            self._click(attempt, lambda seen: self._is_aimed(seen, cell, block))
            self._wait_for_click()
            if self._is_placed(cell, block, shown_id):
                return front
        raise NotConfirmedError(
            f"no {shown_id} was seen at {block} after {self._limits.tries} clicks: is the block in the agent's hand?"
        )

    def _step(
        self,
        state: CoastingState,
        pose: PoseEstimate,
        cell: Cell,
        attempt: int,
        on_look: Callable[[PoseEstimate], None] = lambda _: None,
    ) -> tuple[CoastingState, PoseEstimate]:
        """Walk one hold towards a cell; return the agent's state after it, and the last pose seen."""
        self._observer.permit_press()
        offset = GroundVector(cell[0] - state.end.right, cell[1] - state.end.forward)
        if max(abs(offset.right), abs(offset.forward)) >= FAR:
            raise NotConfirmedError(f"cell {cell} is no neighbour of the agent's, it is at {pose}: was it carried off?")
        self.effort.moves += attempt == 0
        self.effort.corrections += attempt > 0
        return self._locomotion.follow_to_end(self._locomotion.walk(state, offset), on_look)

    def _click(self, attempt: int, is_right: Callable[[PoseEstimate], bool]) -> None:
        self._observer.permit_press(is_right)
        self._journal.note("clicks", attempt=attempt)
        self._controller.click("right")
        self.effort.clicks += attempt == 0
        self.effort.second_clicks += attempt > 0

    def _aim(self, cell: Cell, block: Block, *, may_walk: bool) -> PoseEstimate:
        """Wait until the agent looks at the floor below ``block`` from ``cell``.

        An agent that a late release carried on walks back if it may, which is as long as nothing was clicked.
        """

        def watch() -> PoseEstimate:
            seen = self._observer.watch(lambda pose: self._is_aimed(pose, cell, block), self._limits.confirm_s)
            return check_pose(seen)

        pose = watch()
        if may_walk and not self._may_click(pose, cell):
            # It is known where this walk ends while the agent still coasts there.
            self.move_to(cell, tries_made=1)
            pose = watch()
        if not self._looks_at_floor(pose, block):
            raise NotConfirmedError(
                f"the floor at {_below(block)} must be looked at before placing, the screen says "
                f"{_words(pose.target)}: is the cell free, the looked-at block on the debug screen, and {_USE} set to "
                "Hold?"
            )
        if not self._may_click(pose, cell):
            raise NotConfirmedError(
                f"the agent left cell {cell} before placing, it is at {pose}: does something push it?"
            )
        return pose

    def _is_aimed(self, pose: PoseEstimate, cell: Cell, block: Block) -> bool:
        return self._looks_at_floor(pose, block) and self._may_click(pose, cell)

    def _looks_at_floor(self, pose: PoseEstimate, block: Block) -> bool:
        return pose.target is not None and pose.target.pos == _below(block)

    def _may_click(self, pose: PoseEstimate, cell: Cell) -> bool:
        """Return whether the agent stands or coasts where a click is right, from now until it stops.

        An agent whose position fits no path may still be walking, and only pass by.
        """
        state = self._locomotion.coasting_at(pose.position)
        if state is None:
            return False
        return is_near(state.end, cell, self._limits.tolerance) and is_near(pose.position, cell, COASTING_CLICK)

    def _wait_for_click(self) -> None:
        """Wait until the effect of a click may be seen."""
        tick_phase = self._observer.tick_phase
        if tick_phase.is_known:
            self._observer.wait_for_step(tick_phase.next(self._clock.now() + self._input_latency_s))
        else:
            self._controller.wait(self._input_latency_s)

    def _is_placed(self, cell: Cell, block: Block, shown_id: str) -> bool:
        """Return whether the block is seen in time; another block there, or the agent elsewhere, is an error."""
        placed = Target(block, shown_id)
        pose = check_pose(self._observer.watch(lambda pose: pose.target == placed, self._limits.confirm_s))
        seen = pose.target
        if seen is not None and seen.pos == block and seen.id != shown_id:
            raise NotConfirmedError(f"{_words(seen)} was placed, not {shown_id}: correct [blocks] in the profile")
        if seen != placed:
            return False
        self._observer.note_awaited_step()
        if pose.cell != cell:
            raise NotConfirmedError(f"the agent left cell {cell} while placing, it is at {pose}")
        return True

    def _ends_in(self, state: CoastingState, cell: Cell) -> bool:
        return is_near(state.end, cell, self._limits.tolerance) and cell_at(state.position) == cell


_USE = "Options > Controls > Use Item/Place Block"
"""Where that says Toggle, one click goes on placing, and the agent builds on as it walks (FACTS: Keys)."""


def _below(block: Block) -> Block:
    return block[0], block[1] - 1, block[2]


def _words(target: Target | None) -> str:
    if target is None:
        return "that no block is looked at"
    return f"{target.id or 'a block'} at {target.pos or 'an unknown position'}"
