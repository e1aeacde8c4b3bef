"""The window's rows: found, in front, how large, and how many pixels its pictures have to a point of the desktop."""

from calibration.doctor.check import Check
from calibration.doctor.look import Look
from mc_nested.live.profile import Profile

LEAST = (320, 240)
"""The smallest window that the game lays its screens out for (FACTS: The F3 debug screen)."""

_WHOLE = 0.01
"""How far pixels to a point may be off a whole number: a window's edge may be cut by less than a point."""


def window_rows(look: Look, profile: Profile | None) -> list[Check]:
    """The rows of a window that is there."""
    return [
        Check("game's window", "pass", repr(look.seen.title)),
        front_row(look),
        scaling_row(look),
        size_row(look, profile),
    ]


def front_row(look: Look) -> Check:
    """Whether the game is in front."""
    if look.is_in_front:
        return Check("in front", "pass", "keys would reach the game")
    return Check(
        "in front", "fail", "another window is in front, so nothing was pressed", "click on the game, run this again"
    )


def scaling_row(look: Look) -> Check:
    """Pixels to a point, as measured on the picture: text that is drawn to another number of pixels can't be read."""
    row = "display scaling"
    if look.points is None:
        return Check(row, "skip", "this window's points aren't known")
    across, down = (pixels / points for pixels, points in zip(look.pictured, look.points, strict=True))
    measured = f"{across:.3g} pixels to a point: {_size(look.pictured)} for {_size(look.points)}"
    if abs(across - down) > _WHOLE:
        return Check(
            row,
            "fail",
            f"{measured}, but {down:.3g} downwards",
            "move the whole window onto one screen, run this again",
        )
    if abs(across - round(across)) > _WHOLE:
        return Check(
            row, "warn", measured, "if text can't be read, set the display's scaling to 100 % or 200 %, start anew"
        )
    return Check(row, "pass", measured)


def size_row(look: Look, profile: Profile | None) -> Check:
    """The window's size, and the GUI scale at which its text is seen."""
    row, size, scale = "size and GUI scale", f"{_size(look.seen.window)} pixels", look.seen.gui_scale
    if any(seen < least for seen, least in zip(look.seen.window, LEAST, strict=True)):
        return Check(row, "fail", size, f"make the window larger than {_size(LEAST)}")
    if scale is None:
        return Check(row, "skip", f"{size}; no text of the game is seen")
    wanted = profile.screen.gui_scale if profile else None
    if wanted is not None and wanted != scale:
        return Check(
            row,
            "fail",
            f"{size}, GUI scale {scale}, and the profile's screen.gui_scale is {wanted}",
            f"set Video Settings > GUI Scale to {wanted}, or take that line out of the profile",
        )
    return Check(row, "pass", f"{size}, GUI scale {scale}")


def _size(size: tuple[int, int]) -> str:
    return f"{size[0]} x {size[1]}"
