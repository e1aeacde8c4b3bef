"""Hotkeys: keys that a person presses, noticed whichever window is in front."""

import queue
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.key_listener import Listen, listening
from mc_nested.live.model.key_names import canonical, check_key

LOOK_S = 0.2
"""Seconds between two checks that the listener still runs. A wait without a limit would block Ctrl+C on Windows."""


@contextmanager
def open_hotkeys(names: Collection[str], listen: Listen = listening) -> Iterator[Callable[[], str]]:
    """While the context lasts, listen for these keys; yields a function that waits for a press and returns its key.

    Needs a display: open the desktop first. Raises ProfileError for a name that no key has; the function raises
    DesktopError where the desktop lets no program listen.
    """
    for name in names:
        check_key(name)
    wanted = {canonical(name): name for name in names}
    pressed: queue.SimpleQueue[str] = queue.SimpleQueue()
    down: set[str] = set()

    def on_key(key: str, is_down: bool) -> None:
        if not is_down:
            down.discard(key)
        # A key that is held long sends many presses and one release.
        elif key in wanted and key not in down:
            down.add(key)
            pressed.put(wanted[key])

    def wait() -> str:
        while is_listening():
            with suppress(queue.Empty):
                return pressed.get(timeout=LOOK_S)
        raise DesktopError("this desktop lets no program listen for keys: allow it, or use another desktop")

    with listen(on_key) as is_listening:
        yield wait
