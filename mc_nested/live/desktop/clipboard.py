"""What every system's clipboard has in common: text only. Other contents are never touched."""

from mc_nested.errors import ClipboardError


def not_text_error() -> ClipboardError:
    """The error for a clipboard with a picture or files on it."""
    return ClipboardError("the clipboard holds something other than text, and is left alone: copy a text, start again")
