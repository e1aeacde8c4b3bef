"""Hears an X server's keys by their places, whichever window they go to, through its RECORD extension."""

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

from Xlib import X
from Xlib.display import Display
from Xlib.error import ConnectionClosedError
from Xlib.ext import record
from Xlib.protocol import rq

from mc_nested.live.desktop.x11_keyboard import EVDEV_TO_KEYCODE
from mc_nested.live.model.keys import NAME_AT_EVDEV

READY_S = 2.0
"""Seconds that the server gets to begin, and the listener to end."""

_NOTHING = (0, 0)
_NOTHING_OF_EXTENSIONS = (0, 0, 0, 0)
_KEYS: Any = {
    "core_requests": _NOTHING,
    "core_replies": _NOTHING,
    "ext_requests": _NOTHING_OF_EXTENSIONS,
    "ext_replies": _NOTHING_OF_EXTENSIONS,
    "delivered_events": _NOTHING,
    "device_events": (X.KeyPress, X.KeyRelease),
    "errors": _NOTHING,
    "client_started": False,
    "client_died": False,
}
"""What is recorded: the keyboard's own events. Text that a program sends to a window is none."""


@contextmanager
def listening(on_key: Callable[[str, bool], None]) -> Iterator[Callable[[], bool]]:
    """While the context lasts, ``on_key`` gets the name of each key that goes down (True) or up, in another thread.

    Yields a function that says whether it still listens.
    """
    control, recorder = Display(), Display()
    context = recorder.record_create_context(0, [record.AllClients], [_KEYS])
    recorder.sync()
    has_begun = threading.Event()

    def on_reply(reply: Any) -> None:
        if reply.category == record.StartOfData:
            has_begun.set()
        data = reply.data if reply.category == record.FromServer else b""
        while data:
            event, data = rq.EventField("event").parse_binary_value(data, recorder.display, None, None)
            if name := NAME_AT_EVDEV.get(event.detail - EVDEV_TO_KEYCODE):
                on_key(name, event.type == X.KeyPress)

    def record_keys() -> None:
        with suppress(ConnectionClosedError):  # the X server may end first
            recorder.record_enable_context(context, on_reply)

    thread = threading.Thread(target=record_keys, name="keys", daemon=True)
    thread.start()
    has_begun.wait(READY_S)
    try:
        yield thread.is_alive
    finally:
        with suppress(ConnectionClosedError):
            control.record_disable_context(context)
            control.sync()
        thread.join(READY_S)
        for display in (control, recorder):
            with suppress(ConnectionClosedError):
                display.close()
