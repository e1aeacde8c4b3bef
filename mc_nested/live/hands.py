"""Hands: the one owner of held keys and buttons. Presses need the game's window in front; releases need nothing.

A hold runs from its press to an absolute time, so that a late wake-up never adds up:

    press |---- tick ----|---- tick ----| release
               the window in front?
"""

import atexit
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from functools import partial
from types import TracebackType

from mc_nested.errors import NotInFrontError
from mc_nested.live.devices import Button, Clock, Display, Keyboard, Pointer
from mc_nested.live.ending import signals_as_exit
from mc_nested.live.profile_tables import Input
from mc_nested.live.walk import TICK_S


class Hands:
    """Presses keys and buttons for a time, and never leaves one down: not on return, on an exception or on a signal.

    As a context manager it also releases when the block, or the process, ends.

    Raises (every press): NotInFrontError where another window is in front, or comes to the front; what was held is
    released then.
    """

    def __init__(self, display: Display, keyboard: Keyboard, pointer: Pointer, clock: Clock, timing: Input) -> None:
        self._display = display
        self._keyboard = keyboard
        self._pointer = pointer
        self._clock = clock
        self._timing = timing
        self._releases: dict[str, Callable[[], None]] = {}
        self._exits = ExitStack()

    def __enter__(self) -> "Hands":
        self._exits.enter_context(signals_as_exit())
        atexit.register(self.release_all)
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _traceback: TracebackType | None
    ) -> None:
        try:
            self.release_all()
            atexit.unregister(self.release_all)
        finally:
            self._exits.close()

    def hold(self, key: str, ticks: int) -> None:
        """Hold a key for so many game ticks (FACTS: Walking; 100, 150 and 200 ms gave 2, 3 and 4)."""
        self._hold_key(key, ticks * TICK_S)

    def tap(self, key: str) -> None:
        """Press a key that works once a press, however long it is held."""
        self._hold_key(key, TICK_S)

    def click(self, button: Button) -> None:
        """Press a button once where the pointer is, for as long as the profile says."""
        self._hold(
            f"{button} button",
            partial(self._pointer.press, button),
            partial(self._pointer.release, button),
            self._timing.click_s,
        )

    def type_command(self, chat_key: str, text: str) -> None:
        """Open the chat, type one line, send it, and wait until the game takes keys again."""
        self.tap(chat_key)
        self._wait(self._timing.chat_open_s)
        for letter in text:
            self._type(letter)
        self._wait(TICK_S)
        self.tap("enter")
        self._wait(self._timing.chat_close_s)

    def release_all(self) -> None:
        """Release whatever is held, in front or not; every key is tried before a failure is raised."""
        self._release(list(self._releases))

    def check_front(self) -> None:
        """NotInFrontError unless a key pressed now would reach the game."""
        if not self._display.is_in_front():
            raise NotInFrontError(
                "the game's window is not in front, so no key is pressed: click on it, then start again"
            )

    def _type(self, letter: str) -> None:
        self.check_front()
        name = f"key {letter}"
        self._releases[name] = partial(self._keyboard.release, letter)
        try:
            self._keyboard.type(letter)
        except BaseException:
            # Interrupted between the letter's press and its release, perhaps.
            self._release([name])
            raise
        del self._releases[name]

    def _hold_key(self, key: str, seconds: float) -> None:
        self._hold(f"key {key}", partial(self._keyboard.press, key), partial(self._keyboard.release, key), seconds)

    def _hold(self, name: str, press: Callable[[], None], release: Callable[[], None], seconds: float) -> None:
        self.check_front()
        until = self._clock.now() + seconds
        # Noted before it is pressed: an interrupt between the two would else leave it down.
        self._releases[name] = release
        try:
            press()
            while (soon := self._clock.now() + TICK_S) < until:
                self._clock.sleep_until(soon)
                self.check_front()
            self._clock.sleep_until(until)
        finally:
            self._release([name])

    def _release(self, names: Iterable[str]) -> None:
        # A stack of callbacks runs every one of them, whatever the others raise.
        with ExitStack() as releases:
            for name in names:
                releases.callback(self._release_one, name)

    def _release_one(self, name: str) -> None:
        self._releases[name]()
        self._releases.pop(name, None)

    def _wait(self, seconds: float) -> None:
        self._clock.sleep_until(self._clock.now() + seconds)
