"""The devices between an agent and a game, as protocols that a desktop and the virtual client both implement.

``live`` and ``calibration`` use these alone; ``desktop/`` has the real ones. A deadline on the clock bounds every wait.
"""

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from mc_nested.errors import ClipboardError

Frame = NDArray[np.uint8]
"""A picture (height, width, 3), blue green red, in framebuffer pixels."""

Button = Literal["left", "right", "middle"]


SWITCH_KEYS = "Alt+Tab (Cmd+Tab on a Mac)"
"""What a person brings the game to the front with. A click does so, too, but the game also takes it as an attack, which
breaks the block that the player looks at (FACTS: Input and windows)."""


@dataclass(frozen=True)
class Region:
    """A rectangle of a window's client area, in framebuffer pixels from its top left corner."""

    left: int
    top: int
    width: int
    height: int

    @property
    def slices(self) -> tuple[slice, slice]:
        """Its rows and columns in a picture; what lies left of that or above it is cut off."""
        top, left = max(0, self.top), max(0, self.left)
        return slice(top, max(top, self.top + self.height)), slice(left, max(left, self.left + self.width))


@dataclass(frozen=True)
class DesktopArea:
    """A rectangle of the desktop, in the desktop's points: not always pixels (FACTS: Input and windows)."""

    left: int
    top: int
    width: int
    height: int


class Clock(Protocol):
    """Monotonic time in seconds, from an arbitrary zero."""

    def now(self) -> float: ...

    def sleep_until(self, at: float) -> None:
        """Return at the time ``at``, or at once if it has passed."""


class Display(Protocol):
    """The game's window, and nothing of the desktop around it."""

    def size(self) -> tuple[int, int]:
        """Return the width and height of the client area in framebuffer pixels."""

    def title(self) -> str: ...

    def is_in_front(self) -> bool:
        """Return whether a key pressed now would reach this window."""

    def grab(self, region: Region | None = None) -> Frame:
        """Return a picture of the client area, or of a region of it.

        Where one that can't be written to is returned again, the very same array, nothing has changed since.
        """


class Keyboard(Protocol):
    """Keys by their place, text by its characters.

    A key is named by what a US keyboard has at its place: one character ("w", "/") or a word ("enter", "esc", "f3",
    "left.shift", "space"). Whatever the layout, the game takes it as that key; to 1.12 it does so once
    ``go_by_symbols`` was called (FACTS: Input and windows).
    """

    def go_by_symbols(self, keys: Collection[str]) -> None:
        """Press from now on what a game to 1.12 takes as a key: it goes by symbols, and not by places.

        DesktopError, before anything is pressed, where this keyboard's layout lacks one of ``keys``.
        """

    def press(self, key: str) -> None: ...

    def release(self, key: str) -> None: ...

    def type(self, text: str) -> None:
        """Type a line of text into whatever has the focus; nothing stays down, whatever happens."""


class Pointer(Protocol):
    """The mouse, in framebuffer pixels from the window's top left corner."""

    def position(self) -> tuple[int, int]: ...

    def move(self, x: int, y: int) -> None: ...

    def press(self, button: Button) -> None: ...

    def release(self, button: Button) -> None: ...


class Clipboard(Protocol):
    """The desktop's clipboard, as text."""

    def read(self) -> str: ...

    def write(self, text: str) -> None: ...


@dataclass(frozen=True)
class Devices:
    """The devices of one game window.

    ``area`` gives where on the desktop the window's client area is, ``monitors`` where the monitors are: an empty tuple
    where the system lists none. Each is None where it can't be known.
    """

    display: Display
    keyboard: Keyboard
    pointer: Pointer
    clock: Clock
    clipboard: Clipboard
    area: Callable[[], DesktopArea] | None = None
    monitors: Callable[[], tuple[DesktopArea, ...]] | None = None


class Deadline:
    """The time ``seconds`` from now, on ``clock``."""

    def __init__(self, clock: Clock, seconds: float) -> None:
        self._clock = clock
        self.at = clock.now() + seconds

    @property
    def has_passed(self) -> bool:
        """Whether the clock has reached it."""
        return self._clock.now() >= self.at


def not_text_error() -> ClipboardError:
    """Return the error for a clipboard with a picture or files on it."""
    return ClipboardError("the clipboard holds something other than text, and is left alone: copy a text, start again")
