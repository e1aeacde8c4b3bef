"""The debug screen's checks: on and readable, not reduced, with position and looked-at lines."""

from collections.abc import Mapping

from calibration.doctor.check import FIX, Check, CheckName, Status, check_from_message
from calibration.doctor.picture_faults import picture_fault
from calibration.doctor.snapshot import ScreenContents, WindowSnapshot
from calibration.installation.options_txt import OptionsTxt
from mc_nested.live.devices import Frame
from mc_nested.live.model.debug_entries import GROUND_PITCH_DEG, LOOK_DOWN, has_entries, have_block_named
from mc_nested.live.profile.window_title import version_in
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.overlay import POSITION, REDUCED

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
    """The checks of what the window shows; ``font`` is the one that it was read with."""
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
    """The check of an options.txt that reduces the debug screen, if no debug screen was seen; else None."""
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
