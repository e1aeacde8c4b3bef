"""``doctor --fix``: writes safe values into options.txt, after a backup, and only while the game is closed.

The game keeps its options in memory and writes the whole file when it ends: changes made meanwhile are lost.
"""

import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from calibration.doctor.chat_rows import chat_mends
from calibration.doctor.examination import Examination
from calibration.doctor.options_rows import gui_scale_row
from calibration.installation.options_txt import SAFE, OptionsTxt
from calibration.installation.processes import may_have_open
from mc_nested.errors import ProfileError

GUI_SCALE = 2
"""Replaces an Auto or too large GUI scale if the profile has none: it fits any window from 640 x 480 on."""


def repair(examination: Examination, say: Callable[[str], None]) -> bool:
    """Write the safe values into the game's options.txt; say what was changed, or why nothing was. True if it was.

    ProfileError if the file can't be written; it is unchanged then.
    """
    if examination.options is None or examination.folder is None:
        say("nothing to fix: no options.txt was read")
        return False
    if problem := _why_open(examination):
        say(f"nothing was changed: {problem}")
        return False
    wanted = {**SAFE, **_gui_scale(examination), **chat_mends(examination.options)}
    changes = examination.options.changes(wanted)
    if not changes:
        say(f"nothing to fix: {examination.options.path} is as it should be")
        return False
    try:
        backup = _replace(examination.options, examination.options.with_values(wanted))
    except OSError as error:
        path = examination.options.path
        raise ProfileError(f"{path}: can't be written ({error.strerror or error}): mend its permissions") from error
    summary = ", ".join(f"{name} {before} -> {after}" for name, (before, after) in changes.items())
    say(f"{examination.options.path}: {summary}; as it was: {backup}")
    return True


def _why_open(examination: Examination) -> str | None:
    """Why the game may be open; None if nothing suggests it."""
    if examination.is_window_closed is False:
        return "the game is open: close it, and run this again"
    if examination.processes is None:
        if examination.is_window_closed is None:
            return "nobody knows whether the game is closed: run this on the desktop that shows it"
        return None
    folder = examination.options.path.parent if examination.options else None
    if folder and any(may_have_open(each, folder) for each in examination.processes):
        return f"a game runs that may use {folder}: close it, and run this again"
    return None


def _gui_scale(examination: Examination) -> dict[str, str]:
    """A GUI scale for a game whose own is too large, or changes with its window."""
    value = examination.options.values.get("guiScale") if examination.options else None
    if gui_scale_row(value, None).status not in ("warn", "fail"):
        return {}
    calibrated = examination.profile.calibrated
    scale = examination.profile.screen.gui_scale or (calibrated and calibrated.gui_scale) or GUI_SCALE
    return {"guiScale": str(scale)}


def _replace(before: OptionsTxt, after: OptionsTxt) -> Path:
    """Replace the file atomically, after a backup under an unused name; returns the backup."""
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
