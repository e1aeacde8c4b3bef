"""The clipboard of Windows, through pyperclip, which waits while another program has it open."""

import ctypes
import sys

from mc_nested.errors import ClipboardError
from mc_nested.live.desktop.clipboard import no_text

if sys.platform == "win32":
    import pyperclip

assert sys.platform == "win32"  # noqa: S101  mypy learns from it that the rest is for Windows alone

_user32 = ctypes.WinDLL("user32", use_last_error=True)


class Win32Clipboard:
    """What Ctrl+V would paste."""

    def read(self) -> str:
        try:
            text = str(pyperclip.paste())
        except pyperclip.PyperclipException as error:
            raise _unreachable(error) from error
        if not text and _user32.CountClipboardFormats():
            raise no_text()
        return text

    def write(self, text: str) -> None:
        try:
            pyperclip.copy(text)
        except pyperclip.PyperclipException as error:
            raise _unreachable(error) from error


def _unreachable(error: Exception) -> ClipboardError:
    return ClipboardError(f"the clipboard can't be reached ({error}): close the program that holds it, and start again")
