"""``doctor --fix``: mends options.txt and debug-profile.json, after a backup, and only while the game is closed.

The game keeps both in memory and writes the whole files: changes made meanwhile are lost.
"""

import itertools
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from calibration.doctor.examination import Examination
from calibration.doctor.options_rows import SAFE, chat_mends, debug_scale_row, gui_scale_row
from calibration.installation.options_txt import OptionsTxt
from calibration.installation.processes import may_have_open
from mc_nested.atomic_file import refused_as
from mc_nested.errors import ProfileError

GUI_SCALE = 2
"""Replaces an Auto or too large GUI scale if the profile has none: it fits any window from 640 x 480 on."""

_NEW_FILE_MODE = 0o644
"""All users may read a file of the game's; a temporary file could be read by its maker alone."""


def repair(examination: Examination, say: Callable[[str], None]) -> bool:
    """Write the safe values into the game's options.txt, and what is needed into its debug-profile.json.

    Says what was changed, or why nothing was. True if anything was. ProfileError if a file can't be written; it is
    unchanged then.
    """
    if examination.options is None or examination.folder is None:
        say("nothing to fix: no options.txt was read")
        return False
    if problem := _why_open(examination):
        say(f"nothing was changed: {problem}")
        return False
    has_changed = False
    for mend in (_mend_options, _mend_entries):
        if summary := mend(examination):
            say(summary)
            has_changed = True
    if not has_changed:
        say(f"nothing to fix: {examination.options.path} is as it should be")
    return has_changed


def _mend_options(examination: Examination) -> str | None:
    """Write the safe values into options.txt; return what was changed, None if nothing was."""
    options = examination.options
    if options is None:
        return None
    wanted = {**SAFE, **_gui_scale(examination), **_debug_scale(options), **chat_mends(options)}
    changes = options.changes(wanted)
    if not changes:
        return None
    backup = _replace(options.path, b"".join(options.lines), b"".join(options.with_values(wanted).lines))
    summary = ", ".join(f"{name} {before} -> {after}" for name, (before, after) in changes.items())
    return f"{options.path}: {summary}; as it was: {backup}"


def _mend_entries(examination: Examination) -> str | None:
    """Switch the needed entries of the debug screen on; return what was changed, None if nothing was."""
    entries = examination.entries
    if entries is None or not (entries.off or entries.problem):
        return None
    backup = _replace(entries.path, entries.data, entries.mended(examination.data_version))
    on = " and ".join(entries.off or entries.needed)
    return f"{entries.path}: {on} switched on; {f'as it was: {backup}' if backup else 'there was none'}"


def _why_open(examination: Examination) -> str | None:
    """Return why the game may be open; None if nothing suggests it."""
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
    """Return a GUI scale for a game whose own is too large, or changes with its window."""
    value = examination.options.values.get("guiScale") if examination.options else None
    if gui_scale_row(value, None).status not in ("warn", "fail"):
        return {}
    calibrated = examination.profile.calibrated
    scale = (calibrated and calibrated.gui_scale) or GUI_SCALE
    return {"guiScale": str(scale)}


def _debug_scale(options: OptionsTxt) -> dict[str, str]:
    """Return the game's own scale of the debug screen's text, where the file has none that is one."""
    is_none = debug_scale_row(options.values.get("debugGuiScale"), None, None).status == "warn"
    return {"debugGuiScale": "0"} if is_none else {}


def _replace(named: Path, before: bytes | None, after: bytes) -> Path | None:
    """Replace a file atomically, after a backup under an unused name; returns the backup, None where no file was."""
    path = named.resolve()  # several instances may share one file by links
    with refused_as(ProfileError, named, "mend its permissions"):
        if (path.read_bytes() if path.exists() else None) != before:
            raise ProfileError(f"{path}: has changed meanwhile: close the game, and run this again")
        return _written(path, after)


def _written(path: Path, data: bytes) -> Path | None:
    handle, beside = tempfile.mkstemp(dir=path.parent, prefix=path.name, suffix=".part")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        backup = None
        if path.exists():
            shutil.copymode(path, beside)
            unused = (path.with_name(f"{path.name}.before-{number}") for number in itertools.count(1))
            backup = next(name for name in unused if not name.exists())
            shutil.copy2(path, backup)
        else:
            Path(beside).chmod(_NEW_FILE_MODE)
        Path(beside).replace(path)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise
    return backup
