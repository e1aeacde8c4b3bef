"""Hotkeys: keys that a person presses, noticed whichever window is in front."""

import queue
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress

from mc_nested.errors import DesktopError
from mc_nested.live.model.key_names import WORDS, check_key

LOOK_S = 0.2
"""Seconds between two checks that the listener still runs. A wait without a limit would block Ctrl+C on Windows."""


@contextmanager
def open_hotkeys(names: Collection[str]) -> Iterator[Callable[[], str]]:
    """While the context lasts, listen for these keys; yields a function that waits for a press and returns its key.

    Listening begins a moment after the context does: too late for a program's keys, but not for a person's. Needs a
    display: open the desktop first. Raises ProfileError for a name that no key has; the function raises DesktopError
    where the desktop lets no program listen.
    """
    for name in names:
        check_key(name)
    from pynput.keyboard import Key, KeyCode, Listener

    named = {Key[WORDS[name]]: name for name in names if name in WORDS}
    pressed: queue.SimpleQueue[str] = queue.SimpleQueue()
    down: set[str] = set()

    def name_of(key: Key | KeyCode | None) -> str:
        name = named.get(key) if isinstance(key, Key) else key.char if key is not None else None
        return name if name is not None and name in names else ""

    def on_press(key: Key | KeyCode | None) -> None:
        # A key that is held long sends many presses and one release.
        if (name := name_of(key)) and name not in down:
            down.add(name)
            pressed.put(name)

    def on_release(key: Key | KeyCode | None) -> None:
        down.discard(name_of(key))

    def wait() -> str:
        while listener.is_alive():
            with suppress(queue.Empty):
                return pressed.get(timeout=LOOK_S)
        raise DesktopError("this desktop lets no program listen for keys: allow it, or use another desktop")

    with Listener(on_press=on_press, on_release=on_release) as listener:
        listener.wait()
        yield wait
