"""KeyHold, for play and calibration: keys down until a time, with looks meanwhile; then looks until the walk is over.

press |-- look -- look --| release |-- look -- look -- ... -- the walk is over
         may end it early              keys are released again at a player that goes on

Standstill tells a walker that stands still from a picture that has stalled: on a busy machine both look the same for a
while. After the key is up, each tick's step is 0.546 of the one before (FACTS: Walking): 0.118, 0.064, 0.035 ... 0.003
blocks. A small last step was taken with the key up, and nothing follows it. After a larger one, or none, the game may
only be late.
"""

import math
from collections.abc import Callable, Iterable

from mc_nested.errors import NotConfirmedError
from mc_nested.live.connection import GameConnection
from mc_nested.live.devices import Deadline
from mc_nested.live.input.input_controller import LONGEST_S
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.model.timing import FRAME_S, HALF_FRAME_S, THIRD_FRAME_S
from mc_nested.live.motion.pose_observer import PoseEstimate, PoseObserver

FAST_LOOKS = 6
"""Looks that come fast at first, for two frames: what goes out a little sooner is felt a tick sooner."""

EVERY_LOOK = math.inf
"""``fast_looks`` for a walk that is recorded: every look comes fast."""

SNEAK_FIRST_S = 3 * TICK_S
"""Seconds from the sneak key to the key of a hold: a tick, and a frame where only ten are drawn a second."""

RELEASE_AGAIN_LOOKS = 20
"""Looks at a player that goes on, after which its keys are released once more: a release may have been lost."""


class KeyHold:
    """Holds keys and watches their effect.

    Raises (everything): what the pose observer and the input controller raise; every key is up then.
    """

    def __init__(self, connection: GameConnection, observer: PoseObserver, patience_s: float) -> None:
        self._controller = connection.controller
        self._clock = connection.devices.clock
        self._observer = observer
        self._patience_s = patience_s
        self.pressed_at = -math.inf
        """When the keys of the last hold went down, in seconds of the clock."""

    def begin_sneaking(self, key: str) -> None:
        """Press the sneak key, and wait until it slows the player down: a tick after it is felt (FACTS: Sneaking).

        It stays down for the hold that follows, which names it, however long the look before that takes: without it, a
        player at an edge falls. If none follows, it goes up after the longest time that anything is held.
        """
        ready_at = self._clock.now() + SNEAK_FIRST_S
        release_at = ready_at + LONGEST_S
        ready_at += self._controller.press(release_at, key) - release_at
        self._controller.wait_until(ready_at)

    def hold(
        self,
        release_at: float,
        *keys: str,
        sneak: str | None = None,
        look_times: Iterable[float] = (),
        on_look: Callable[[], float | None] = lambda: None,
    ) -> float:
        """Hold keys of the world until a time; return the time that was last planned for the release.

        Args:
            release_at: when they go up, in seconds of the clock; as much later as the look takes before they go down.
            keys: which, together.
            sneak: the sneak key, which is down already; it goes up with them. Raise NotConfirmedError if it went up
                before.
            look_times: when to look meanwhile. The first one that could make the release late ends the looks.
            on_look: called at each; gives another time for the release, or None to keep it.
        """
        try:
            together = (*keys, sneak) if sneak else keys
            release_at = self._controller.press(release_at, *keys, beside=sneak)
            self.pressed_at = self._clock.now()
            if sneak:
                self._controller.keep_until(release_at, sneak)
            for at in look_times:
                # A look takes a while: the last one must not make the release late.
                if at + HALF_FRAME_S >= release_at:
                    break
                self._controller.wait_until(at)
                if (changed := on_look()) is not None:
                    release_at = changed
                    self._controller.keep_until(release_at, *together)
            self._controller.wait_until(release_at)
        except BaseException:
            self._controller.release_all()
            raise
        return release_at

    def follow(
        self,
        pose: PoseEstimate,
        is_over: Callable[[PoseEstimate], bool],
        fast_looks: float = FAST_LOOKS,
        fast_look_s: float = THIRD_FRAME_S,
    ) -> PoseEstimate:
        """Look, with every key up, until the walk is over, and return the last pose.

        Args:
            pose: the first pose, seen after the release.
            is_over: called with every pose.
            fast_looks: how many of the looks come fast; the others come once a frame.
            fast_look_s: seconds from one fast look to the next.
        """
        patience = Deadline(self._clock, self._patience_s)
        looks = 0
        while not is_over(pose):
            if patience.has_passed:
                raise NotConfirmedError(
                    f"the player does not stand still, it is at {pose}: does something push it, or is a key held down?"
                )
            looks += 1
            if looks % RELEASE_AGAIN_LOOKS == 0:
                self._controller.release_again()
            self._controller.wait(fast_look_s if looks <= fast_looks else FRAME_S)
            pose = self._observer.look_and_check()
        return pose


TAIL = 0.03
"""Blocks: longer than the last four steps of coasting to a stop, shorter than the first step of setting off (0.098)."""

STALL_S = 1.0
"""Seconds at one position that count as standstill if no coasting tail was seen: a long time for a picture to stall."""


CAREFUL_SETTLE_S = 0.25
"""Seconds at one position after a coasting tail, for a game whose lag isn't known yet: five ticks."""


class Standstill:
    """Follows the positions seen after a hold, and says when the walker stands still.

    Args:
        position: where the walker was before the hold, in cells as (right, forward).
        now: when the key went up, in seconds.
        settle_s: seconds at one position that are enough after a coasting tail.
        stall_s: seconds at one position that are enough without one.
    """

    def __init__(self, position: tuple[float, float], now: float, settle_s: float, stall_s: float = STALL_S) -> None:
        self._position = position
        self._since = now
        self._settle_s = settle_s
        self._stall_s = stall_s
        self._has_coasted = False

    def is_reached(self, position: tuple[float, float], now: float) -> bool:
        """Take in the position seen now, and say whether it is the last."""
        if position != self._position:
            step = max(abs(position[0] - self._position[0]), abs(position[1] - self._position[1]))
            self._position, self._since, self._has_coasted = position, now, step < TAIL
        return now - self._since >= (self._settle_s if self._has_coasted else self._stall_s)
