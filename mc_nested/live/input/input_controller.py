"""The one owner of held keys and buttons. A press needs the game's window and the right screen, a release neither.

Every press has an absolute release time, so late wake-ups never add up and no key stays down without an end:

    press |---- tick ----|---- tick ----| release
          meanwhile everything waits through the controller, which checks each tick that the window is still in front
"""

import atexit
import threading
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Literal, get_args

from mc_nested.errors import NotConfirmedError, NotInFrontError, StoppedError, TakenOverError, WrongScreenError
from mc_nested.live.devices import SWITCH_KEYS, Button, Devices
from mc_nested.live.input.signals import signals_as_exit
from mc_nested.live.model.kinematics import TICK_S
from mc_nested.live.profile.tables import InputTable

PressTarget = Literal["world", "chat", "menu"]
"""What a press is meant for: the game's world, the chat's line, or a menu (also to open and close it)."""

FRESH_S = 0.25
"""Seconds for which a look at the screen permits presses."""

LONGEST_S = 3.0
"""The longest that anything is ever held, in seconds."""

PATIENCE_S = 0.6
"""How long the world may not be seen before a press is refused."""

SLOW_S = 2.0
"""How long each look may take too long to permit a press, as on a busy machine, before it is refused."""

LETTER_TRIES = 5
"""How often a letter is tried for which the chat was seen too long ago."""

OVERDUE_S = 0.25
"""Seconds past its release time after which the watchdog releases a key."""

BUTTONS: tuple[Button, ...] = get_args(Button)

NEAR_PX = 3
"""How far the mouse may be from where it was moved to: a point of the desktop may be two pixels."""


@dataclass(frozen=True)
class _Held:
    release: Callable[[], None]
    due: float


def not_in_front_error() -> NotInFrontError:
    """Return the error for a game's window that isn't in front."""
    return NotInFrontError(
        "the game's window is not in front, so no key is pressed: "
        f"switch to it with {SWITCH_KEYS}, not by a click, then start again"
    )


class InputController:
    """Presses keys and buttons for a time, and never leaves one down: not on return, on an exception or on a signal.

    As a context manager it also releases when the block, or the process, ends.

    Raises (every press and every wait): NotInFrontError if another window is in front, or comes to the front;
    StoppedError once it was stopped; TakenOverError while the player has the game. A press also: WrongScreenError if
    the screen that it is meant for was not just confirmed. Everything held is released then.

    Args:
        devices: what is pressed, and the window that it is pressed in.
        timing: how long a click is.
        on_hands: every answer to who has the game, in a word and yes or no, passes through it, as through a recording.
    """

    def __init__(
        self, devices: Devices, timing: InputTable, on_hands: Callable[[str, bool], bool] = lambda _, is_so: is_so
    ) -> None:
        self._display = devices.display
        self._keyboard = devices.keyboard
        self._pointer = devices.pointer
        self._clock = devices.clock
        self._timing = timing
        self._held: dict[str, _Held] = {}
        self._pressed: dict[str, Callable[[], None]] = {}
        self._lock = threading.RLock()
        self._confirmed: tuple[PressTarget, float] | None = None
        self._look_again: Callable[[], None] | None = None
        self._sees_world: Callable[[], bool] = lambda: True
        self.look_s = 0.0
        """How long the last look before a press took, in seconds."""
        self.is_attended = True
        """Whether what is held is released in time by who pressed it; not between two actions that overlap."""
        self._down_s = 0.0
        self._down_since: float | None = None
        self._stop_reason: str | None = None
        self._on_hands = on_hands
        self._is_players = self._is_yielded = self._is_borrowed = False
        self._exits = ExitStack()

    def __enter__(self) -> "InputController":
        self._exits.enter_context(signals_as_exit())
        atexit.register(self.release_all)
        return self

    def __exit__(self, *_: object) -> None:
        with self._exits, ExitStack() as releases:
            # Twice: a release that fails may work a moment later.
            releases.callback(self.release_all)
            releases.callback(self.release_all)
        atexit.unregister(self.release_all)

    def held_s(self, now: float) -> float:
        """Return for how many seconds anything was down until now."""
        if self._down_since is not None:
            self._down_s += now - self._down_since
            self._down_since = now if self._held else None
        return self._down_s

    def confirm_screen(self, screen: PressTarget, look_again: Callable[[], None] | None = None) -> None:
        """Say which screen was just seen: presses meant for it are permitted for FRESH_S, and no others.

        A press that comes later than that, as on a busy machine, calls ``look_again`` first, if there is one. That
        confirms the screen once more, or raises what is wrong with it.
        """
        self._confirmed, self._look_again = (screen, self._clock.now()), look_again

    def guard_world(self, sees_world: Callable[[], bool]) -> None:
        """Ask ``sees_world`` at each press that is meant for the world, just before it: only then is it sent."""
        self._sees_world = sees_world

    def hold(self, key: str, ticks: int, *others: str) -> None:
        """Hold one or more keys for a number of ticks (FACTS: Walking; 100, 150 and 200 ms gave 2, 3 and 4)."""
        self.wait_until(self.press(self._clock.now() + ticks * TICK_S, *others, key))

    def press(self, until: float, *keys: str, beside: str | None = None) -> float:
        """Press keys in the world and return when they are released, during a later wait.

        That is ``until``, and as much later as the look at the screen took that comes before. Raise NotConfirmedError
        if the key ``beside`` which they are pressed is not down after that look.
        """
        asked_at = self._clock.now()
        self._permit("world")
        with self._lock:
            until += self._clock.now() - asked_at
            is_beside = beside is None or f"key {beside}" in self._held
        if not is_beside:
            raise NotConfirmedError(
                f"{beside} did not stay down until the screen was seen, so {' '.join(keys)} is not pressed: "
                "close what slows the computer down"
            )
        for key in keys:
            self._press_key(key, until, "world")
        return until

    def keep_until(self, until: float, *keys: str) -> None:
        """Change the release time of keys that are down."""
        for key in keys:
            with self._lock:
                latest = self._clock.now() + LONGEST_S
                if held := self._held.get(f"key {key}"):
                    self._held[f"key {key}"] = _Held(held.release, min(until, latest))

    def tap(self, key: str, on: PressTarget = "world") -> None:
        """Press and release a key that acts once per press, however long it is held."""
        self._permit(on)
        until = self._clock.now() + TICK_S
        self._press_key(key, until, on)
        self.wait_until(until)

    def tap_alone(self, key: str) -> None:
        """Tap a key in the world once nothing else is down: to 1.12 Shift makes another key of it (FACTS: Keys)."""
        while self._held:
            # Another thread may release everything meanwhile.
            self.wait_until(max((held.due for held in list(self._held.values())), default=self._clock.now()))
        self.tap(key)

    def click(self, button: Button) -> None:
        """Press a button in the world. It is released after the profile's ``click_s``, during a later wait."""
        self._permit("world")
        self._press_button(button, "world")

    def hover(self, x: int, y: int) -> None:
        """Move the mouse over a menu, to a position in framebuffer pixels, and press nothing."""
        with self._lock:
            self._check_press("menu")
            self._pointer.move(x, y)
        self.wait(TICK_S)

    def click_at(self, x: int, y: int) -> None:
        """Click on a menu, at a position in framebuffer pixels.

        Raise WrongScreenError if the mouse isn't there any more: the window, or somebody else, has moved it.
        """
        self.hover(x, y)
        across, down = self._pointer.position()
        if max(abs(across - x), abs(down - y)) > NEAR_PX:
            raise WrongScreenError("the mouse was moved, or the window was, so nothing is clicked: leave both alone")
        self._press_button("left", "menu")
        self.wait(self._timing.click_s)

    def type_line(self, text: str) -> None:
        """Type a line into the open chat, without sending it. Where a letter comes late, the chat is seen once more."""
        for letter in text:
            for tries_left in reversed(range(LETTER_TRIES)):
                try:
                    self._type(letter)
                    break
                except WrongScreenError:
                    if self._look_again is None or not self._was_seen("chat") or not tries_left:
                        raise
                    self._look_again()

    def _type(self, letter: str) -> None:
        with self._lock:
            self._check_press("chat")
            self._keyboard.type(letter)

    def wait(self, seconds: float) -> None:
        """Let that many seconds pass, and release what is due."""
        self.wait_until(self._clock.now() + seconds)

    def wait_until(self, at: float) -> None:
        """Let time pass until ``at``, and release what is due at its time."""
        try:
            while True:
                # With the clock's answer in one go: what another thread releases lies before both on tape, or behind.
                with self._lock:
                    soonest = min([self._clock.now() + TICK_S, *(held.due for held in self._held.values())])
                self._clock.sleep_until(min(soonest, at))
                with self._lock:
                    now = self._clock.now()
                    self._release([name for name, held in self._held.items() if held.due <= now])
                    self.held_s(now)
                if now >= at:
                    return
                self._check_running()
        except BaseException:
            self.release_all()
            raise

    def release_all(self) -> None:
        """Release everything that is held, in front or not; every key is tried before a failure is raised."""
        self._release(list(self._held))

    def release_again(self) -> None:
        """Release everything that was ever pressed in the world: the game may have missed a release.

        Nothing is, while the player has the game, whose keys may be the same.
        """
        with self._lock, ExitStack() as releases:
            for release in () if self.has_yielded else self._pressed.values():
                releases.callback(release)

    @property
    def pressed_before(self) -> tuple[str, ...]:
        """The keys that ``release_again`` releases, in this order, by their names; buttons as "right button"."""
        return tuple(self._pressed)

    def go_on_after(self, pressed: Iterable[str]) -> None:
        """Release these, too, when ``release_again`` is called, as if they had been pressed here."""
        releases = {f"{button} button": partial(self._pointer.release, button) for button in BUTTONS}
        self._pressed = {
            name: releases.get(name) or partial(self._keyboard.release, name.removeprefix("key ")) for name in pressed
        }

    def release_overdue(self) -> None:
        """Release everything that is held OVERDUE_S longer than it should be; the watchdog calls this.

        While nobody waits here who would release it in time, it is released as soon as it should be.
        """
        overdue = self._clock.now() - (OVERDUE_S if self.is_attended else 0.0)
        self._release([name for name, held in list(self._held.items()) if held.due <= overdue])

    def was_released(self, name: str) -> None:
        """Take note that the watchdog of a recorded run released a key or a button, by its name here."""
        self._held.pop(name, None)

    def stop(self, reason: str) -> None:
        """Release everything now, and press nothing from then on. Any thread may call this."""
        self._stop_reason = reason
        self.release_all()

    def switch_over(self) -> None:
        """Let the player take over at once, everything released; or give back. Any thread may call this.

        Once taken over, nothing is pressed until whoever plays here calls ``take_back``, but for what is ``borrowed``.
        """
        with self._lock:
            self._is_players = not self._is_players
            if self._is_players:
                self._is_yielded, self._is_borrowed = True, False
                self.release_all()

    @property
    def has_yielded(self) -> bool:
        """Whether the player has the game, so that nothing is pressed."""
        return self._on_hands("yielded", self._is_yielded and not self._is_borrowed)

    def take_back(self) -> bool:
        """Return whether the player has given the game back; if so, presses are permitted again."""
        with self._lock:
            is_back = self._on_hands("given back", self._is_yielded and not self._is_players)
            self._is_yielded = self._is_yielded and not is_back
        return is_back

    @contextmanager
    def borrowed(self) -> Iterator[None]:
        """Permit presses for the block, though the player has the game. Taking over anew ends that at once."""
        self._is_borrowed = True
        try:
            yield
        finally:
            self._is_borrowed = False

    def check_yielded(self) -> None:
        """Raise TakenOverError while the player has the game."""
        if self.has_yielded:
            raise TakenOverError("the player has taken over, so nothing is pressed")

    def check_stopped(self) -> None:
        """Raise StoppedError once the controller was stopped."""
        if self._stop_reason is not None:
            raise StoppedError(f"{self._stop_reason}: every key is up, start again when you like")

    def check_front(self) -> None:
        """Raise NotInFrontError unless a key pressed now would reach the game."""
        if not self._display.is_in_front():
            raise not_in_front_error()

    def _check_running(self) -> None:
        self.check_stopped()
        self.check_yielded()
        self.check_front()

    def _permit(self, screen: PressTarget) -> None:
        """Look at the screen just before a press; look at all of it again if it was confirmed too long ago.

        The caller holds no lock: a look may take long, and meanwhile others must be able to release everything.
        """
        try:
            if self._was_seen(screen) and not self._is_fresh(screen) and self._look_again:
                self._look_again()
            if screen == "world":
                self._look_for_world()
        except BaseException:
            self.release_all()
            raise

    def _look_for_world(self) -> None:
        """Return once the world is seen with nothing over it, by the last look before the press.

        A picture may be black for a moment, and a look may take long on a busy machine: then all is looked at again.
        """
        was_fresh, must_look_again = self._is_fresh("world"), False
        began_at = self._clock.now()
        while True:
            began = self._clock.now()
            is_seen = self._sees_world()
            now = self._clock.now()
            self.look_s = now - began
            if not is_seen:
                if now >= began_at + PATIENCE_S:
                    raise WrongScreenError(
                        "the world is not seen with nothing over it, so nothing is pressed: close the chat or the "
                        "menu, show the hotbar (F1), and take off a resource pack that draws it otherwise"
                    )
                self.wait(TICK_S / 2)
                must_look_again = True
            elif self._look_again is None or not self._was_seen("world"):
                if was_fresh:  # else nothing that was seen permits the press, whatever the last look says
                    self._confirmed = "world", now
                return
            elif (self._is_fresh("world") and not must_look_again) or now >= began_at + SLOW_S:
                return
            else:
                self._look_again()
                must_look_again = False

    def _was_seen(self, screen: PressTarget) -> bool:
        return self._confirmed is not None and self._confirmed[0] == screen

    def _is_fresh(self, screen: PressTarget) -> bool:
        confirmed, at = self._confirmed or ("nothing", self._clock.now())
        return confirmed == screen and self._clock.now() - at <= FRESH_S

    def _check_press(self, screen: PressTarget) -> None:
        self._check_running()
        if not self._is_fresh(screen):
            raise WrongScreenError(f"the {screen} was not just seen on the screen, so nothing is pressed: look first")

    def _press_key(self, key: str, until: float, on: PressTarget) -> None:
        self._press(f"key {key}", partial(self._keyboard.press, key), partial(self._keyboard.release, key), until, on)

    def _press_button(self, button: Button, on: PressTarget) -> None:
        until = self._clock.now() + self._timing.click_s
        press, release = partial(self._pointer.press, button), partial(self._pointer.release, button)
        self._press(f"{button} button", press, release, until, on)

    def _press(
        self, name: str, press: Callable[[], None], release: Callable[[], None], until: float, on: PressTarget
    ) -> None:
        try:
            with self._lock:
                self._check_press(on)
                # Noted before it is pressed: an interrupt between the two would leave it down otherwise.
                now = self._clock.now()
                self._down_since = self._down_since or now
                self._held[name] = _Held(release, min(until, now + LONGEST_S))
                if on == "world":
                    self._pressed[name] = release
                press()
        except BaseException:
            self.release_all()
            raise

    def _release(self, names: Iterable[str]) -> None:
        # An exit stack runs every callback, whatever the others raise.
        with self._lock, ExitStack() as releases:
            for name in names:
                releases.callback(self._release_one, name)

    def _release_one(self, name: str) -> None:
        if held := self._held.get(name):
            held.release()
            self._held.pop(name, None)
