"""What a profile says, in a few facts, and whether it fits what is known: for a list of profiles."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mc_nested.errors import ProfileError
from mc_nested.live.model.scales import Scales
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.fingerprint import Fingerprint, mismatch
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile

Look = Callable[[str], Fingerprint | None]
"""The open window in whose title that regular expression is found, if there is one."""


@dataclass(frozen=True)
class ProfileFacts:
    """The facts of a profile; a damaged one has no more than a name.

    ``fits`` is None where nothing is known to compare it with; ``why`` says so, or what doesn't fit, or is damaged.
    """

    name: str
    file: Path
    is_damaged: bool = False
    fits: bool | None = None
    why: str = ""
    version: str | None = None
    window: tuple[int, int] | None = None
    scales: Scales | None = None
    arena: Arena | None = None
    date: str | None = None


def facts_of(file: Path, look: Look) -> ProfileFacts:
    """The facts of the profile in a file."""
    try:
        profile = load_profile(file)
    except ProfileError as error:
        return ProfileFacts(file.stem, file, is_damaged=True, why=str(error))
    fits, why = _fit(file.stem, profile, look)
    calibrated = profile.calibrated
    return ProfileFacts(
        file.stem,
        file,
        fits=fits,
        why=why,
        version=(calibrated.version if calibrated else None) or profile.game.version,
        window=calibrated.window if calibrated else None,
        scales=calibrated.scales if calibrated else None,
        arena=profile.arena,
        date=calibrated.date if calibrated else None,
    )


def _fit(name: str, profile: Profile, look: Look) -> tuple[bool | None, str]:
    """Whether it fits, and why not."""
    if profile.screen.font is not None and not profile.screen.font_path().is_file():
        return False, f"its font {profile.screen.font} is gone: mc-nested calibrate font --profile {name} --font JAR"
    if profile.calibrated is None:
        return None, f"it was never calibrated as a whole: mc-nested calibrate all --profile {name}"
    window = look(profile.window.title)
    if window is None:
        return None, "no window of the game is open to compare it with"
    problem = mismatch(profile.calibrated, window, name)
    return problem is None, problem or ""
