"""Locomotion: holds that end between two of the game's ticks, and the agent's state after them."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.live.connection import GameConnection
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import TICK_S, plan_hold, push_of
from mc_nested.live.model.timing import HALF_FRAME_S, surely_seen_after
from mc_nested.live.motion.key_hold import KeyHold, Standstill
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseObserver
from mc_nested.live.motion.walk_tracker import AT_REST, CoastingState, Hold, WalkTracker
from mc_nested.live.profile.tables import Profile

MAX_SHIFT_S = 1.2 * TICK_S
"""Seconds that a look during a hold may move its release by: a tick felt more or less, not the length of a stall."""

SPRINT_WINDOW_S = 7 * TICK_S
"""Seconds: forward that is felt again sooner than this after it was felt sprints (FACTS: Walking)."""

SHORT_TICKS = 2
"""Ticks of a hold that a frame, at ten a second, can make twice as long."""

NOWHERE = GroundVector(1e6, 1e6)
"""A place from which no walk leads to an arena."""

LOST = 0.5
"""The share of its way that a hold has covered at least, unless it was lost or felt for too short a time."""


@dataclass(frozen=True)
class _Walked:
    """A hold, where the agent would have stopped before it, and the distance that was planned."""

    begin: GroundVector
    hold: Hold
    distance: float


class Locomotion:
    """Walks, one hold at a time, and knows where the agent comes to a stop.

    Raises (everything): what the pose observer and the input controller raise.
    """

    def __init__(self, profile: Profile, connection: GameConnection, observer: PoseObserver) -> None:
        self._keys = profile.keys
        self._limits = profile.body
        self._walk = profile.walk
        self._surely_seen_s = surely_seen_after(profile.walk.capture_latency_s)
        self.push = push_of(profile.walk.covered, profile.walk.inertia)
        """What a held key adds to each tick's step, in blocks."""
        self._controller = connection.controller
        self._observer = observer
        self._key_hold = KeyHold(connection, observer, profile.body.patience_s)
        self._clock = connection.devices.clock
        self._journal = connection.journal
        self._tracker = WalkTracker(CoastingState(AT_REST, AT_REST), None, profile.walk.inertia)
        self._walked: _Walked | None = None
        self._more_ticks = 0
        self._must_sneak = False
        self.forward_at = -math.inf
        """When forward was pressed last, in seconds of the clock."""

    def set_coasting(self, state: CoastingState | None) -> None:
        """Take the agent to have been seen so, with every key up; None where that isn't known."""
        self._tracker = WalkTracker(state or CoastingState(NOWHERE, AT_REST), None, self._walk.inertia)
        self._walked, self._more_ticks, self._must_sneak = None, 0, False

    def coasting_at(self, position: GroundVector) -> CoastingState | None:
        """Return the state of an agent seen there, by the hold that it was in; None if that isn't certain."""
        return self._tracker.coasting_at(position)

    def walk(self, state: CoastingState, offset: GroundVector) -> PoseEstimate:
        """Walk by one hold, along the axis with the larger offset, and return the pose seen after it.

        Args:
            state: the agent's state now.
            offset: blocks, right and forward, from where it would come to a stop to where it should.
        """
        axis = 1 if abs(offset.forward) >= abs(offset.right) else 0
        sign = 1 if offset[axis] > 0 else -1
        keys, walk = self._keys, self._walk
        key = ((keys.left, keys.right), (keys.back, keys.forward))[axis][sign > 0]
        if key == keys.forward:
            state = self._wait_for_sprint_window(state)
        distance = abs(offset[axis])
        tolerance = self._limits.tolerance
        plan = plan_hold(distance, walk.covered, tolerance, walk.sneaking, must_sneak=self._must_sneak)
        ticks = plan.ticks + self._more_ticks
        sneak = keys.sneak if plan.gait == "sneak" else None
        hold = Hold(axis, sign, ticks, self.push * (walk.sneaking if sneak else 1.0))
        self._tracker = WalkTracker(state, hold, walk.inertia)
        self._walked = _Walked(state.end, hold, distance)
        self._journal.note("plans", key=key, ticks=ticks, sneak=sneak is not None)
        if sneak:
            self._key_hold.begin_sneaking(sneak)
        self._hold(ticks, key, sneak)
        if key == keys.forward:
            self.forward_at = self._key_hold.pressed_at
        return self._observer.look_and_check()

    @property
    def end_if_late(self) -> GroundVector:
        """The position at which the agent stops if its hold was felt a tick longer than planned."""
        return self._tracker.end_if_late

    def follow_to_end(
        self, pose: PoseEstimate, on_look: Callable[[PoseEstimate], None] = lambda _: None
    ) -> tuple[CoastingState, PoseEstimate]:
        """Look until it is certain where the agent stops: by the hold that it was in, or because it stands still.

        ``on_look`` gets each pose that is seen before that. Returns the agent's state and the last pose.
        """
        standstill = Standstill(pose.position, self._clock.now(), self._limits.settle_s)
        states: list[CoastingState] = []

        def is_certain(seen: PoseEstimate) -> bool:
            state = self._tracker.coasting_at(seen.position)
            if state is None and standstill.is_reached(seen.position, self._clock.now()):
                state = CoastingState(seen.position, AT_REST, self._walk.inertia)
            if state is None:
                on_look(seen)
                return False
            states.append(state)
            return True

        pose = self._key_hold.follow(pose, is_certain)
        self._observer.note_awaited_step()
        self._learn_from(states[0])
        self._tracker = WalkTracker(states[0], None, self._walk.inertia)
        return states[0], pose

    def _learn_from(self, state: CoastingState) -> None:
        """Let the next hold be another one if the last was not felt as it was held.

        Below 20 frames a second, and on a busy machine, a short hold may be lost, or be felt as a longer one; the same
        again could be so for ever. So a hold that was lost makes the next one longer, and one that led too far lets
        the next one sneak.
        """
        walked, self._walked = self._walked, None
        if walked is None:
            return
        hold = walked.hold
        covered = (state.end[hold.axis] - walked.begin[hold.axis]) * hold.sign
        self._more_ticks = self._more_ticks + 1 if covered < LOST * walked.distance else 0
        self._must_sneak = hold.ticks <= SHORT_TICKS and covered > walked.distance + self._limits.tolerance

    def _wait_for_sprint_window(self, state: CoastingState) -> CoastingState:
        """Wait until forward can be pressed without sprinting, and return the agent's state then."""
        # One press comes later than another to the game by chance, by less than half a tick.
        over_at = self.forward_at + SPRINT_WINDOW_S + TICK_S / 2
        if over_at <= self._clock.now():
            return state
        self._controller.wait_until(over_at)
        pose = self._observer.look_and_check()
        self._observer.permit_press()
        return self._tracker.coasting_at(pose.position) or state

    def _hold(self, ticks: int, key: str, sneak: str | None) -> None:
        """Hold a key so that exactly so many ticks feel it, if the tick phase is known; then wait for the next step.

        A key that goes down or up at the moment of a tick may be felt by that tick or by the next. So a short hold
        starts between two ticks. A long one looks, while the key is down, how many ticks have felt it, and ends between
        two.
        """
        now, tick_phase = self._clock.now(), self._observer.tick_phase
        mid_tick = TICK_S / 2 - self._walk.input_latency_s
        if not tick_phase.is_known:
            self._key_hold.hold(now + ticks * TICK_S, key, sneak=sneak)
            self._controller.wait(self._walk.input_latency_s)
            return
        if ticks * TICK_S <= 1.5 * TICK_S + self._surely_seen_s + HALF_FRAME_S:
            # It ends before the step of its first tick can be seen.
            look_s = self._controller.look_s
            self._controller.wait_until(tick_phase.next(now + look_s, mid_tick) - look_s)
            release_at = self._key_hold.hold(self._clock.now() + ticks * TICK_S, key, sneak=sneak)
        else:
            planned = now + ticks * TICK_S
            tick = tick_phase.next(now + TICK_S / 2)

            def timed_release() -> float | None:
                position = self._observer.read_position()
                ticks_held = self._tracker.ticks_held(position) if position else None
                timed = None if ticks_held is None else tick + (ticks - ticks_held) * TICK_S + mid_tick
                return timed if timed is not None and abs(timed - planned) <= MAX_SHIFT_S else None

            look_times = (tick + self._surely_seen_s,)
            release_at = self._key_hold.hold(planned, key, sneak=sneak, look_times=look_times, on_look=timed_release)
        self._observer.wait_for_step(release_at - mid_tick + TICK_S)
