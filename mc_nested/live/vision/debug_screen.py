"""The F3 debug screen: from a frame to a Reading, or to the reason why there is none. Never a guess.

Each line is found by how it begins, in either column, decoded glyph by glyph, and then has to match its whole form in
one of the versions (FACTS: The F3 debug screen). What doesn't match is a problem, not a number.
"""

import re

from mc_nested.live.devices import Frame
from mc_nested.live.model.reading import Reading
from mc_nested.live.vision.font import Font
from mc_nested.live.vision.layout import Overlay
from mc_nested.live.vision.overlay import POSITION, REDUCED, SCALES, SECTIONS, FoundScreen, find_debug_screen
from mc_nested.live.vision.screen_lines import CLEAR, WHOLE, DebugLines, ScreenLines, Unreadable, matched, only_line
from mc_nested.live.vision.target_block import target_block, target_in_box
from mc_nested.live.vision.text_lines import UNKNOWN

# What follows the third decimal or the last bracket is the world beside the box: the forms are complete without it.
_XYZ = re.compile(
    rf"XYZ: {WHOLE}[.,](\d{{3}}) / {WHOLE}[.,](\d{{5}}|\d{{3}}) / {WHOLE}[.,](\d{{3}})(?:[ {UNKNOWN}].*)?"
)
_DEGREES = r"(-?\d{1,3}[.,]\d)"
_TOWARDS = r"(?:north|south|east|west) \([Tt]owards (?:positive|negative) [XZ]\)"
_FACINGS = {
    "Facing: ": re.compile(rf"Facing: {_TOWARDS} \({_DEGREES} / {_DEGREES}[){UNKNOWN}].*"),
    "Facing (minecraft): ": re.compile(rf"Facing \(minecraft\): {_TOWARDS} \({_DEGREES} {_DEGREES}\).*"),
}


def read_debug_screen(frame: Frame, font: Font, overlay: Overlay | None = None) -> Reading:
    """Return what the debug screen of a frame (height, width, 3), blue green red, says.

    Without ``overlay`` it is found first.

    A reading with a problem holds nothing else: a position isn't given while the block looked at can't be read.
    """
    found = find_debug_screen(frame, font, overlay)
    return read_found(found, font) if found else nothing_seen(overlay)


def read_found(found: FoundScreen, font: Font) -> Reading:
    """Return what a debug screen says that has been found."""
    return read_lines(ScreenLines(found.dots, font, found.overlay), found.label)


def read_lines(lines: DebugLines, known_by: str = POSITION) -> Reading:
    """Return what the lines of a debug screen say, one of which begins with ``known_by``."""
    try:
        if known_by != POSITION:
            raise Unreadable(_without_position(known_by))
        position, facing = _position(lines), _facing(lines)
        target = target_in_box(lines, position) if lines.layout.has_facts else target_block(lines)
        return Reading(position, *facing, target)
    except Unreadable as reason:
        return Reading(problem=str(reason))


def read_position(lines: DebugLines) -> tuple[float, float, float] | None:
    """Return what the position line says; None where that can't be read."""
    try:
        return _position(lines)
    except Unreadable:
        return None


def _position(lines: DebugLines) -> tuple[float, float, float]:
    parts = matched(_XYZ, only_line(lines, POSITION))
    x, y, z = (float(f"{whole}.{decimals}") for whole, decimals in zip(parts[::2], parts[1::2], strict=True))
    return x, y, z


def _facing(lines: DebugLines) -> tuple[float, float]:
    for label, form in _FACINGS.items():
        if line := only_line(lines, label):
            yaw, pitch = (float(text.replace(",", ".")) for text in matched(form, line))
            if abs(yaw) > 180 or abs(pitch) > 90:
                raise Unreadable(f"a yaw of {yaw} with a pitch of {pitch} can't be: {CLEAR}")
            return yaw, pitch
    raise Unreadable(f"the debug screen shows no Facing line, or it is covered: {CLEAR}")


def _without_position(known_by: str) -> str:
    if known_by == REDUCED or known_by in SECTIONS:
        return (
            "the debug screen is reduced and shows no XYZ: set Reduced Debug Info off in the game's options, "
            "and the gamerule reducedDebugInfo (from 1.21.11 on reduced_debug_info) to false"
            + ("" if known_by == REDUCED else "; if both are, switch minecraft:player_position on (F3+F6)")
        )
    return f"no XYZ line is to be seen: press F3 if it is off (from 1.21.9 on, F3+F6 adds the line), else {CLEAR}"


def nothing_seen(overlay: Overlay | None) -> Reading:
    """Return the reading of a frame without a debug screen that is drawn that way."""
    some = f"{min(SCALES)} to {max(SCALES)}"
    scale, mend = (
        (f"GUI scale {overlay.scale}", f"set it to GUI scale {overlay.scale} or correct the profile's debug_scale")
        if overlay
        else (f"a GUI scale from {some}", f"set GUI Scale to {some}")
    )
    return Reading(
        problem=f"no debug screen is to be seen at {scale}: press F3 in the game, and Esc if a menu is open; if it is "
        f"on, {mend}, turn Force Unicode Font off, and give the font of the "
        "game's own jar, or of the resource pack in use; a pack with finer letters than the game's has to be taken off"
    )
