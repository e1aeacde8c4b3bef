"""Two ways to stop an agent from outside: the panic switch, by which a person stops everything, and the watchdog.

The watchdog is a separate thread that releases keys held too long, even if the program hangs or is busy.
"""

import threading
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager

from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.timing import KEY_LOOK_S

Stop = Callable[[str], None]
"""Releases everything, and lets nothing be pressed again; takes the reason. Callable from any thread."""

Switch = Callable[[], None]
"""Lets a player take over, or give back. Callable from any thread."""

KEY_REASON = "the panic key was pressed"
CORNER_REASON = "the mouse was moved into a corner of the screen"


def corners_of(width: int, height: int) -> Collection[tuple[int, int]]:
    """Return the corners of a screen of that size, in its own points."""
    return frozenset({(0, 0), (width - 1, 0), (0, height - 1), (width - 1, height - 1)})


@contextmanager
def watched(controller: InputController) -> Iterator[None]:
    """While the context lasts, a key or button held past its time is released within 0.3 s, whatever else happens."""
    ended = threading.Event()

    def watch() -> None:
        while not ended.wait(KEY_LOOK_S):
            controller.release_overdue()

    thread = threading.Thread(target=watch, name="watchdog", daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
