"""The debug screen's rows: on and read, not reduced, and the position and looked-at lines there."""

import re
from collections.abc import Mapping

from calibration.doctor.check import Check, told
from calibration.doctor.look import Look, Shown
from calibration.doctor.options_rows import FIX
from calibration.game.options_txt import OptionsTxt
from mc_nested.live.fingerprint import version_in
from mc_nested.live.overlay import POSITION, REDUCED

ROWS = ("debug screen", "reduced debug info", "position line", "looked-at line")

OPENED = {
    "pause": ("the Game Menu is open", "click Back to Game"),
    "death": ("the player has died", "click Respawn"),
    "disconnected": ("the game was disconnected", "open the world again"),
    "title": ("the title screen is there", "open the world"),
    "worlds": ("the list of worlds is there", "open the world"),
    "chat": ("the chat is open", "press Esc"),
}
"""Each screen that may be there in the place of the world: what that is, and what to do."""

LOOKED_DOWN = 30.0
"""Degrees: who looks farther down than that looks at the ground they stand on, some 3 blocks away at most."""

SWITCH_ON = "press F3+F6 in the game, and set 'looking at block' to Always"
REDUCED_OFF = (
    "Options > Chat Settings > Reduced Debug Info: OFF, and the gamerule reducedDebugInfo (1.21.11+: "
    "reduced_debug_info) to false"
)


def screen_rows(look: Look) -> list[Check]:
    """The rows of what the window shows."""
    shown = look.shown
    if shown is None:
        reason = "no font to read it with" if look.is_in_front else "another window is in front"
        return [Check(name, "skip", reason) for name in ROWS]
    if shown.line is None:
        return [_absent(shown), *(Check(name, "skip", "the debug screen isn't seen") for name in ROWS[1:])]
    return [_debug_screen(shown), _reduced(shown), _position(shown), _looked_at(shown, version_in(look.seen.title))]


def reduced_by_options(options: OptionsTxt, known: Mapping[str, Check]) -> Check | None:
    """The row of an options.txt that reduces the debug screen, where no debug screen has said more; else None."""
    row = known.get("reduced debug info")
    if (row is None or row.status == "skip") and options.values.get("reducedDebugInfo") == "true":
        return Check("reduced debug info", "fail", "options.txt has it on", f"{REDUCED_OFF}; or {FIX}")
    return None


def _absent(shown: Shown) -> Check:
    if shown.screen in OPENED:
        return Check("debug screen", "fail", *OPENED[shown.screen])
    return told("debug screen", "fail", shown.reading.problem or "")


def _debug_screen(shown: Shown) -> Check:
    if shown.screen == "chat":
        return Check("debug screen", "fail", *OPENED["chat"])
    problem = shown.reading.problem
    if problem is None or shown.line != POSITION:
        return Check("debug screen", "pass", f"on, at GUI scale {shown.scale}")
    what, _, remedy = problem.rpartition(": ")
    return Check("debug screen", "fail", what, remedy)


def _reduced(shown: Shown) -> Check:
    if shown.line == REDUCED:
        return Check("reduced debug info", "fail", "the debug screen leaves out place, facing and block", REDUCED_OFF)
    if shown.line == POSITION:
        return Check("reduced debug info", "pass", "off")
    return Check("reduced debug info", "skip", "only a part of the debug screen is seen")


def _position(shown: Shown) -> Check:
    if shown.reading.xyz is not None:
        return Check("position line", "pass", "XYZ: " + " / ".join(f"{part:.3f}" for part in shown.reading.xyz))
    if shown.line == POSITION:
        return Check("position line", "pass", "XYZ is there, but see the debug screen's row")
    if shown.line == REDUCED:
        return Check("position line", "fail", "left out, the debug screen being reduced", REDUCED_OFF)
    return told("position line", "fail", shown.reading.problem or "")


def _looked_at(shown: Shown, version: str | None) -> Check:
    row, reading = "looked-at line", shown.reading
    if reading.target is not None:
        place = " ".join(str(part) for part in reading.target.pos or ())
        return Check(row, "pass", f"{reading.target.id} at {place}")
    if reading.pitch is None:
        return Check(row, "skip", "the debug screen isn't read")
    fix = SWITCH_ON if version is None or _is_switched(version) else "stand on solid ground, out of the water"
    if reading.pitch >= LOOKED_DOWN:
        return Check(row, "fail", f"missing, with the ground in view ({reading.pitch:.0f} degrees down)", fix)
    return Check(row, "skip", "no block is looked at", "look down at the ground, and run this again")


def _is_switched(version: str) -> bool:
    """Whether the version shows the line only if told to (FACTS: The F3 debug screen)."""
    return tuple(int(part) for part in re.findall(r"\d+", version)) >= (1, 21, 9)
