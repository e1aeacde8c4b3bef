"""The clipboard of macOS: its general pasteboard."""

import sys

from mc_nested.errors import ClipboardError
from mc_nested.live.desktop.clipboard import no_text

if sys.platform == "darwin":
    import AppKit

assert sys.platform == "darwin"  # noqa: S101  mypy learns from it that the rest is for macOS alone


class QuartzClipboard:
    """What Cmd+V would paste."""

    def read(self) -> str:
        board = AppKit.NSPasteboard.generalPasteboard()
        text = board.stringForType_(AppKit.NSPasteboardTypeString)
        if text is None and board.types():
            raise no_text()
        return str(text or "")

    def write(self, text: str) -> None:
        board = AppKit.NSPasteboard.generalPasteboard()
        board.clearContents()
        if text and not board.setString_forType_(text, AppKit.NSPasteboardTypeString):
            raise ClipboardError("the clipboard can't be written: close the program that holds it, and start again")
