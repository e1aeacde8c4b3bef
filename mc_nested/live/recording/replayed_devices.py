"""Devices that answer as they did when a tape was recorded, and press nothing."""

from collections.abc import Collection

import numpy as np

from mc_nested.live.devices import Button, Devices, Frame, Region
from mc_nested.live.recording.replayed_tape import ReplayedTape


def replayed(tape: ReplayedTape, size: tuple[int, int], title: str) -> Devices:
    """The devices of a window that had this size and title when the recording began."""
    return Devices(_Display(tape, size, title), _Keyboard(tape), _Pointer(tape), _Clock(tape), _Clipboard(tape))


class _Clock:
    def __init__(self, tape: ReplayedTape) -> None:
        self._tape = tape

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


class _Keyboard:
    def __init__(self, tape: ReplayedTape) -> None:
        self._tape = tape

    def go_by_symbols(self, keys: Collection[str]) -> None:
        """What is pressed is the desktop's own; a tape has the keys that were meant."""

    def press(self, key: str) -> None:
        self._tape.same("key", "press", key)

    def release(self, key: str) -> None:
        # After a difference everything that is held is released, which was not recorded.
        if self._tape.is_followed:
            self._tape.same("key", "release", key)

    def type(self, text: str) -> None:
        self._tape.same("key", "type", text)


class _Pointer:
    def __init__(self, tape: ReplayedTape) -> None:
        self._tape = tape

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


class _Clipboard:
    def __init__(self, tape: ReplayedTape) -> None:
        self._tape = tape

    def read(self) -> str:
        self._tape.same("clipboard", "read")
        return ""

    def write(self, text: str) -> None:
        del text
        self._tape.same("clipboard", "write")
