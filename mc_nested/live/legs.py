"""Legs: holds that end between two of the game's ticks, and how the agent goes on after them."""

from collections.abc import Callable

from mc_nested.errors import NotConfirmedError
from mc_nested.live.devices import Clock
from mc_nested.live.eyes import FRAME_S, Eyes, Stance
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.standstill import Standstill
from mc_nested.live.stride import Going, Hold, Pair, Stride
from mc_nested.live.walk import TICK_S, best_steps, push_of

SOONEST_S = 0.015
"""Seconds in which nothing that was pressed is seen: an event takes 5 ms to the game, a picture 10 back."""

SHORT = 2
"""Ticks of a hold that ends before its first ones can be seen."""

SURELY_SEEN_S = 0.053
"""Seconds after a tick at which its step is on the screen in any case, and the next one's can't be."""

SOON_LOOKS = 3
"""Looks that come twice a frame, since a click that goes out a little sooner is felt a tick sooner."""

LOST_RELEASE = 20
"""Looks at an agent whose way has no explanation, after which its keys are released once more."""

MOST_SHIFT_S = 1.2 * TICK_S
"""Seconds that a look on the way may move a release by: a tick felt more or less, and never what a stall hid."""


class Legs:
    """Walks, one hold at a time, and knows where the agent comes to a stop.

    Raises (everything): what the eyes and the hands raise.
    """

    def __init__(self, profile: Profile, hands: Hands, eyes: Eyes, clock: Clock) -> None:
        self._keys = profile.keys
        self._limits = profile.body
        self._walk = profile.walk
        self._push = push_of(profile.walk.covered, profile.walk.inertia)
        self._hands = hands
        self._eyes = eyes
        self._clock = clock
        self._stride = self._standing((0.0, 0.0))

    def stand(self, stance: Stance) -> None:
        """Take an agent for one who stands, as after a teleport."""
        self._stride = self._standing(stance.place)

    def explain(self, place: Pair) -> Going | None:
        """How the agent goes who is seen there, by the hold that it was in; None where that isn't certain."""
        return self._stride.see(place)

    def walk(self, going: Going, offset: Pair) -> Stance:
        """One hold, along the axis that is farther off; what is seen after it.

        Args:
            going: how the agent goes now.
            offset: blocks, right and forward, from where it would come to a stop to where it should.
        """
        axis = 1 if abs(offset[1]) >= abs(offset[0]) else 0
        sign = 1 if offset[axis] > 0 else -1
        steps = best_steps(abs(offset[axis]), self._walk.covered, self._limits.tolerance, self._walk.sneaking)
        sneaks = steps.gait == "sneak"
        push = self._push * (self._walk.sneaking if sneaks else 1.0)
        self._stride = Stride(going, Hold(axis, sign, steps.ticks, push), self._walk.inertia)
        keys = self._keys
        key = ((keys.left, keys.right), (keys.back, keys.forward))[axis][sign > 0]
        self._hold(steps.ticks, *([keys.sneak] if sneaks else []), key)
        return self._eyes.look_straight()

    @property
    def farthest(self) -> Pair:
        """Where the agent comes to a stop whose hold was felt a tick longer than meant."""
        return self._stride.farthest

    def settle(self, stance: Stance, on_the_way: Callable[[Stance], None] | None = None) -> tuple[Going, Stance]:
        """How the agent goes who was seen like that, by the hold that it was in, or else once it stands.

        ``on_the_way`` is told what is seen before that is certain. Returns how it goes, and what was seen last.
        """
        standstill = Standstill(stance.place, self._clock.now(), self._limits.settle_s)
        began = self._clock.now()
        looks = 0
        while True:
            going = self._stride.see(stance.place)
            if going is None and standstill.is_reached(stance.place, self._clock.now()):
                going = Going(stance.place, (0.0, 0.0), self._walk.inertia)
            if going is not None:
                self._eyes.note_timely()
                self._stride = Stride(going, None, self._walk.inertia)
                return going, stance
            if on_the_way:
                on_the_way(stance)
            if self._clock.now() >= began + self._limits.patience_s:
                raise NotConfirmedError(f"the agent does not stand still, it is at {stance}: does something push it?")
            looks += 1
            if looks % LOST_RELEASE == 0:
                self._hands.release_again()
            self._hands.wait(FRAME_S if looks > SOON_LOOKS else FRAME_S / 2)
            stance = self._eyes.look_straight()

    def _standing(self, place: Pair) -> Stride:
        return Stride(Going(place, (0.0, 0.0), self._walk.inertia), None, self._walk.inertia)

    def _hold(self, ticks: int, *keys: str) -> None:
        """Hold keys so that exactly so many ticks feel them, as far as the beat is known; then wait for what follows.

        A key that goes down or up just when a tick comes is felt by that tick or by the next. So a short hold waits for
        a time between two ticks, and a long one looks on its way how many ticks have felt it, and ends between two.
        """
        now, beat = self._clock.now(), self._eyes.beat
        middle = TICK_S / 2 - self._walk.felt_after_s
        if not beat.is_known:
            self._hands.hold(keys[-1], ticks, *keys[:-1])
            self._hands.wait(SOONEST_S)
            return
        if ticks <= SHORT:
            self._hands.wait_until(beat.next(now, middle))
            until = self._clock.now() + ticks * TICK_S
            self._hands.press(until, *keys)
        else:
            planned = until = now + ticks * TICK_S
            self._hands.press(until, *keys)
            tick = beat.next(now + TICK_S / 2)
            self._hands.wait_until(tick + SURELY_SEEN_S)
            felt = self._ticks_felt()
            if felt is not None:
                timed = tick + (ticks - felt) * TICK_S + middle
                if abs(timed - planned) <= MOST_SHIFT_S:
                    until = timed
                    self._hands.keep_until(until, *keys)
        self._hands.wait_until(until)
        self._eyes.wait_for_step(until - middle + TICK_S)

    def _ticks_felt(self) -> int | None:
        """How many ticks have felt the key that is held, by a look at the screen; None where it doesn't tell."""
        place = self._eyes.place_now()
        return self._stride.ticks_held(place) if place else None
