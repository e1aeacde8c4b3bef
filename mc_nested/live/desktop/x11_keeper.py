"""Keeps a text on the clipboard of an X server until something else is copied: python x11_keeper.py < text.

A separate process, because on an X server copied text is lost when the program that copied it ends. The command returns
0 once the clipboard is taken, or 1 where it can't be, and a child stays behind. It imports nothing of this project, so
that it starts quickly.
"""

import os
import sys

from Xlib import X, Xatom
from Xlib.display import Display
from Xlib.error import ConnectionClosedError
from Xlib.protocol import event


def main() -> int:
    """Take the clipboard, and keep it in the background; return 1 where it can't be taken."""
    text = sys.stdin.buffer.read()
    display = Display()
    window = display.screen().root.create_window(0, 0, 1, 1, 0, X.CopyFromParent)
    clipboard = display.intern_atom("CLIPBOARD")
    window.set_selection_owner(clipboard, X.CurrentTime)
    display.sync()
    if display.get_selection_owner(clipboard) != window:
        return 1
    if os.fork():
        os._exit(0)  # without closing the connection to the X server, which the child now has
    os.setsid()
    keep(display, text)
    return 0


def keep(display: Display, text: bytes) -> None:
    """Answer programs that paste, until something else is copied or the X server ends."""
    utf8, latin = display.intern_atom("UTF8_STRING"), text.decode(errors="replace").encode("latin-1", "replace")
    kinds = {display.intern_atom(name): (utf8, text) for name in ("UTF8_STRING", "TEXT")}
    plain = display.intern_atom("text/plain;charset=utf-8")
    kinds |= {plain: (plain, text), Xatom.STRING: (Xatom.STRING, latin)}
    targets = display.intern_atom("TARGETS")
    while True:
        try:
            request = display.next_event()
        except ConnectionClosedError:
            return
        if request.type == X.SelectionClear:
            return
        if request.type != X.SelectionRequest:
            continue
        prop = request.property or request.target  # old clients send no property
        if request.target == targets:
            request.requestor.change_property(prop, Xatom.ATOM, 32, [targets, *kinds])
        elif request.target in kinds:
            kind, data = kinds[request.target]
            request.requestor.change_property(prop, kind, 8, data)
        else:
            prop = X.NONE
        answer = event.SelectionNotify(
            time=request.time,
            requestor=request.requestor,
            selection=request.selection,
            target=request.target,
            property=prop,
        )
        request.requestor.send_event(answer)
        display.flush()


if __name__ == "__main__":
    sys.exit(main())
