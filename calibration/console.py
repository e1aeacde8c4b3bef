"""Typing commands, each into the chat of a world that is on the screen, and looking where they have put the player."""

from collections.abc import Callable

from calibration.step import Bench
from mc_nested.errors import NotConfirmedError, UnreadableError, WrongScreenError
from mc_nested.live.chat import Chat
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.profile import Profile
from mc_nested.live.reading import Reading
from mc_nested.live.walk import TICK_S

CLEARED_EVERY = 5
"""Commands after which the chat is cleared: ten answers would cover lines of the debug screen (FACTS: Answers)."""

TRIES = 4
"""How often a line is begun: on a busy machine its letters may come so late that the rest isn't typed."""

LOOK_S = 0.02

CLEAR = "d"
"""Beside the debug screen's key it clears the chat (FACTS: Keys)."""


class Console:
    """Sends commands, and watches the debug screen for what they did.

    Raises (everything): UnreadableError where the debug screen can't be read for the profile's patience;
    NotConfirmedError where the chat is open, or isn't seen as it should be; what the hands raise.
    """

    def __init__(self, bench: Bench, profile: Profile, screen: GameScreen) -> None:
        self._hands, self._clock = bench.hands, bench.desktop.clock
        self._chat = Chat(profile, bench.hands, screen, bench.desktop.clock)
        self._profile, self._screen = profile, screen
        self._sent = 0

    def send(self, command: str) -> None:
        """Send a line."""
        self._see_world()
        if self._profile.input.reads_chat and self._sent and self._sent % CLEARED_EVERY == 0:
            self.clear()
        for tries_left in reversed(range(TRIES)):
            try:
                self._chat.send(command)
                break
            except WrongScreenError:
                if not tries_left or not self._profile.input.reads_chat:
                    raise
                self._leave_chat()
        self._sent += 1

    def read(self) -> Reading:
        """What the debug screen says; waits while it can't be read."""
        until = self._clock.now() + self._profile.body.patience_s
        while (reading := self._screen.read()).xyz is None:
            self._hands.check_front()
            if self._clock.now() >= until:
                raise UnreadableError(f"the debug screen was unreadable for too long: {reading.problem}")
            self._hands.wait(LOOK_S)
        return reading

    def watch(self, is_so: Callable[[Reading], bool], seconds: float) -> Reading | None:
        """The first reading that is so, within so many seconds; None without one."""
        until = self._clock.now() + seconds
        while not is_so(reading := self.read()):
            if self._clock.now() >= until:
                return None
            self._hands.wait(LOOK_S)
        return reading

    def _leave_chat(self) -> None:
        """Close the chat, in which half a line stands, and see the world again."""
        if self._screen.is_chat_open():
            self._hands.saw("chat")
            self._hands.tap("esc", on="chat")
            self._hands.wait(self._profile.input.chat_close_s)
        self._see_world()

    def _see_world(self) -> None:
        self.read()
        if self._screen.is_chat_open():
            raise NotConfirmedError("the chat is open: leave mouse and keys alone, and start again")
        self._hands.saw("world")

    def clear(self) -> None:
        """Clear what the chat has answered so far."""
        self._see_world()
        now = self._clock.now()
        self._hands.press(now + 4 * TICK_S, self._profile.keys.debug)
        self._hands.wait_until(now + TICK_S)
        self._hands.press(now + 2 * TICK_S, CLEAR)
        self._hands.wait_until(now + 4 * TICK_S)
        self._see_world()
