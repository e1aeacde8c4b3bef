"""What a profile says, in a few facts, and whether it fits what is known: for a list of profiles."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from mc_nested.errors import ProfileError
from mc_nested.live.profile.fingerprint import Fingerprint, mismatch
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile

Look = Callable[[str], Fingerprint | None]
"""The open window in whose title that regular expression is found, if there is one."""


@dataclass(frozen=True)
class ProfileFacts:
    """The facts of a profile, each with its meaning; a damaged one has no more than a name."""

    name: Annotated[str, "its name"]
    file: Annotated[Path, "its file"]
    is_damaged: Annotated[bool, "whether it can't be read"] = False
    fits: Annotated[bool | None, "whether it fits the open window and its font is there"] = None
    why: Annotated[str | None, "what doesn't fit, or is damaged or unknown"] = None
    version: Annotated[str | None, "of Minecraft"] = None
    window: Annotated[tuple[int, int] | None, "width and height in pixels"] = None
    gui_scale: Annotated[int | None, "screen pixels to a dot of the menus' and the chat's font"] = None
    debug_scale: Annotated[int | None, "screen pixels to a dot of the debug screen's font"] = None
    arena_size: Annotated[int | None, "cells along each side"] = None
    date: Annotated[str | None, "day of the calibration"] = None


def facts_of(file: Path, look: Look) -> ProfileFacts:
    """The facts of the profile in a file."""
    try:
        profile = load_profile(file)
    except ProfileError as error:
        return ProfileFacts(file.stem, file, is_damaged=True, why=str(error))
    fits, why = _fit(file.stem, profile, look)
    calibrated = profile.calibrated
    scales = calibrated.scales if calibrated else None
    return ProfileFacts(
        file.stem,
        file,
        fits=fits,
        why=why,
        version=(calibrated.version if calibrated else None) or profile.game.version,
        window=calibrated.window if calibrated else None,
        gui_scale=scales.gui if scales else None,
        debug_scale=scales.debug if scales else None,
        arena_size=profile.arena.size if profile.arena else None,
        date=calibrated.date if calibrated else None,
    )


def _fit(name: str, profile: Profile, look: Look) -> tuple[bool | None, str | None]:
    """Whether it fits, and why not."""
    if profile.screen.font is not None and not profile.screen.font_path().is_file():
        return False, f"its font {profile.screen.font} is gone: mc-nested calibrate font --profile {name} --font JAR"
    if profile.calibrated is None:
        return None, f"it was never calibrated as a whole: mc-nested calibrate all --profile {name}"
    window = look(profile.window.title)
    if window is None:
        return None, "no window of the game is open to compare it with"
    problem = mismatch(profile.calibrated, window, name)
    return problem is None, problem
