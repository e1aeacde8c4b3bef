"""Raise one error when the desktop itself disappears under a running game, as an X server that ends does."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.errors import DesktopError

LOST: tuple[type[Exception], ...] = ()
"""What pynput and pyautogui raise once the desktop is gone. A press is then an error. A release is not: the server that
held the key no longer exists."""

if sys.platform.startswith("linux"):
    from Xlib.error import ConnectionClosedError

    LOST = (ConnectionClosedError,)


@contextmanager
def raise_when_display_lost() -> Iterator[None]:
    """Raise DesktopError, in one line, where the desktop is gone."""
    try:
        yield
    except LOST as error:
        raise DesktopError("the display has closed: start the desktop and the game again") from error
