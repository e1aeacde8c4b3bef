"""Locomotion: holds that end between two of the game's ticks, and the agent's state after them."""

from collections.abc import Callable

from mc_nested.live.connection import GameConnection
from mc_nested.live.model.coordinates import GroundVector
from mc_nested.live.model.kinematics import TICK_S, plan_hold, push_of
from mc_nested.live.motion.key_hold import KeyHold
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseObserver
from mc_nested.live.motion.standstill import Standstill
from mc_nested.live.motion.walk_tracker import CoastingState, Hold, WalkTracker
from mc_nested.live.profile.tables import Profile

MIN_RESPONSE_S = 0.015
"""Seconds in which no effect of a press is seen: an event takes 5 ms to the game, a picture 10 ms back."""

SHORT_HOLD_TICKS = 2
"""Ticks of a hold that ends before the step of its first tick can be seen."""

SURELY_SEEN_S = 0.053
"""Seconds after a tick at which its step is certainly on the screen, and the next one's can't be."""

MAX_SHIFT_S = 1.2 * TICK_S
"""Seconds that a look during a hold may move its release by: a tick felt more or less, not the length of a stall."""


class Locomotion:
    """Walks, one hold at a time, and knows where the agent comes to a stop.

    Raises (everything): what the pose observer and the input controller raise.
    """

    def __init__(self, profile: Profile, connection: GameConnection, observer: PoseObserver) -> None:
        self._keys = profile.keys
        self._limits = profile.body
        self._walk = profile.walk
        self._push = push_of(profile.walk.covered, profile.walk.inertia)
        self._controller = connection.controller
        self._observer = observer
        self._key_hold = KeyHold(connection, observer, profile.body.patience_s)
        self._clock = connection.devices.clock
        self._tracker = self._tracker_at_rest(GroundVector(0.0, 0.0))

    def set_standing(self, pose: PoseEstimate) -> None:
        """Take the agent to be standing still, as after a teleport."""
        self._tracker = self._tracker_at_rest(pose.position)

    def coasting_at(self, position: GroundVector) -> CoastingState | None:
        """The state of an agent seen there, by the hold that it was in; None if that isn't certain."""
        return self._tracker.coasting_at(position)

    def walk(self, state: CoastingState, offset: GroundVector) -> PoseEstimate:
        """One hold, along the axis with the larger offset; the pose seen after it.

        Args:
            state: the agent's state now.
            offset: blocks, right and forward, from where it would come to a stop to where it should.
        """
        axis = 1 if abs(offset.forward) >= abs(offset.right) else 0
        sign = 1 if offset[axis] > 0 else -1
        plan = plan_hold(abs(offset[axis]), self._walk.covered, self._limits.tolerance, self._walk.sneaking)
        is_sneaking = plan.gait == "sneak"
        push = self._push * (self._walk.sneaking if is_sneaking else 1.0)
        self._tracker = WalkTracker(state, Hold(axis, sign, plan.ticks, push), self._walk.inertia)
        keys = self._keys
        key = ((keys.left, keys.right), (keys.back, keys.forward))[axis][sign > 0]
        self._hold(plan.ticks, *([keys.sneak] if is_sneaking else []), key)
        return self._observer.look_and_check()

    @property
    def end_if_late(self) -> GroundVector:
        """Where the agent comes to a stop if its hold was felt a tick longer than planned."""
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
                state = CoastingState(seen.position, GroundVector(0.0, 0.0), self._walk.inertia)
            if state is None:
                on_look(seen)
                return False
            states.append(state)
            return True

        pose = self._key_hold.follow(pose, is_certain)
        self._observer.note_awaited_step()
        self._tracker = WalkTracker(states[0], None, self._walk.inertia)
        return states[0], pose

    def _tracker_at_rest(self, position: GroundVector) -> WalkTracker:
        state = CoastingState(position, GroundVector(0.0, 0.0), self._walk.inertia)
        return WalkTracker(state, None, self._walk.inertia)

    def _hold(self, ticks: int, *keys: str) -> None:
        """Hold keys so that exactly so many ticks feel them, if the tick phase is known; then wait for the next step.

        A key that goes down or up at the moment of a tick may be felt by that tick or by the next. So a short hold
        starts between two ticks. A long one looks, while the key is down, how many ticks have felt it, and ends between
        two.
        """
        now, tick_phase = self._clock.now(), self._observer.tick_phase
        mid_tick = TICK_S / 2 - self._walk.input_latency_s
        if not tick_phase.is_known:
            self._key_hold.hold(now + ticks * TICK_S, *keys)
            self._controller.wait(MIN_RESPONSE_S)
            return
        if ticks <= SHORT_HOLD_TICKS:
            self._controller.wait_until(tick_phase.next(now, mid_tick))
            release_at = self._key_hold.hold(self._clock.now() + ticks * TICK_S, *keys)
        else:
            planned = now + ticks * TICK_S
            tick = tick_phase.next(now + TICK_S / 2)

            def timed_release() -> float | None:
                ticks_held = self._ticks_held()
                timed = None if ticks_held is None else tick + (ticks - ticks_held) * TICK_S + mid_tick
                return timed if timed is not None and abs(timed - planned) <= MAX_SHIFT_S else None

            look_times = (tick + SURELY_SEEN_S,)
            release_at = self._key_hold.hold(planned, *keys, look_times=look_times, on_look=timed_release)
        self._observer.wait_for_step(release_at - mid_tick + TICK_S)

    def _ticks_held(self) -> int | None:
        """How many ticks have felt the key that is down, by a look at the screen; None if that isn't certain."""
        position = self._observer.read_position()
        return self._tracker.ticks_held(position) if position else None
