"""``doctor --fix``: the safe values into options.txt, after a backup, and only while the game is closed.

The game keeps its options in memory and writes the whole file when it ends: what is changed meanwhile is lost.
"""

import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from calibration.doctor.examination import Examination
from calibration.doctor.options_rows import gui_scale_row
from calibration.game.options_txt import SAFE, OptionsTxt
from calibration.game.running import may_hold
from mc_nested.errors import ProfileError

GUI_SCALE = 2
"""What an Auto or too large GUI scale becomes, where the profile says nothing: it fits any window from 640 x 480 on."""


def repaired(found: Examination, say: Callable[[str], None]) -> bool:
    """Write the safe values into the game's options.txt, and say what was changed, or why nothing was; whether it was.

    ProfileError where the file can't be written; it is as it was then.
    """
    if found.options is None or found.folder is None:
        say("nothing to fix: no options.txt was read")
        return False
    if problem := _open_by(found):
        say(f"nothing was changed: {problem}")
        return False
    wanted = {**SAFE, **_gui_scale(found)}
    changes = found.options.changes(wanted)
    if not changes:
        say(f"nothing to fix: {found.options.path} is as it should be")
        return False
    try:
        backup = _replaced(found.options, found.options.with_values(wanted))
    except OSError as error:
        path = found.options.path
        raise ProfileError(f"{path}: can't be written ({error.strerror or error}): mend its permissions") from error
    told = ", ".join(f"{name} {before} -> {after}" for name, (before, after) in changes.items())
    say(f"{found.options.path}: {told}; as it was: {backup}")
    return True


def _open_by(found: Examination) -> str | None:
    """Why the game may be open; None where nothing says so."""
    if found.is_window_closed is False:
        return "the game is open: close it, and run this again"
    if found.processes is None:
        if found.is_window_closed is None:
            return "nobody knows whether the game is closed: run this on the desktop that shows it"
        return None
    folder = found.options.path.parent if found.options else None
    if folder and any(may_hold(each, folder) for each in found.processes):
        return f"a game runs that may use {folder}: close it, and run this again"
    return None


def _gui_scale(found: Examination) -> dict[str, str]:
    """A GUI scale for a game whose own can't be read, or changes with its window."""
    value = found.options.values.get("guiScale") if found.options else None
    if gui_scale_row(value, None).status not in ("warn", "fail"):
        return {}
    calibrated = found.profile.calibrated
    scale = found.profile.screen.gui_scale or (calibrated and calibrated.gui_scale) or GUI_SCALE
    return {"guiScale": str(scale)}


def _replaced(before: OptionsTxt, after: OptionsTxt) -> Path:
    """Replace the file whole, and keep it as it was beside it under a name that nothing has yet; that file."""
    path = before.path.resolve()  # several instances may share one file by links
    if path.read_bytes() != b"".join(before.lines):
        raise ProfileError(f"{path}: has changed meanwhile: close the game, and run this again")
    handle, beside = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(b"".join(after.lines))
            file.flush()
            os.fsync(file.fileno())
        shutil.copymode(path, beside)
        backup = _backup(path)
        Path(beside).replace(path)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise
    return backup


def _backup(path: Path) -> Path:
    number = 1
    while (backup := path.with_name(f"{path.name}.before-{number}")).exists():
        number += 1
    shutil.copy2(path, backup)
    return backup
