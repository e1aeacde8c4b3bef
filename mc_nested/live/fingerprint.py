"""Whether a profile still fits the screen: the version, the window and the GUI scale that it was calibrated on."""

import re
from dataclasses import dataclass

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live.profile_tables import Calibrated, GameVersion

_TITLE = re.compile(r"Minecraft\*? (\d+\.\d+(?:\.\d+)?)(?:[ -].*)?")
"""The title of the game's window, a star standing for a modified one (FACTS: Input and windows)."""


@dataclass(frozen=True)
class Seen:
    """What is seen of the game: its window's title, its width and height in framebuffer pixels, and the GUI scale.

    ``gui_scale`` is None where it isn't known yet.
    """

    title: str
    window: tuple[int, int]
    gui_scale: int | None = None


def version_in(title: str) -> str | None:
    """The version that the title of the game's window says; None where it says none, as that of a modpack."""
    found = _TITLE.fullmatch(title)
    return found[1] if found else None


def game_in(title: str, otherwise: GameVersion) -> GameVersion:
    """The version that the title of the game's window says, or that one where it says none."""
    version = version_in(title)
    return GameVersion(version=version) if version else otherwise


def misfit(calibrated: Calibrated, seen: Seen, profile: str) -> str | None:
    """Why a profile of that name no longer fits, with the step to repeat; None where it does.

    What either side doesn't know is not compared.
    """
    again = f"mc-nested calibrate all --profile {profile}"
    version = version_in(seen.title)
    if calibrated.version and version and calibrated.version != version:
        return (
            f"profile {profile} was calibrated on Minecraft {calibrated.version}, and this is {version}: "
            f"start that version, or run {again}"
        )
    if calibrated.window and calibrated.window != seen.window:
        return (
            f"profile {profile} was calibrated in a window of {_size(calibrated.window)} pixels, and this one has "
            f"{_size(seen.window)}: make it that size again, or run {again}"
        )
    if calibrated.gui_scale and seen.gui_scale and calibrated.gui_scale != seen.gui_scale:
        return (
            f"profile {profile} was calibrated at GUI scale {calibrated.gui_scale}, and this is {seen.gui_scale}: "
            f"set Video Settings > GUI Scale to {calibrated.gui_scale}, or run {again}"
        )
    return None


def check_fit(calibrated: Calibrated | None, seen: Seen, profile: str) -> None:
    """ProfileError, with the step to repeat, where a profile no longer fits; one never calibrated fits anything."""
    if calibrated is not None and (problem := misfit(calibrated, seen, profile)):
        raise ProfileError(problem)


def check_single_player(title: str, *, is_server_allowed: bool) -> None:
    """DesktopError where the title of the game's window says that others may play there, unless that is allowed."""
    if "Multiplayer" in title and not is_server_allowed:
        raise DesktopError(
            f"the window's title is {title!r}, so others may be playing there: open a world of your own, or allow "
            "it with --server-allowed"
        )


def _size(size: tuple[int, int]) -> str:
    return f"{size[0]} x {size[1]}"
