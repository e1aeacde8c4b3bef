"""How an agent is stopped from outside: by the panic switch, by a player who takes over, and by the watchdog.

The watchdog is a separate thread that releases keys held too long, even if the program hangs or is busy.
"""

import threading
from collections.abc import Callable, Collection, Iterator
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass

from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.timing import KEY_LOOK_S

Stop = Callable[[str], None]
"""Releases everything, and lets nothing be pressed again; takes the reason. Callable from any thread."""

Switch = Callable[[], None]
"""Lets a player take over, or give back. Callable from any thread."""


@dataclass(frozen=True)
class Takeover:
    """How a run lets a player take over.

    Args:
        offer: has something of the run's, as its view, switch over while its context lasts.
        is_stopped: whether somebody asked the run to stop: then nobody waits for the player.
        say: shows the player one line.
    """

    offer: Callable[[Switch], AbstractContextManager[None]] = lambda _: nullcontext()
    is_stopped: Callable[[], bool] = lambda: False
    say: Callable[[str], None] = lambda _: None


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
