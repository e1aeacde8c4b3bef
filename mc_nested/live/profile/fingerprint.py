"""Check that a profile still fits the game: version, window size and GUI scale are those it was calibrated on."""

from dataclasses import dataclass

from mc_nested.errors import DesktopError, ProfileError
from mc_nested.live.model.versions import may_be_shared, state_in, version_in
from mc_nested.live.profile.tables import CalibratedTable, GameVersion
from mc_nested.live.vision.layout import Scales, largest_gui_scale


@dataclass(frozen=True)
class Fingerprint:
    """The game's window: its title, its width and height in framebuffer pixels, and its scales if they are known."""

    title: str
    window: tuple[int, int]
    scales: Scales | None = None


def game_in(title: str, otherwise: GameVersion) -> GameVersion:
    """Return the version in the title of the game's window, or ``otherwise`` where there is none."""
    version = version_in(title)
    return GameVersion(version=version) if version else otherwise


def mismatch(calibrated: CalibratedTable, current: Fingerprint, profile: str) -> str | None:
    """Return why a profile of that name no longer fits, with the step to repeat; None if it fits.

    A value that is unknown on either side is not compared.
    """
    again = f"mc-nested calibrate all --profile {profile}"
    version = version_in(current.title)
    if calibrated.version and version and calibrated.version != version:
        return (
            f"profile {profile} was calibrated on Minecraft {calibrated.version}, and this is {version}: "
            f"start that version, or run {again}"
        )
    if calibrated.window and calibrated.window != current.window:
        return (
            f"profile {profile} was calibrated in a window of {size_text(calibrated.window)} pixels, and this one has "
            f"{size_text(current.window)}: make it that size again, or run {again}"
        )
    scales = calibrated.scales
    if scales is None:
        return None
    largest = largest_gui_scale(current.window) + 1  # one more with Unicode letters
    if scales.gui > largest or scales.debug > scales.gui:
        return (
            f"profile {profile} names GUI scale {scales}, which no window of {size_text(current.window)} pixels can "
            f"have: run {again}"
        )
    if current.scales and scales != current.scales:
        return (
            f"profile {profile} was calibrated at GUI scale {scales}, and this is {current.scales}: "
            f"set Video Settings > GUI Scale to {_as_set(scales)}, or run {again}"
        )
    return None


def _as_set(scales: Scales) -> str:
    own = "" if scales.gui == scales.debug else f", and the one on the F3+F6 screen to {scales.debug}"
    return f"{scales.gui}{own}"


def check_fit(calibrated: CalibratedTable | None, current: Fingerprint, profile: str) -> None:
    """Raise ProfileError, with the step to repeat, if a profile no longer fits. One never calibrated always fits."""
    if calibrated is not None and (problem := mismatch(calibrated, current, profile)):
        raise ProfileError(problem)


def check_single_player(title: str, *, is_server_allowed: bool) -> None:
    """Raise DesktopError if the window's title doesn't say that nobody else plays there, unless that is allowed.

    A title without a state is let pass: menus have none, nor has any version to 1.14.
    """
    if is_server_allowed or not may_be_shared(title):
        return
    state = state_in(title)
    if state is None or "Multiplayer" in state:
        raise DesktopError(
            f"the window's title is {title!r}, so others may be playing there: open a world of your own, or allow "
            "it with --server-allowed"
        )
    raise DesktopError(
        f"the window's title is {title!r}, and whether {state!r} is a world of your own isn't known: set the game's "
        "language to English (US), or, if nobody else plays there, allow it with --server-allowed"
    )


def size_text(size: tuple[int, int]) -> str:
    """Return a width and a height in words."""
    return f"{size[0]} x {size[1]}"
