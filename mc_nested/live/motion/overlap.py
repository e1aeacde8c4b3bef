"""Overlap: does one action while the next one's walk begins. It looks once in each tick, when its step is surely seen.

look: where the walker must be after that tick, and what it must look at -> a click or a key, in the middle of a gap

The first thing that is not as planned ends it: every key goes up, and the body finds out what was done (Body.go_on).
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise

from mc_nested.arena.action import Cell
from mc_nested.arena.rules import front_of, is_inside
from mc_nested.live.connection import GameConnection
from mc_nested.live.model.coordinates import GroundVector, cell_at
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.reading import Target
from mc_nested.live.model.timing import EARLY_LOOK_S, HALF_FRAME_S, THIRD_FRAME_S, surely_seen_after
from mc_nested.live.motion.locomotion import Locomotion
from mc_nested.live.motion.overlap_plan import FORWARD, SEEN_TICKS, Leg, Planner, Surroundings, Walk, WalkPlan
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseObserver
from mc_nested.live.motion.walk_tracker import MATCH, SLIPPERY, SLIPPERY_MATCH, CoastingState
from mc_nested.live.profile.tables import Profile

SPRINT_TICKS = 7.5
"""Ticks between two presses of forward, or the second one sprints (FACTS: Walking)."""

LOOK_S = THIRD_FRAME_S / 2
"""Seconds that a look takes, about, before what it permits is pressed."""

TOO_LATE_S = TICK_S / 2 - HALF_FRAME_S
"""Seconds after the middle of a gap from which on a press may be felt a tick later."""

EARLY_S = TICK_S / 2 + EARLY_LOOK_S
"""Seconds before a step is surely seen at which it may be seen first."""

SHOWN_TICKS = 3
"""Ticks after the gap of a click within which its block is seen: it is felt a tick late at most, and shown for two."""

SWEEP = 0.05
"""Blocks between two places at which a late click is looked into."""


@dataclass
class _Action:
    """An action that is under way, and what was seen of it."""

    leg: Leg
    after: Leg | None
    plan: WalkPlan
    planner: Planner
    built: Mapping[Cell, str]
    shown_id: str
    was_there: bool = False
    sees_floor: bool = False
    is_clicked: bool = False
    is_front_right: bool = False
    swept: list[GroundVector] = field(default_factory=list)

    def is_done(self, tick: int) -> bool:
        """Return whether all of it was seen by that tick: the end of its walk, the cell, and what stands in front."""
        return self.was_there and self.is_front_right and tick > self.plan.release

    @property
    def last_tick(self) -> int:
        """The last tick after which it can be seen to be done."""
        plan = self.plan
        late = plan.stop + SEEN_TICKS if plan.click is None or not self.is_clicked else plan.click + SHOWN_TICKS
        return max(late, plan.release + 1)


class Overlap:
    """The walk that is under way, from the end of one action into the next.

    Raises (everything): what the pose observer and the input controller raise.
    """

    def __init__(
        self, profile: Profile, connection: GameConnection, observer: PoseObserver, locomotion: Locomotion
    ) -> None:
        self._keys, self._limits, self._inertia = profile.keys, profile.body, profile.walk.inertia
        self._arena = profile.marked_arena()
        self._locomotion = locomotion
        self._controller = connection.controller
        self._clock = connection.devices.clock
        self._journal = connection.journal
        self._observer = observer
        self._sure_s = surely_seen_after(profile.walk.capture_latency_s)
        self._mid_s = TICK_S / 2 - profile.walk.input_latency_s
        self._lag = math.ceil((self._sure_s + LOOK_S - self._mid_s) / TICK_S)
        self._slack = SLIPPERY_MATCH if self._inertia > SLIPPERY else MATCH
        self._walk: Walk | None = None
        self._anchor = 0.0
        self._presses: list[tuple[int, Leg, int]] = []
        self._action: _Action | None = None
        self.is_under_way = False
        """Whether the walk of the next action has begun."""
        self.has_pressed = False
        """Whether anything was pressed for the last action, or is down for it."""

    @property
    def state(self) -> CoastingState | None:
        """The walker as it was seen last; None where it isn't known."""
        return None if self._walk is None else self._walk.state

    @property
    def is_known(self) -> bool:
        """Whether it is known where the walker is, and which keys it feels."""
        return self._walk is not None

    def end(self) -> None:
        """Forget the walk; the caller releases the keys."""
        self._walk, self._presses, self.is_under_way = None, [], False

    def begin(self) -> None:
        """Look where the walker is, with every key up."""
        self._anchor = self._observer.tick_phase.next(self._clock.now() - self._sure_s)
        self._controller.wait_until(self._anchor + self._sure_s)
        state = self._locomotion.coasting_at(self._look().position)
        self._walk = None if state is None else Walk(0, state)

    def go(self, leg: Leg, after: Leg | None, built: Mapping[Cell, str], shown_id: str) -> bool:
        """Do an action, and begin the walk of the one after it; return whether all came as planned.

        The arguments are those of ``Body.go_on``.
        """
        self.has_pressed, self._action = self.is_under_way, None
        around = Surroundings.seen_at(self._limits.pitch, self._arena.size, built)
        planner = Planner(around, self._locomotion.push, self._lag, self._limits.tolerance)
        first, free = self._first_gap(), self._sprint_gap()
        press = None if self.is_under_way else max(first, free) if (leg.axis, leg.sign) == FORWARD else first
        self.is_under_way = False
        for following in dict.fromkeys((after, None)):
            plan = None if self._walk is None else planner.plan(self._walk, leg, press, first, following, free)
            if plan is not None:
                self._action = action = _Action(leg, following, plan, planner, built, shown_id)
                self._schedule(action, press)
                is_done = self._is_done(action)
                self.is_under_way = is_done and following is not None
                return is_done
        return False

    def may_have_hit(self, end: GroundVector) -> set[Cell]:
        """Return the other cells where the last action's click may have placed a block; the walker stopped at ``end``.

        It was felt before the keys were, so somewhere on the way.
        """
        action, found = self._action, set[Cell]()
        if action is None or not action.is_clicked:
            return found
        for one, other in pairwise([*action.swept, end]):
            right, forward = other.right - one.right, other.forward - one.forward
            steps = 1 + math.ceil(max(abs(right), abs(forward)) / SWEEP)
            for step in range(steps + 1):
                felt_at = GroundVector(one.right + step / steps * right, one.forward + step / steps * forward)
                if cell := action.planner.around.landing(felt_at):
                    found.add(cell)
        return found - {front_of(action.leg.cell)}

    @property
    def has_clicked(self) -> bool:
        """Whether the last action's click was sent."""
        return self._action is not None and self._action.is_clicked

    def _is_done(self, action: _Action) -> bool:
        """Look on, tick by tick, and return whether the action was seen to be done, as planned."""
        looked_at = -math.inf
        while self._walk is not None:
            tick = self._next_tick(self._walk)
            if tick > action.last_tick:
                return False
            sure_at = self._time_of_look(tick)
            look_at = max(sure_at - self._early_s(action, self._walk, tick), looked_at + THIRD_FRAME_S)
            if not self._send(action, look_at):
                return False
            self._controller.wait_until(look_at)
            looked_at = self._clock.now()
            pose = self._look()
            states = self._walk.states(tick)
            off = states[-1].position.minus(pose.position)
            if max(abs(off.right), abs(off.forward)) > self._slack:
                if looked_at < sure_at + THIRD_FRAME_S:
                    continue  # the picture is an older one
                return False
            state = CoastingState(pose.position, states[-1].velocity, self._inertia)
            self._walk = replace(self._walk, tick=tick, state=state)
            if action.is_clicked:
                action.swept.append(pose.position)
            if not self._is_right(action, pose, states[-2].position):
                return False
            if action.is_done(tick):
                return True
        return False

    def _early_s(self, action: _Action, walk: Walk, tick: int) -> float:
        """Return how long before a step is surely seen looks for it begin: early while a block is awaited."""
        before, after = (state.position for state in walk.states(tick)[-2:])
        off = after.minus(before)
        is_awaited = action.plan.click is not None and action.is_clicked and tick > action.plan.click
        return EARLY_S if is_awaited and max(abs(off.right), abs(off.forward)) > 2 * SLIPPERY_MATCH else 0.0

    def _is_right(self, action: _Action, pose: PoseEstimate, eyes: GroundVector) -> bool:
        """Take in what is looked at from where the eyes were; return whether it is what must stand there."""
        leg, front = action.leg, front_of(action.leg.cell)
        action.was_there |= leg.cell in (cell_at(pose.position), cell_at(eyes))
        if not is_inside(front, self._arena.size):
            action.is_front_right |= not leg.places
        cell = action.planner.around.looked_at(eyes)
        if cell is None or pose.target is None or pose.target.pos is None or not is_inside(cell, self._arena.size):
            return True
        x, y, z = block = self._arena.block_of(cell)
        own = action.built.get(cell)
        is_floor = pose.target.pos == (x, y - 1, z)
        is_right = is_floor if own is None else pose.target == Target(block, own)
        if cell != front:
            return is_right
        if action.is_clicked and pose.target == Target(block, action.shown_id):
            action.is_front_right = True
            return True
        action.sees_floor |= is_floor
        action.is_front_right |= is_right and not leg.places
        return is_right

    def _schedule(self, action: _Action, press: int | None) -> None:
        """Note what is to be pressed when, and when the keys that are down go up."""
        plan, walk = action.plan, self._walk
        up = plan.stop if plan.start is None else plan.release
        self._presses = [(gap, leg, up) for gap, leg, _ in self._presses]
        if press is not None:
            self._presses = [(press, action.leg, up)]
        else:
            self._controller.keep_until(self._time(up), self._key(action.leg))
        if plan.start is not None and action.after is not None:
            self._presses.append((plan.start, action.after, plan.stop))
        changes = plan.changes if action.after is None else plan.changes[:-1]
        self._walk = walk and replace(walk, changes=changes)

    def _send(self, action: _Action, until: float) -> bool:
        """Press and click what is due before a look; return whether it went out in time."""
        while True:
            click = None if action.is_clicked else action.plan.click
            gaps = [gap for gap, _, _ in self._presses] + ([] if click is None else [click])
            if not gaps or self._time(min(gaps)) > until:
                return True
            at = self._time(min(gaps))
            self._controller.wait_until(at)
            if self._clock.now() > at + TOO_LATE_S:
                return False
            if self._presses and self._presses[0][0] == min(gaps):
                self._press(*self._presses.pop(0))
            elif not self._sends_click(action):
                return False

    def _press(self, gap: int, leg: Leg, up: int) -> None:
        key = self._key(leg)
        self._journal.note("plans", key=key, ticks=up - gap, sneak=False)
        self.has_pressed = True
        self._controller.press(self._time(up), key)
        self._controller.keep_until(self._time(up), key)
        if (leg.axis, leg.sign) == FORWARD:
            self._locomotion.forward_at = self._clock.now()

    def _sends_click(self, action: _Action) -> bool:
        """Click, if the floor was seen, or is that of the cell just left; return whether the click was sent."""
        walk, gap = self._walk, action.plan.click
        if walk is None or gap is None or not (action.sees_floor or (action.leg.axis, action.leg.sign) == (1, -1)):
            return False
        self._observer.permit_press(lambda _: False)  # a later click would be another one
        self._journal.note("clicks", attempt=0)
        self._controller.click("right")
        action.is_clicked = True
        action.swept.append(walk.positions(gap)[gap])
        return True

    def _look(self) -> PoseEstimate:
        pose = self._observer.look_and_check()
        self._observer.permit_press()
        return pose

    def _key(self, leg: Leg) -> str:
        keys = self._keys
        return ((keys.left, keys.right), (keys.back, keys.forward))[leg.axis][leg.sign > 0]

    def _time_of_tick(self, tick: int) -> float:
        return self._observer.tick_phase.next(self._anchor + (tick - 0.5) * TICK_S)

    def _time(self, gap: int) -> float:
        """Return when something is sent that is to reach the game in the middle of a gap."""
        return self._time_of_tick(gap) + self._mid_s

    def _time_of_look(self, tick: int) -> float:
        return self._time_of_tick(tick) + self._sure_s

    def _first_gap(self) -> int:
        return math.ceil((self._clock.now() + LOOK_S - self._time(0)) / TICK_S)

    def _sprint_gap(self) -> int:
        """Return the first gap in which forward can be pressed without sprinting."""
        if math.isinf(self._locomotion.forward_at):
            return -(10**9)
        return math.ceil((self._locomotion.forward_at + SPRINT_TICKS * TICK_S - self._time(0)) / TICK_S)

    def _next_tick(self, walk: Walk) -> int:
        """Return the tick whose step is looked at next: a later one, if the time of the next look has passed."""
        late = self._clock.now() - self._time_of_look(walk.tick + 1) - HALF_FRAME_S
        return walk.tick + 1 + max(0, math.ceil(late / TICK_S))
