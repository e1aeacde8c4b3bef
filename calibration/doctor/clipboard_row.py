"""The clipboard's row: what it holds is read, a text is written and read, and what it held is put back."""

from calibration.doctor.check import Check, told
from mc_nested.errors import DesktopError
from mc_nested.live.devices import Clipboard

PROBE = "mc-nested doctor"


def clipboard_row(clipboard: Clipboard | None) -> Check:
    """Try the clipboard out; None where there is none to try."""
    row = "clipboard"
    if clipboard is None:
        return Check(row, "skip", "not looked at")
    try:
        before = clipboard.read()
        try:
            clipboard.write(PROBE)
            seen = clipboard.read()
        finally:
            clipboard.write(before)
        after = clipboard.read()
    except DesktopError as error:
        # Only the cross-check of the reader needs it: an agent plays without.
        return told(row, "warn", str(error))
    if seen != PROBE:
        return Check(row, "warn", "what is written isn't what is read", "close the program that keeps it")
    if after != before:
        return Check(row, "warn", "what it held could not be put back", "copy it again")
    return Check(row, "pass", "read and written; what it held is back")
