"""Hear keys by their places, whichever window they go to and whatever the layout: for the panic key and for hotkeys."""

import queue
import sys
import threading
import time
from collections.abc import Callable, Collection, Iterator
from contextlib import AbstractContextManager, contextmanager, suppress
from typing import Any

from mc_nested.errors import DesktopError
from mc_nested.live.model.keys import EXTENDED, NAME_AT_MAC, NAME_AT_SCAN, canonical, check_key

OnKey = Callable[[str, bool], None]
"""Gets a key's canonical name, and whether it went down; in the listener's thread. A held key may go down
repeatedly."""

IsListening = Callable[[], bool]

Listen = Callable[[OnKey], AbstractContextManager[IsListening]]
"""``listening``, or a made-up one."""

CLOSE_S = 1.0
"""Seconds that a listener gets to close its connection to the desktop."""

_HOOK_LOOK_S = 0.001

_KEY_DOWN, _KEY_UP = (0x0100, 0x0104), (0x0101, 0x0105)
"""WM_KEYDOWN and WM_SYSKEYDOWN, WM_KEYUP and WM_SYSKEYUP (winuser.h)."""

_FROM_PREFIX = 1
"""LLKHF_EXTENDED in KBDLLHOOKSTRUCT's flags: the scancode has the prefix E0."""

_PACKET = 0xE7
"""VK_PACKET: a Unicode character, whose number stands in the place of the scancode."""


def listening(on_key: OnKey) -> AbstractContextManager[IsListening]:
    """While the context lasts, ``on_key`` is called for each key; yields whether it still listens.

    Needs a display: open the desktop first.
    """
    if sys.platform.startswith("linux"):
        from mc_nested.live.desktop.x11_key_listener import listening as listening_on_x11

        return listening_on_x11(on_key)
    return listening_through_pynput(on_key)


@contextmanager
def listening_through_pynput(on_key: OnKey) -> Iterator[IsListening]:
    """Listen as ``listening`` on Windows and macOS: there pynput passes on scancodes or keycodes."""
    from pynput.keyboard import Listener

    heard: queue.SimpleQueue[tuple[str, bool] | None] = queue.SimpleQueue()

    def hear(name: str | None, *, is_down: bool) -> None:
        if name is not None:
            heard.put((name, is_down))

    def on_hook(message: int, key: Any) -> bool:
        is_down = message in _KEY_DOWN
        if key.vkCode != _PACKET and (is_down or message in _KEY_UP):
            scan = key.scanCode | (EXTENDED if key.flags & _FROM_PREFIX else 0)
            hear(NAME_AT_SCAN.get(scan), is_down=is_down)
        return False  # pynput needn't ask the layout for its letter, which would also use up a dead key

    def on_press(key: Any) -> None:
        hear(NAME_AT_MAC.get(_mac_code(key)), is_down=True)

    def on_release(key: Any) -> None:
        hear(NAME_AT_MAC.get(_mac_code(key)), is_down=False)

    def tell() -> None:
        while (key := heard.get()) is not None:
            on_key(*key)

    # Never in the hook itself, for which Windows holds every key up: whoever presses one then waits for it.
    teller = threading.Thread(target=tell, name="keys", daemon=True)
    teller.start()
    try:
        with Listener(on_press=on_press, on_release=on_release, win32_event_filter=on_hook) as listener:
            listener.wait()
            _wait_for_hook(listener)
            yield listener.is_alive
        # It closes its connection some time after it is stopped.
        listener.join(CLOSE_S)
    finally:
        heard.put(None)
        teller.join(CLOSE_S)


def _wait_for_hook(listener: threading.Thread) -> None:
    """Wait until Windows passes keys to the listener: pynput's ``wait`` returns before it sets its hook."""
    hooks = sys.modules.get("pynput._util.win32")  # pynput says it nowhere else; elsewhere it isn't imported
    end = time.monotonic() + CLOSE_S
    while hooks is not None and time.monotonic() < end and listener.is_alive():
        hook = hooks.SystemHook._HOOKS.get(listener.ident)
        if hook is not None and hook._hook is not None:
            return
        time.sleep(_HOOK_LOOK_S)


def _mac_code(key: Any) -> int:
    """Return the virtual keycode of a key that pynput heard on macOS; -1 if it has none."""
    code = getattr(getattr(key, "value", key), "vk", None)
    return -1 if code is None else int(code)


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
