"""The watchdog: a separate thread that releases keys held too long, even if the program hangs or is busy."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from mc_nested.live.input.input_controller import InputController
from mc_nested.live.model.timing import KEY_LOOK_S


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
