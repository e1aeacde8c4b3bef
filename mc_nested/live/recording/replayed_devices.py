"""Devices that answer as they did when a tape was recorded, and press nothing.

Each call must be the one that was recorded, and gets the answer that was recorded.
"""

from collections.abc import Callable, Collection, Iterator
from typing import Any

import numpy as np

from mc_nested import errors
from mc_nested.live.devices import Button, Devices, Frame, Region
from mc_nested.live.journal import Fact, NoteKind
from mc_nested.live.recording.format import plain_value


class OtherCall(BaseException):
    """This version makes another call than was recorded. No ``except`` for errors ends it."""

    def __init__(self, then: list[Any] | None, now: list[Any]) -> None:
        super().__init__(then, now)
        self.then, self.now = then, now


class ReplayedTape:
    """The calls of a recording, one after the other.

    Args:
        calls: as plain values, in their order.
    """

    def __init__(self, calls: Iterator[list[Any]]) -> None:
        self._calls = calls
        self._next: list[Any] | None = None
        self.is_followed = False
        """Whether what is called now is compared: only within an episode, until it first differs."""
        self.stop_reason: str | None = None
        """Why a person stopped the run, once the calls have come that far."""
        self.on_release: Callable[[str], None] = lambda _: None
        """Is told what another thread released, by the input controller's name of it, before the call that follows."""
        self._released: list[list[Any]] = []

    def peek(self) -> list[Any] | None:
        """Return the next call of the thread that played; None at the end."""
        while self._next is None:
            call = next(self._calls, None)
            if call is None:
                return None
            if call[0] != "elsewhere":
                self._next = call
            elif call[1] == "stop":
                self.stop_reason = str(call[2])
            elif call[2] == "release":
                self._released.append(call[1:])
                self.on_release(f"key {call[3]}" if call[1] == "key" else f"{call[3]} button")
        return self._next

    def skip(self) -> None:
        """Go on behind the next call."""
        self._next = None
        self._released.clear()

    def same(self, *asked: Any) -> list[Any]:
        """Return the recorded call, which must begin as this one; what follows is its answer.

        Raises OtherCall if it is another one, or the error that the call then raised.
        """
        now = plain_value(list(asked))
        then = self.peek()
        if now in self._released:
            return []  # this thread came too late for it
        if then is not None and then[0] == "error" and then[1] == asked[0]:
            self.skip()
            kind = getattr(errors, str(then[2]), errors.McNestedError)
            raise kind(then[3])
        if not self.is_followed or then is None or then[: len(now)] != now:
            self.is_followed = False
            raise OtherCall(then, now)
        self.skip()
        return then[len(now) :]

    def hands(self, whose: str, _: bool) -> bool:
        """Return whether the player had taken over, or given back, at this call."""
        was_so = self.is_followed and self.peek() == ["hands", whose]
        if was_so:
            self.skip()
        return was_so

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        """Check that the note is the recorded one; outside an episode none is compared."""
        if self.is_followed:
            self.same("note", kind, facts)


def replayed(tape: ReplayedTape, size: tuple[int, int], title: str) -> Devices:
    """Return the devices of a window that had this size and title when the recording began."""
    return Devices(_Display(tape, size, title), _Keyboard(tape), _Pointer(tape), _Clock(tape), _Clipboard(tape))


class OnReplayedTape:
    """What answers from a tape."""

    def __init__(self, tape: ReplayedTape) -> None:
        self._tape = tape


class _Clock(OnReplayedTape):
    def now(self) -> float:
        return float(self._tape.same("now")[0])

    def sleep_until(self, at: float) -> None:
        self._tape.same("sleep", at)


class _Display:
    def __init__(self, tape: ReplayedTape, size: tuple[int, int], title: str) -> None:
        self._tape, self._size, self._title = tape, size, title

    def size(self) -> tuple[int, int]:
        if not self._tape.is_followed:
            return self._size
        width, height = self._tape.same("size")[0]
        return int(width), int(height)

    def title(self) -> str:
        return str(self._tape.same("title")[0]) if self._tape.is_followed else self._title

    def is_in_front(self) -> bool:
        return bool(self._tape.same("front")[0])

    def grab(self, region: Region | None = None) -> Frame:
        self._tape.same("grab", region)
        width, height = (region.width, region.height) if region else self._size
        return np.zeros((height, width, 3), np.uint8)


class _Keyboard(OnReplayedTape):
    def go_by_symbols(self, keys: Collection[str]) -> None:
        """Do nothing: a tape has the keys that were meant, whatever this desktop would have pressed for them."""

    def press(self, key: str) -> None:
        self._tape.same("key", "press", key)

    def release(self, key: str) -> None:
        # After a difference everything that is held is released, which was not recorded.
        if self._tape.is_followed:
            self._tape.same("key", "release", key)

    def type(self, text: str) -> None:
        self._tape.same("key", "type", text)


class _Pointer(OnReplayedTape):
    def position(self) -> tuple[int, int]:
        x, y = self._tape.same("position")[0]
        return int(x), int(y)

    def move(self, x: int, y: int) -> None:
        self._tape.same("mouse", "move", x, y)

    def press(self, button: Button) -> None:
        self._tape.same("mouse", "press", button)

    def release(self, button: Button) -> None:
        if self._tape.is_followed:
            self._tape.same("mouse", "release", button)


class _Clipboard(OnReplayedTape):
    def read(self) -> str:
        self._tape.same("clipboard", "read")
        return ""

    def write(self, text: str) -> None:
        del text
        self._tape.same("clipboard", "write")
