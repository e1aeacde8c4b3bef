"""The window's checks: found, in front, its size, and how many pixels there are to a point of the desktop."""

from calibration.doctor.check import Check, CheckName, check_from_message
from calibration.doctor.snapshot import WindowSnapshot
from mc_nested.live.devices import SWITCH_KEYS
from mc_nested.live.model.versions import later_version_line
from mc_nested.live.profile.tables import Profile
from mc_nested.live.profile.window_title import version_in

LEAST = (320, 240)
"""The smallest window that the game lays its screens out for (FACTS: The F3 debug screen)."""

ROOMY = 480
"""GUI pixels of width at which a block's longest lines leave the left column free (FACTS: The F3 debug screen)."""

_RATIO_TOLERANCE = 0.01
"""How far the ratio may be from a whole number: a window's edge may be cut by less than a point."""


def window_rows(snapshot: WindowSnapshot, profile: Profile | None) -> list[Check]:
    """The checks of an open window."""
    return [
        window_row(snapshot.window.title),
        front_row(snapshot),
        scaling_row(snapshot),
        size_row(snapshot, profile),
    ]


def window_row(title: str) -> Check:
    """The window's title, and whether its version is known."""
    line = later_version_line(version_in(title) or "")
    return check_from_message(CheckName.WINDOW, "warn", line) if line else Check(CheckName.WINDOW, "pass", repr(title))


def front_row(snapshot: WindowSnapshot) -> Check:
    """Whether the game is in front."""
    if snapshot.is_in_front:
        return Check(CheckName.IN_FRONT, "pass", "keys would reach the game")
    return Check(
        CheckName.IN_FRONT,
        "fail",
        "another window is in front, so nothing was pressed",
        f"switch to the game with {SWITCH_KEYS}, not by a click, and run this again",
    )


def scaling_row(snapshot: WindowSnapshot) -> Check:
    """Pixels to a point, measured on the picture: text that is drawn with a fractional number of them can't be read."""
    row = CheckName.DISPLAY_SCALING
    if snapshot.points is None:
        return Check(row, "skip", "this window's points aren't known")
    across, down = (pixels / points for pixels, points in zip(snapshot.picture_size, snapshot.points, strict=True))
    measured = f"{across:.3g} pixels to a point: {_size(snapshot.picture_size)} for {_size(snapshot.points)}"
    if abs(across - down) > _RATIO_TOLERANCE:
        return Check(
            row,
            "fail",
            f"{measured}, but {down:.3g} downwards",
            "move the whole window onto one screen, run this again",
        )
    if abs(across - round(across)) > _RATIO_TOLERANCE:
        return Check(
            row, "warn", measured, "if text can't be read, set the display's scaling to 100 % or 200 %, start anew"
        )
    return Check(row, "pass", measured)


def size_row(snapshot: WindowSnapshot, profile: Profile | None) -> Check:
    """The window's size, and the GUI scale at which its text is seen."""
    row, size, scales = CheckName.SIZE_AND_SCALE, f"{_size(snapshot.window.window)} pixels", snapshot.window.scales
    if any(seen < least for seen, least in zip(snapshot.window.window, LEAST, strict=True)):
        return Check(row, "fail", size, f"make the window larger than {_size(LEAST)}")
    if scales is None:
        return Check(row, "skip", f"{size}; no text of the game is seen")
    scale, wanted = scales.debug, profile.screen.debug_scale if profile else None
    if wanted is not None and wanted != scale:
        return Check(
            row,
            "fail",
            f"{size}, GUI scale {scales}, and the profile's screen.debug_scale is {wanted}",
            f"set Video Settings > GUI Scale to {wanted}, or take that line out of the profile",
        )
    columns = -(-snapshot.window.window[0] // scale)
    if columns < ROOMY:
        return Check(
            row,
            "warn",
            f"{size}, GUI scale {scales}: only {columns} GUI pixels wide, so a long line about a block can cover the "
            "Facing line",
            f"make the window at least {ROOMY * scale} pixels wide, or set a smaller GUI scale",
        )
    return Check(row, "pass", f"{size}, GUI scale {scales}")


def _size(size: tuple[int, int]) -> str:
    return f"{size[0]} x {size[1]}"
