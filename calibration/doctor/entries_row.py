"""The check of ``debug-profile.json``: whether the debug screen's entries that are needed to play are on."""

from collections.abc import Mapping

from calibration.doctor.check import FIX, Check, CheckName, check_from_message
from calibration.installation.debug_profile import DebugProfile, load_debug_profile, version_of_data
from calibration.installation.folders import GameFolder
from calibration.installation.options_txt import OptionsTxt
from mc_nested.errors import ProfileError
from mc_nested.live.model.debug_entries import has_entries, on_button
from mc_nested.live.model.versions import is_minecrafts

_SEEN = (CheckName.POSITION_LINE, CheckName.TARGET_LINE)
"""The checks of the lines that the needed entries show."""


def installed_version(
    in_title: str | None, folder: GameFolder | None, options: OptionsTxt | None, calibrated: str | None
) -> str | None:
    """Return the version that is installed, as far as its debug screen's entries go.

    It is taken from the window's title, else from the launcher's records, else from options.txt, where the game wrote
    it, else from the calibrated profile. None if nothing says.
    """
    if in_title is not None:
        return in_title
    if folder is not None and folder.version is not None and is_minecrafts(folder.version):
        return folder.version
    written = options.values.get("version", "") if options is not None else ""
    return version_of_data(int(written)) if written.isdecimal() else calibrated


def entries_row(
    folder: GameFolder | None, version: str | None, known: Mapping[CheckName, Check]
) -> tuple[DebugProfile | None, Check]:
    """Return what the game's debug-profile.json says, if this version has one, and its check.

    ``known`` are the checks of what the window shows: what is seen there is on, whatever a file says.
    """
    row = CheckName.DEBUG_ENTRIES
    if version is None:
        return None, Check(row, "skip", "which version this is isn't known")
    if not has_entries(version):
        return None, Check(row, "pass", "this version always shows what is needed")
    if folder is None:
        return None, Check(row, "skip", "no launcher's game folder to look into")
    try:
        profile = load_debug_profile(folder.path, version)
    except ProfileError as error:
        return None, check_from_message(row, "fail", str(error).removeprefix(f"{folder.path}: "))
    is_seen = all(name in known and known[name].status == "pass" for name in _SEEN)
    return profile, Check(row, "pass", f"{_listed(profile.needed)} are seen to be on") if is_seen else _judged(profile)


def _judged(profile: DebugProfile) -> Check:
    row = CheckName.DEBUG_ENTRIES
    if profile.problem is not None:
        detail = f"{profile.path} is damaged, {profile.problem}: the game will replace it by its default entries"
        return Check(row, "fail", detail, FIX)
    if not profile.off:
        return Check(row, "pass", f"{_listed(profile.needed)} are on")
    why = "" if profile.data is not None else ", since the default entries are shown"
    detail = f"{_listed(profile.off)} {'are' if len(profile.off) > 1 else 'is'} off{why}"
    fix = f"press F3+F6 in the game, and set {_listed(profile.off)} to {on_button(profile.version)}; or {FIX}"
    return Check(row, "fail", detail, fix)


def target_row_by_entries(profile: DebugProfile | None, known: Mapping[CheckName, Check]) -> Check | None:
    """Return the check of a looked-at line that isn't seen, and whose entry is off; else None.

    With that entry off, no block is seen wherever the player looks: the advice to look at one would be wrong.
    """
    row, entries = known.get(CheckName.TARGET_LINE), known.get(CheckName.DEBUG_ENTRIES)
    if profile is None or row is None or entries is None or row.status == "pass" or entries.status != "fail":
        return None
    if profile.needed[1] not in profile.off:
        return None
    return Check(CheckName.TARGET_LINE, "fail", f"its entry {profile.needed[1]} is off", entries.fix)


def _listed(names: tuple[str, ...] | list[str]) -> str:
    return " and ".join(names)
