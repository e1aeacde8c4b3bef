"""The clipboard's check: read its contents, write and read a text, and restore the contents."""

from calibration.doctor.check import Check, CheckName, check_from_message
from mc_nested.errors import DesktopError
from mc_nested.live.devices import Clipboard

PROBE = "mc-nested doctor"


def clipboard_row(clipboard: Clipboard | None) -> Check:
    """Try the clipboard out; None if there is none."""
    row = CheckName.CLIPBOARD
    if clipboard is None:
        return Check(row, "skip", "not looked at")
    try:
        before = clipboard.read()
        try:
            clipboard.write(PROBE)
            read = clipboard.read()
        finally:
            clipboard.write(before)
        after = clipboard.read()
    except DesktopError as error:
        # Only the cross-check of the reader needs the clipboard: an agent plays without it.
        return check_from_message(row, "warn", str(error))
    if read != PROBE:
        return Check(row, "warn", "what is written isn't what is read", "close the program that keeps it")
    if after != before:
        return Check(row, "warn", "what it held could not be put back", "copy it again")
    return Check(row, "pass", "read and written; what it held is back")
