"""The watchdog: a thread of its own that lets go of what the program, hung or busy elsewhere, holds too long."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.live.hands import Hands

LOOK_S = 0.05


@contextmanager
def watched(hands: Hands) -> Iterator[None]:
    """While the context lasts, whatever the hands hold past its time goes up within 0.3 s, whatever else happens."""
    ended = threading.Event()

    def watch() -> None:
        while not ended.wait(LOOK_S):
            hands.release_overdue()

    thread = threading.Thread(target=watch, name="watchdog", daemon=True)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()
