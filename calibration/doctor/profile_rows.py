"""The profile's checks: whether it can be read and fits the window; and the font to read the game with."""

from pathlib import Path

from calibration.doctor.check import Check, CheckName, check_from_message
from calibration.installation.folders import System, client_jars, jar_version
from mc_nested.errors import FontError, ProfileError
from mc_nested.live.profile.fingerprint import Fingerprint, mismatch
from mc_nested.live.profile.store import earlier_path, load_profile, profile_path
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import Font, load_font

_JARS_TRIED = 3
"""How many client jars are searched for a font."""


def profile_row(name: str) -> tuple[Profile | None, Check]:
    """Return the profile of that name, if it can be used, and its check."""
    path = profile_path(name)
    if not path.is_file():
        return None, Check(
            CheckName.PROFILE, "skip", f"none yet in {path}", f"mc-nested calibrate all --profile {name} makes it"
        )
    try:
        return load_profile(name), Check(CheckName.PROFILE, "pass", str(path))
    except ProfileError as error:
        what, _, remedy = str(error).rpartition(": ")
        if remedy.startswith("update"):  # of a newer version: mending it would lose what that wrote
            return None, Check(CheckName.PROFILE, "fail", what, remedy)
        earlier = earlier_path(path).is_file()
        undo = f"mend it, or mc-nested calibrate undo --profile {name}" if earlier else "mend it, or move it away"
        return None, Check(CheckName.PROFILE, "fail", str(error), undo)


def fit_row(name: str, profile: Profile | None, seen: Fingerprint | None) -> Check:
    """Check whether the profile still fits the window."""
    row, fix = CheckName.PROFILE_FITS, f"mc-nested calibrate all --profile {name}"
    if profile is None:
        return Check(row, "skip", "no profile to compare with")
    if profile.calibrated is None:
        return Check(row, "skip", "the profile doesn't say what it was calibrated on", fix)
    if seen is None:
        return Check(row, "skip", "no window to compare it with")
    if problem := mismatch(profile.calibrated, seen, name):
        return check_from_message(row, "fail", problem)
    return Check(row, "pass", f"calibrated on this version, size and scale, on {profile.calibrated.date}")


def font_row(
    profile: Profile | None, system: System, version: str | None, named: Path | None = None
) -> tuple[Font | None, Check]:
    """Return a font to read this game with, ``named``, the profile's or a jar's near the version, and its check."""
    if named is not None:
        return _named_font(named.expanduser())
    problem: FontError | None = None
    if profile is not None and profile.screen.font is not None:
        path = profile.screen.font_path()
        try:
            return load_font(path), Check(CheckName.FONT, "pass", f"the profile's: {path}")
        except FontError as error:
            problem = error
    for jar in client_jars(system, version)[:_JARS_TRIED]:
        try:
            font = load_font(jar)
        except FontError as error:
            problem = problem or error
            continue
        if problem is None:
            return font, Check(CheckName.FONT, "pass", f"found, of Minecraft {jar_version(jar)}: {jar}")
        return font, _with_problem(problem, f"; read with that of {jar}")
    if problem is not None:
        return None, _with_problem(problem, "")
    fix = "name your game's client jar: mc-nested calibrate font --font JAR"
    return None, Check(CheckName.FONT, "fail", "no client jar in any launcher's folder", fix)


def _named_font(path: Path) -> tuple[Font | None, Check]:
    try:
        return load_font(path), Check(CheckName.FONT, "pass", f"as named: {path}")
    except FontError as error:
        return None, _with_problem(error, "")


def _with_problem(problem: FontError, instead: str) -> Check:
    check = check_from_message(CheckName.FONT, "fail", str(problem))
    return Check(check.name, check.status, check.detail + instead, check.fix)
