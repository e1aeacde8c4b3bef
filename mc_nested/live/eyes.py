"""Eyes: where the agent is and what it looks at, from the debug screen, and when the game's ticks are seen to fall.

Whoever presses looks first: only what was just seen permits a press, and nothing is pressed on a view that is not the
arena's, or while the chat is open.
"""

from collections.abc import Callable
from dataclasses import dataclass

from mc_nested.arena.rules import Cell
from mc_nested.errors import NotConfirmedError, UnreadableError
from mc_nested.live.beat import Beat
from mc_nested.live.coordinates import cell_at, turn_between
from mc_nested.live.devices import Clock
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile
from mc_nested.live.reading import Target
from mc_nested.live.stride import Pair

FRAME_S = 1 / 60
"""Seconds between two looks at the screen: a frame of the game, so that no wait is much longer than it must be."""

SAME_FRAME_S = 0.005
"""Seconds after a look in which another one would see the same frame."""

LIKELY_SEEN_S = 0.028
"""Seconds after a tick at which looks for its step begin: a frame and a picture take 10 to 47 ms."""

TURN = 0.5
"""Degrees that the view may be off: the debug screen shows tenths (FACTS: The F3 debug screen)."""

RISE = 0.05
"""Blocks that the feet may be above or below the arena's floor: standing on a full block there is no difference."""


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


class Eyes:
    """Looks at the game, and notes when steps are first seen.

    Raises (every look): UnreadableError where the debug screen can't be read for the profile's patience; what the
    hands raise. One that is checked: NotConfirmedError where the view or the height isn't the arena's.
    """

    def __init__(self, profile: Profile, hands: Hands, screen: GameScreen, clock: Clock) -> None:
        self._arena = profile.marked_arena()
        self._limits = profile.body
        self._hands = hands
        self._screen = screen
        self._clock = clock
        self._timed_look = 0.0
        self._looked: tuple[float, Stance] | None = None
        self.beat = Beat(profile.walk.seen_after_s)

    def look(self) -> Stance:
        """What is to be seen now, as soon as it can be read."""
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

    def look_straight(self) -> Stance:
        """The same, and the view is the arena's."""
        return checked(self.look())

    def watch(self, done: Callable[[Stance], bool], seconds: float) -> Stance:
        """Look until ``done`` or for so long; the last stance either way."""
        deadline = self._clock.now() + seconds
        while not done(stance := self.look()) and self._clock.now() < deadline:
            self._hands.wait(FRAME_S)
        return stance

    def place_now(self) -> Pair | None:
        """Where the agent is, in one look, while a key is down; None where that can't be read."""
        xyz = self._screen.read_place()
        return self._arena.place_of(xyz) if xyz else None

    def permit_press(self) -> None:
        """See that the next press goes into the world, the debug screen having just been read."""
        if self._screen.is_chat_open():
            raise NotConfirmedError("the chat is open: leave mouse and keys alone while the agent plays")
        self._hands.saw("world")

    def wait_for_step(self, tick: float) -> None:
        """Wait until the step of a tick is likely to be seen."""
        self._hands.wait_until(tick + LIKELY_SEEN_S)
        self._timed_look = self._clock.now()

    def note_timely(self) -> None:
        """Where the step that was waited for was seen at the first look, count it as seen since a frame before.

        Without it, only steps that are seen late would be sighted.
        """
        if self._looked is not None and self._looked[0] == self._timed_look:
            self.beat.saw_step(self._timed_look - FRAME_S, self._timed_look)

    def _note(self, now: float, stance: Stance) -> None:
        if self._looked is not None and stance != self._looked[1] and now - self._looked[0] < 1.5 * FRAME_S:
            self.beat.saw_step(self._looked[0], now)
        self._looked = now, stance

    def _trouble(self, height: float, yaw: float, pitch: float) -> str | None:
        if turn_between(yaw, self._arena.yaw) > TURN or abs(pitch - self._limits.pitch) > TURN:
            return f"the agent looks {yaw:g} / {pitch:g}, not {self._arena.yaw:g} / {self._limits.pitch:g}"
        if abs(height - self._arena.origin[1]) > RISE:
            return f"its feet are at y = {height:g}, not {self._arena.origin[1]}"
        return None


def checked(stance: Stance) -> Stance:
    """The stance; NotConfirmedError where something is wrong with it."""
    if stance.trouble is not None:
        raise NotConfirmedError(f"{stance.trouble}: leave mouse and keys alone while the agent plays")
    return stance
