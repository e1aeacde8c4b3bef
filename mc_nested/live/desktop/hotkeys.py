"""Hotkeys: keys that a person presses, heard whichever window is in front."""

import queue
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress

from mc_nested.errors import DesktopError
from mc_nested.live.desktop.keys import WORDS, check_key

LOOK_S = 0.2
"""Between two looks at whether the listener still runs; without a limit, Windows would hold back Ctrl+C."""


@contextmanager
def open_hotkeys(names: Collection[str]) -> Iterator[Callable[[], str]]:
    """Hears these keys while the context lasts; yields a function that waits for a press and returns the key's name.

    Hearing begins a moment after the context does: too late for a program's keys, but not for a person's. Needs a
    display: open the desktop first. Raises ProfileError for a name that no key has; the function raises DesktopError
    where the desktop doesn't let anybody listen.
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

    def hear_press(key: Key | KeyCode | None) -> None:
        # A key that is held long is heard as many presses and one release.
        if (name := name_of(key)) and name not in down:
            down.add(name)
            pressed.put(name)

    def hear_release(key: Key | KeyCode | None) -> None:
        down.discard(name_of(key))

    def wait() -> str:
        while listener.is_alive():
            with suppress(queue.Empty):
                return pressed.get(timeout=LOOK_S)
        raise DesktopError("this desktop lets no program listen for keys: allow it, or use another desktop")

    with Listener(on_press=hear_press, on_release=hear_release) as listener:
        listener.wait()
        yield wait
