"""Typing commands into the chat, each looked at before it is sent.

chat key -> its line is seen, empty -> letters -> the line is seen to hold all of them -> Enter -> it is seen to go
"""

from collections.abc import Callable

from mc_nested.errors import NotConfirmedError
from mc_nested.live.devices import Clock
from mc_nested.live.game_screen import GameScreen
from mc_nested.live.hands import Hands
from mc_nested.live.profile import Profile

PATIENCE_S = 1.5
"""How long the chat's line may take to be seen as it should be."""

LOOK_S = 0.02

AT_ONCE = 8
"""Letters typed between two looks."""


class Chat:
    """Sends lines. Whoever calls has just seen that the world, and nothing over it, is on the screen.

    Raises (everything): NotConfirmedError where the chat's line isn't seen as it should be; nothing is sent then.
    """

    def __init__(self, profile: Profile, hands: Hands, screen: GameScreen, clock: Clock) -> None:
        self._key = profile.keys.chat
        self._timing = profile.input
        self._hands = hands
        self._screen = screen
        self._clock = clock

    def send(self, line: str) -> None:
        """Open the chat, type one line, send it, and wait until the game takes keys again."""
        self._hands.tap(self._key)
        if self._timing.reads_chat:
            self._see(lambda: self._screen.is_typed("") and self._screen.is_chat_open(), "the chat did not open, empty")
        else:
            self._hands.wait(self._timing.chat_open_s)
        # Where nothing can be looked at, a letter that comes late must not end the line.
        at_once = AT_ONCE if self._timing.reads_chat else 1
        for first in range(0, len(line), at_once):
            # Looked at again and again: on a busy machine a line takes a while, and the chat may close.
            if self._timing.reads_chat:
                self._see(self._screen.is_chat_open, "the chat did not stay open")
            self._hands.saw("chat")
            self._hands.type_line(line[first : first + at_once])
        if self._timing.reads_chat:
            self._see(lambda: self._screen.is_typed(line), f"{line!r} was not seen in the chat")
        self._hands.saw("chat")
        self._hands.tap("enter", on="chat")
        if self._timing.reads_chat:
            self._see(lambda: not self._screen.is_chat_open(), "the chat did not close")
        else:
            self._hands.wait(self._timing.chat_close_s)

    def _see(self, is_so: Callable[[], bool], problem: str) -> None:
        until = self._clock.now() + PATIENCE_S
        while not is_so():
            if self._clock.now() >= until:
                raise NotConfirmedError(f"{problem}: leave mouse and keys alone, and look whether the game allows chat")
            self._hands.wait(LOOK_S)
