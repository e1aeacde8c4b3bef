"""What is left when the desktop itself goes away under a running game, as an X server that ends does."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.errors import DesktopError

LOST: tuple[type[Exception], ...] = ()
"""What pynput and pyautogui raise once the desktop is gone. A press after that is an error; a release isn't: the server
that held the key is no more."""

if sys.platform.startswith("linux"):
    from Xlib.error import ConnectionClosedError

    LOST = (ConnectionClosedError,)


@contextmanager
def told_when_lost() -> Iterator[None]:
    """DesktopError, one line, where the desktop is gone."""
    try:
        yield
    except LOST as error:
        raise DesktopError("the display has closed: start the desktop and the game again") from error
