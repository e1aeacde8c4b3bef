"""The real clipboard, each system's in its own way. Text only: what else it holds is never touched."""

import sys

from mc_nested.errors import ClipboardError
from mc_nested.live.devices import Clipboard


def open_clipboard() -> Clipboard:
    """This desktop's clipboard; nothing is asked of it yet.

    Raises (both methods): ClipboardError where the clipboard holds something else than text, which could not be put
    back; or where it can't be reached.
    """
    if sys.platform == "win32":
        from mc_nested.live.desktop.win32_clipboard import Win32Clipboard

        return Win32Clipboard()
    if sys.platform == "darwin":
        from mc_nested.live.desktop.quartz_clipboard import QuartzClipboard

        return QuartzClipboard()
    from mc_nested.live.desktop.x11_clipboard import X11Clipboard

    return X11Clipboard()


def no_text() -> ClipboardError:
    """The error for a clipboard with a picture or files on it."""
    return ClipboardError("the clipboard holds something else than text, and is left alone: copy any text, start again")
