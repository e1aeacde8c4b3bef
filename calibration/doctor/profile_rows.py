"""The profile's rows: whether it can be read, whether it fits what is seen; and the font to read the game with."""

from calibration.doctor.check import Check, told
from calibration.game.folders import System, client_jars, jar_version
from mc_nested.errors import FontError, ProfileError
from mc_nested.live.fingerprint import Seen, misfit
from mc_nested.live.font import Font, load_font
from mc_nested.live.profile import Profile, earlier_path, load_profile, profile_path

_JARS_TRIED = 3
"""Client jars that are looked into for a font before none counts as found."""


def profile_row(name: str) -> tuple[Profile | None, Check]:
    """The profile of that name, if it can be used, and its row."""
    path = profile_path(name)
    if not path.is_file():
        return None, Check(
            "profile", "skip", f"none yet in {path}", f"mc-nested calibrate all --profile {name} makes it"
        )
    try:
        return load_profile(name), Check("profile", "pass", str(path))
    except ProfileError as error:
        earlier = earlier_path(path).is_file()
        undo = f"mend it, or mc-nested calibrate undo --profile {name}" if earlier else "mend it, or move it away"
        return None, Check("profile", "fail", str(error), undo)


def fit_row(name: str, profile: Profile | None, seen: Seen | None) -> Check:
    """Whether the profile still fits the window that is seen."""
    row, again = "profile fits", f"mc-nested calibrate all --profile {name}"
    if profile is None:
        return Check(row, "skip", "no profile to compare with")
    if profile.calibrated is None:
        return Check(row, "skip", "the profile doesn't say what it was calibrated on", again)
    if seen is None:
        return Check(row, "skip", "no window to compare it with")
    if problem := misfit(profile.calibrated, seen, name):
        return told(row, "fail", problem)
    return Check(row, "pass", f"calibrated on this version, size and scale, on {profile.calibrated.date}")


def font_row(profile: Profile | None, system: System, version: str | None) -> tuple[Font | None, Check]:
    """A font to read this game with, the profile's own or that of a client jar which is near the version; its row."""
    problem: FontError | None = None
    if profile is not None and profile.screen.font is not None:
        path = profile.screen.font_path()
        try:
            return load_font(path), Check("font", "pass", f"the profile's: {path}")
        except FontError as error:
            problem = error
    for jar in client_jars(system, version)[:_JARS_TRIED]:
        try:
            font = load_font(jar)
        except FontError as error:
            problem = problem or error
            continue
        if problem is None:
            return font, Check("font", "pass", f"found, of Minecraft {jar_version(jar)}: {jar}")
        return font, _with_problem(problem, f"; read with that of {jar}")
    if problem is not None:
        return None, _with_problem(problem, "")
    fix = "name your game's client jar: mc-nested calibrate font --font JAR"
    return None, Check("font", "fail", "no client jar in any launcher's folder", fix)


def _with_problem(problem: FontError, instead: str) -> Check:
    row = told("font", "fail", str(problem))
    return Check(row.name, row.status, row.detail + instead, row.fix)
