"""The clipboard of an X server, where copied text stays in the program that copied it (ICCCM, section 2).

Reading asks that program. Written text is kept by a small separate process (x11_keeper.py), which outlives this one and
ends when something else is copied, so a text that is put back stays.
"""

import select
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from Xlib import X
from Xlib.display import Display
from Xlib.error import ConnectionClosedError, DisplayError, XauthError, XError
from Xlib.protocol.request import SetSelectionOwner

from mc_nested.errors import ClipboardError
from mc_nested.live.devices import not_text_error

if TYPE_CHECKING:
    from Xlib.protocol.rq import Event
    from Xlib.xobject.drawable import Window

MOST_BYTES = 200_000
"""A longer text would come in pieces, and isn't read; an X request holds 262,140 bytes."""

_PATIENCE_S = 2.0
_KEEPER = Path(__file__).with_name("x11_keeper.py")


class X11Clipboard:
    """The text that Ctrl+V pastes, in the session of this process's display."""

    def read(self) -> str:
        with _connected() as display:
            clipboard = display.intern_atom("CLIPBOARD")
            if display.get_selection_owner(clipboard) == X.NONE:
                return ""
            window = display.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
            text = _converted(display, window, clipboard)
        if text is None:
            raise not_text_error()
        return text

    def write(self, text: str) -> None:
        if not text:
            with _connected() as display:
                clipboard = display.intern_atom("CLIPBOARD")
                SetSelectionOwner(display=display.display, window=X.NONE, selection=clipboard, time=X.CurrentTime)
                display.sync()
            return
        data = text.encode()
        if len(data) > MOST_BYTES:
            raise _too_long()
        # It gets no pipes: a reader of one would wait for as long as the keeper runs.
        command = [sys.executable, str(_KEEPER)]
        kept = subprocess.run(  # noqa: S603 - our own, with our own Python
            command, input=data, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False
        )
        if kept.returncode:
            raise ClipboardError("the clipboard can't be written: close the program that keeps it, and start again")


def _converted(display: Display, window: "Window", clipboard: int) -> str | None:
    """Return the clipboard as text; None where its owner has none to give."""
    prop = display.intern_atom("MC_NESTED_CLIPBOARD")
    for name in ("UTF8_STRING", "STRING"):
        window.convert_selection(clipboard, display.intern_atom(name), prop, X.CurrentTime)
        if _answer(display).property == X.NONE:
            continue
        found = window.get_full_property(prop, X.AnyPropertyType)
        window.delete_property(prop)
        if found is None or found.format != 8:
            raise _too_long()  # INCR: it would come in pieces
        value = found.value if isinstance(found.value, bytes) else str(found.value).encode()
        if len(value) > MOST_BYTES:
            raise _too_long()
        return value.decode("utf-8" if name == "UTF8_STRING" else "latin-1", "replace")
    return None


def _answer(display: Display) -> "Event":
    until = time.monotonic() + _PATIENCE_S
    while (left := until - time.monotonic()) > 0:
        display.flush()
        if not display.pending_events() and not select.select([display], [], [], left)[0]:
            break
        while display.pending_events():
            if (event := display.next_event()).type == X.SelectionNotify:
                return event
    raise ClipboardError("the program that holds the clipboard doesn't answer: copy any text, and start again")


@contextmanager
def _connected() -> Iterator[Display]:
    try:
        display = Display()
        try:
            yield display
        finally:
            display.close()
    except (DisplayError, XauthError, ConnectionClosedError, XError, OSError) as error:
        raise ClipboardError("the display has closed: start the desktop and the game again") from error


def _too_long() -> ClipboardError:
    return ClipboardError("the clipboard holds a text too long to be put back: copy a shorter one, and start again")
