"""One rehearsal at a time on a desktop: an agent could not tell two windows of the game apart."""

import os
import re
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from mc_nested.errors import DesktopError, SeveralWindowsError, UserError
from mc_nested.file_lock import file_lock
from mc_nested.live.desktop import this_system
from mc_nested.live.profile.tables import WindowTable


@contextmanager
def alone_on_this_desktop() -> Iterator[None]:
    """Hold this desktop for the block; UserError where a window of the game is open already, or opening."""
    with file_lock(_lock_file()) as lock:
        if not lock.is_mine or _has_window():
            raise UserError("a window of Minecraft, or another rehearsal, is open: close it first")
        yield


def _lock_file() -> Path:
    """Return the lock file of this user's rehearsals on this desktop: one at a time holds it."""
    user = "" if sys.platform == "win32" else f"-{os.getuid()}"  # Windows has a temporary folder for each
    display = os.environ.get("DISPLAY", "") if sys.platform.startswith("linux") else ""
    server = re.sub(r"[^A-Za-z0-9]+", "-", re.sub(r"\.[0-9]+$", "", display))  # a server's screens are one desktop
    return Path(tempfile.gettempdir()) / f"mc-nested-rehearsal{user}{server}.lock"


def _has_window() -> bool:
    try:
        with this_system().open_window(WindowTable().title):
            return True
    except SeveralWindowsError:
        return True
    except DesktopError:  # none, or one that can't be used: the window itself says why, if it can't be opened
        return False
