"""The checks of the window and of the debug screen in it.

Of the window: found, in front, its size, and how many pixels there are to a point of the desktop. Of the debug screen:
on and readable, not reduced, with position and looked-at lines. A picture in which nothing of the game can be read may
be black, or have colours that aren't the game's. How such pictures look is known from reports alone
(FACTS: Input and windows).
"""

from collections.abc import Mapping

import numpy as np

from calibration.doctor.check import FIX, Check, CheckName, Status, check_from_message
from calibration.doctor.snapshot import ScreenContents, WindowSnapshot
from calibration.installation.options_txt import OptionsTxt
from mc_nested.live.devices import SWITCH_KEYS, Frame
from mc_nested.live.model.debug_entries import GROUND_PITCH_DEG, LOOK_DOWN, has_entries, have_block_named
from mc_nested.live.model.versions import later_version_line, version_in
from mc_nested.live.profile.fingerprint import size_text
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.layout import PLAIN
from mc_nested.live.vision.overlay import POSITION, REDUCED, find_debug_screen

BLACK = 8
"""Levels, of 255, up to which a picture counts as black."""

LEVELS = (170, 140, 110, 80, 230)
"""Brightnesses at which text that the game draws at 221 or more is looked for: the ground behind it is darker."""

NOT_PICTURED = (
    "the window's picture is black: play in a window (F11), not in exclusive fullscreen; unlock the session, and keep "
    "a remote one in view"
)

FAINT = "text of the game's is seen, but too faint to be read"
BRIGHT = "text of the game's is seen, but on too bright a ground to be read"

WASHED_OUT = "switch HDR, a night light and colour filters off for this screen: they change what is pictured"


def picture_fault(frame: Frame, font: Font) -> str | None:
    """Return what is wrong with an unreadable frame (height, width, 3), a colon, and what to do; None if unknown."""
    if int(frame.max(initial=0)) <= BLACK:
        return NOT_PICTURED
    for level in LEVELS:
        lifted = np.where(frame >= level, np.uint8(PLAIN[0]), np.uint8(0))
        if find_debug_screen(lifted, font) is not None:
            return f"{FAINT if level < PLAIN[0] else BRIGHT}: {WASHED_OUT}"
    return None


SCREEN_CHECKS = (
    CheckName.DEBUG_SCREEN,
    CheckName.REDUCED_DEBUG_INFO,
    CheckName.POSITION_LINE,
    CheckName.TARGET_LINE,
)

OTHER_SCREENS = {
    "pause": ("the Game Menu is open", "click Back to Game"),
    "death": ("the player has died", "click Respawn"),
    "disconnected": ("the game was disconnected", "open the world again"),
    "title": ("the title screen is there", "open the world"),
    "worlds": ("the list of worlds is there", "open the world"),
    "servers": ("the list of servers is there", "press Esc, and open the world"),
    "chat": ("the chat is open", "press Esc"),
}
"""Each screen that may be there instead of the world: what it is, and what to do."""

REDUCED_OFF = (
    "Options > Chat Settings > Reduced Debug Info: OFF, and the gamerule reducedDebugInfo (1.21.11+: "
    "reduced_debug_info) to false"
)


def screen_rows(snapshot: WindowSnapshot, font: Font | None) -> list[Check]:
    """Return the checks of what the window shows; ``font`` is the one that it was read with."""
    contents = snapshot.contents
    if contents is None:
        reason = "no font to read it with" if snapshot.is_in_front else "another window is in front"
        return [Check(name, "skip", reason) for name in SCREEN_CHECKS]
    if contents.line is None:
        return [
            _absent(contents, snapshot.picture, font),
            *(Check(name, "skip", "the debug screen isn't seen") for name in SCREEN_CHECKS[1:]),
        ]
    return [
        _debug_screen(contents),
        _reduced_debug_info(contents),
        _position_line(contents),
        _target_line(contents, version_in(snapshot.window.title)),
    ]


def reduced_by_options(options: OptionsTxt, known: Mapping[CheckName, Check]) -> Check | None:
    """Return the check of an options.txt that reduces the debug screen, if no debug screen was seen; else None."""
    row = known.get(CheckName.REDUCED_DEBUG_INFO)
    if (row is None or row.status == "skip") and options.values.get("reducedDebugInfo") == "true":
        return Check(CheckName.REDUCED_DEBUG_INFO, "fail", "options.txt has it on", f"{REDUCED_OFF}; or {FIX}")
    return None


def _absent(contents: ScreenContents, picture: Frame | None, font: Font | None) -> Check:
    if contents.screen in OTHER_SCREENS:
        return Check(CheckName.DEBUG_SCREEN, "fail", *OTHER_SCREENS[contents.screen])
    fault = picture_fault(picture, font) if picture is not None and font is not None else None
    return check_from_message(CheckName.DEBUG_SCREEN, "fail", fault or contents.reading.problem or "")


def _debug_screen(contents: ScreenContents) -> Check:
    if contents.screen == "chat":
        return Check(CheckName.DEBUG_SCREEN, "fail", *OTHER_SCREENS["chat"])
    problem = contents.reading.problem
    if problem is None or contents.line != POSITION:
        return Check(CheckName.DEBUG_SCREEN, "pass", f"on, at GUI scale {contents.scales}")
    what, _, remedy = problem.rpartition(": ")
    return Check(CheckName.DEBUG_SCREEN, "fail", what, remedy)


def _reduced_debug_info(contents: ScreenContents) -> Check:
    if contents.line == REDUCED:
        return Check(
            CheckName.REDUCED_DEBUG_INFO, "fail", "the debug screen leaves out place, facing and block", REDUCED_OFF
        )
    if contents.line == POSITION:
        return Check(CheckName.REDUCED_DEBUG_INFO, "pass", "off")
    return Check(CheckName.REDUCED_DEBUG_INFO, "skip", "only a part of the debug screen is seen")


def _position_line(contents: ScreenContents) -> Check:
    if contents.reading.xyz is not None:
        return Check(
            CheckName.POSITION_LINE, "pass", "XYZ: " + " / ".join(f"{part:.3f}" for part in contents.reading.xyz)
        )
    if contents.line == POSITION:
        return Check(CheckName.POSITION_LINE, "pass", "XYZ is there, but see the debug screen's row")
    if contents.line == REDUCED:
        return Check(CheckName.POSITION_LINE, "fail", "left out, the debug screen being reduced", REDUCED_OFF)
    return check_from_message(CheckName.POSITION_LINE, "fail", contents.reading.problem or "")


def _target_line(contents: ScreenContents, version: str | None) -> Check:
    row, reading = CheckName.TARGET_LINE, contents.reading
    if reading.target is not None:
        xyz = " ".join(str(part) for part in reading.target.pos or ())
        return Check(row, "pass", f"{reading.target.id} at {xyz}")
    if reading.pitch is None:
        return Check(row, "skip", "the debug screen isn't read")
    if reading.pitch >= GROUND_PITCH_DEG:
        return Check(
            row,
            "fail",
            f"missing, with the ground in view ({reading.pitch:.0f} degrees down)",
            have_block_named(version),
        )
    # From 1.21.9 on the line may be off: a calibration begins only where it was seen.
    status: Status = "fail" if version is not None and has_entries(version) else "skip"
    return Check(row, status, "no block is looked at", LOOK_DOWN)


LEAST = (320, 240)
"""The smallest window that the game lays its screens out for (FACTS: The F3 debug screen)."""

ROOMY = 480
"""GUI pixels of width at which a block's longest lines leave the left column free (FACTS: The F3 debug screen)."""

_RATIO_TOLERANCE = 0.01
"""How far the ratio may be from a whole number: a window's edge may be cut by less than a point."""


def window_rows(snapshot: WindowSnapshot, profile: Profile | None) -> list[Check]:
    """Return the checks of an open window."""
    return [
        window_row(snapshot.window.title),
        front_row(snapshot),
        scaling_row(snapshot),
        size_row(snapshot, profile),
    ]


def window_row(title: str) -> Check:
    """Check the window's title, and whether its version is known."""
    line = later_version_line(version_in(title) or "")
    return check_from_message(CheckName.WINDOW, "warn", line) if line else Check(CheckName.WINDOW, "pass", repr(title))


def front_row(snapshot: WindowSnapshot) -> Check:
    """Check whether the game is in front."""
    if snapshot.is_in_front:
        return Check(CheckName.IN_FRONT, "pass", "keys would reach the game")
    return Check(
        CheckName.IN_FRONT,
        "fail",
        "another window is in front, so nothing was pressed",
        f"switch to the game with {SWITCH_KEYS}, not by a click, and run this again",
    )


def scaling_row(snapshot: WindowSnapshot) -> Check:
    """Check the pixels to a point, as the picture shows them: text at a fractional number of them can't be read."""
    row = CheckName.DISPLAY_SCALING
    if snapshot.points is None:
        return Check(row, "skip", "this window's points aren't known")
    across, down = (pixels / points for pixels, points in zip(snapshot.picture_size, snapshot.points, strict=True))
    measured = f"{across:.3g} pixels to a point: {size_text(snapshot.picture_size)} for {size_text(snapshot.points)}"
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
    """Check the window's size, and the GUI scale at which its text is seen."""
    row, size, scales = CheckName.SIZE_AND_SCALE, f"{size_text(snapshot.window.window)} pixels", snapshot.window.scales
    if any(seen < least for seen, least in zip(snapshot.window.window, LEAST, strict=True)):
        return Check(row, "fail", size, f"make the window larger than {size_text(LEAST)}")
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
