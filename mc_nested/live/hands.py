"""Hands: the one owner of held keys and buttons. A press needs its window and the right screen, a release neither.

Every press comes with the time of its release, an absolute one, so that a late wake-up never adds up and a key is never
down without an end:

    press |---- tick ----|---- tick ----| release
          what waits meanwhile waits through the hands, and they look each tick whether the window is still in front
"""

import atexit
import threading
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from types import TracebackType
from typing import Literal

from mc_nested.errors import NotInFrontError, StoppedError, WrongScreenError
from mc_nested.live.devices import Button, Clock, Display, Keyboard, Pointer
from mc_nested.live.ending import signals_as_exit
from mc_nested.live.profile_tables import Input
from mc_nested.live.walk import TICK_S

Screen = Literal["world", "chat", "menu"]
"""Where a press goes: keys of the game, letters of a line, or what opens and closes menus."""

FRESH_S = 0.25
"""Seconds that a look at the screen permits presses for."""

LONGEST_S = 3.0
"""Seconds that anything is ever held."""

OVERDUE_S = 0.25
"""Seconds past its release at which a held key is the watchdog's."""


NEAR_PX = 3
"""How far the mouse may be from where it was put: a point of the desktop may be two pixels."""


@dataclass(frozen=True)
class _Held:
    release: Callable[[], None]
    due: float


class Hands:
    """Presses keys and buttons for a time, and never leaves one down: not on return, on an exception or on a signal.

    As a context manager it also releases when the block, or the process, ends.

    Raises (every press and every wait): NotInFrontError where another window is in front, or comes to the front;
    StoppedError once somebody has stopped it. A press: WrongScreenError where the screen was not just seen to be the
    one that it is meant for. What was held is released then.
    """

    def __init__(self, display: Display, keyboard: Keyboard, pointer: Pointer, clock: Clock, timing: Input) -> None:
        self._display = display
        self._keyboard = keyboard
        self._pointer = pointer
        self._clock = clock
        self._timing = timing
        self._held: dict[str, _Held] = {}
        self._pressed: dict[str, Callable[[], None]] = {}
        self._lock = threading.RLock()
        self._seen: tuple[Screen, float] | None = None
        self._stopped: str | None = None
        self._exits = ExitStack()

    def __enter__(self) -> "Hands":
        self._exits.enter_context(signals_as_exit())
        atexit.register(self.release_all)
        return self

    def __exit__(
        self, _kind: type[BaseException] | None, _error: BaseException | None, _traceback: TracebackType | None
    ) -> None:
        with self._exits, ExitStack() as releases:
            # Twice, since a release that fails may work a moment later.
            releases.callback(self.release_all)
            releases.callback(self.release_all)
        atexit.unregister(self.release_all)

    def saw(self, screen: Screen) -> None:
        """Note what was just seen on the screen: presses for that are permitted for a while, and no others."""
        self._seen = screen, self._clock.now()

    def hold(self, key: str, ticks: int, *others: str) -> None:
        """Hold a key, or several, for so many game ticks (FACTS: Walking; 100, 150 and 200 ms gave 2, 3 and 4)."""
        until = self._clock.now() + ticks * TICK_S
        self.press(until, *others, key)
        self.wait_until(until)

    def press(self, until: float, *keys: str) -> None:
        """Press keys of the world and return; they go up at the time ``until``, while something is waited for."""
        for key in keys:
            self._press_key(key, until, "world")

    def keep_until(self, until: float, *keys: str) -> None:
        """Let what is pressed go up at another time."""
        for key in keys:
            if held := self._held.get(f"key {key}"):
                self._held[f"key {key}"] = _Held(held.release, min(until, self._clock.now() + LONGEST_S))

    def tap(self, key: str, on: Screen = "world") -> None:
        """Press a key that works once a press, however long it is held."""
        until = self._clock.now() + TICK_S
        self._press_key(key, until, on)
        self.wait_until(until)

    def click(self, button: Button) -> None:
        """Press a button in the world. It goes up, as soon as the profile says, while something is waited for."""
        self._press_button(button, "world")

    def hover(self, x: int, y: int) -> None:
        """Move the mouse over a menu to a place in framebuffer pixels, and press nothing."""
        self._check("menu")
        self._pointer.move(x, y)
        self.wait(TICK_S)

    def click_at(self, x: int, y: int) -> None:
        """Click on a menu at a place in framebuffer pixels.

        WrongScreenError where the mouse isn't there any more: the window, or somebody else, has moved it.
        """
        self.hover(x, y)
        across, down = self._pointer.position()
        if max(abs(across - x), abs(down - y)) > NEAR_PX:
            raise WrongScreenError("the mouse was moved, or the window was, so nothing is clicked: leave both alone")
        self._press_button("left", "menu")
        self.wait(self._timing.click_s)

    def type_line(self, text: str) -> None:
        """Type into the open chat, and don't send it."""
        for letter in text:
            self._type(letter)

    def wait(self, seconds: float) -> None:
        """Let so many seconds pass, and whatever is due go up."""
        self.wait_until(self._clock.now() + seconds)

    def wait_until(self, at: float) -> None:
        """Let time pass until ``at``, and whatever is due go up at its time."""
        try:
            while True:
                now = self._clock.now()
                soon = min([now + TICK_S, *(held.due for held in list(self._held.values()))])
                self._clock.sleep_until(min(soon, at))
                now = self._clock.now()
                self._release([name for name, held in list(self._held.items()) if held.due <= now])
                if now >= at:
                    return
                self._check()
        except BaseException:
            self.release_all()
            raise

    def release_all(self) -> None:
        """Release whatever is held, in front or not; every key is tried before a failure is raised."""
        self._release(list(self._held))

    def release_again(self) -> None:
        """Release whatever was ever pressed in the world: a release may have been lost on its way to the game."""
        with self._lock, ExitStack() as releases:
            for release in self._pressed.values():
                releases.callback(release)

    def release_overdue(self) -> None:
        """Release whatever is held for longer than it should be: what a watchdog does."""
        late = self._clock.now() - OVERDUE_S
        self._release([name for name, held in list(self._held.items()) if held.due <= late])

    def stop(self, reason: str) -> None:
        """Release everything, now, and press nothing any more. Any thread may call this."""
        self._stopped = reason
        self.release_all()

    def check_front(self) -> None:
        """NotInFrontError unless a key pressed now would reach the game."""
        if not self._display.is_in_front():
            raise NotInFrontError(
                "the game's window is not in front, so no key is pressed: click on it, then start again"
            )

    def _check(self, screen: Screen | None = None) -> None:
        if self._stopped is not None:
            raise StoppedError(f"{self._stopped}: every key is up, start again when you like")
        self.check_front()
        if screen is None:
            return
        seen, at = self._seen or ("nothing", self._clock.now())
        if seen != screen or self._clock.now() - at > FRESH_S:
            raise WrongScreenError(f"the {screen} was not just seen on the screen, so nothing is pressed: look first")

    def _type(self, letter: str) -> None:
        name = f"letter {letter}"
        with self._lock:
            self._check("chat")
            self._held[name] = _Held(partial(self._keyboard.release, letter), self._clock.now())
            try:
                self._keyboard.type(letter)
            except BaseException:
                # Interrupted between the letter's press and its release, perhaps.
                self._release([name])
                raise
            del self._held[name]

    def _press_key(self, key: str, until: float, on: Screen) -> None:
        self._press(f"key {key}", partial(self._keyboard.press, key), partial(self._keyboard.release, key), until, on)

    def _press_button(self, button: Button, on: Screen) -> None:
        until = self._clock.now() + self._timing.click_s
        press, release = partial(self._pointer.press, button), partial(self._pointer.release, button)
        self._press(f"{button} button", press, release, until, on)

    def _press(
        self, name: str, press: Callable[[], None], release: Callable[[], None], until: float, on: Screen
    ) -> None:
        try:
            with self._lock:
                self._check(on)
                # Noted before it is pressed: an interrupt between the two would else leave it down.
                self._held[name] = _Held(release, min(until, self._clock.now() + LONGEST_S))
                if on == "world":
                    self._pressed[name] = release
                press()
        except BaseException:
            self.release_all()
            raise

    def _release(self, names: Iterable[str]) -> None:
        # A stack of callbacks runs every one of them, whatever the others raise.
        with self._lock, ExitStack() as releases:
            for name in names:
                releases.callback(self._release_one, name)

    def _release_one(self, name: str) -> None:
        if held := self._held.get(name):
            held.release()
            self._held.pop(name, None)
