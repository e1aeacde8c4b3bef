"""The block looked at from 26.4 on: a box of its own, in either column (FACTS: The F3 debug screen).

Its title is ``Looking At Block``, its first facts are ``Coordinates`` and ``Type``; a fluid's and an entity's box have
the same, under titles of their own. Where nothing is looked at there is no box.
"""

import re

from mc_nested.live.model.reading import XYZ, Target
from mc_nested.live.vision.screen_lines import (
    CLEAR,
    WHOLE,
    DebugLines,
    Unreadable,
    check_whole,
    cut_to,
    not_a_form,
    only_line,
    shown,
)
from mc_nested.live.vision.text_lines import UNKNOWN, Line

TITLE = "Looking At Block"
_OTHER_TITLES = ("Looking At Fluid", "Looking At Entity")

_PARTS = ("Looking At B", "king At Bl", "ng At Block")
"""Parts of the title, either half of which may be covered."""

_PLACE, _KIND = "Coordinates:", "Type:"

_BESIDE = rf"(?:[ {UNKNOWN}].*)?"
_COORDINATES = re.compile(rf"(Coordinates: {WHOLE}, {WHOLE}, {WHOLE}){_BESIDE}")
_TYPE = re.compile(rf"(Type: ([a-z0-9_.-]+:[a-z0-9_./-]+)){_BESIDE}")

_NAMES = 60
"""Dots between the beginnings of the two names, which end in one column, are fewer: the other column is farther off."""

_RANGE = 23
"""Blocks from the player's feet within which the block is: 20 from the eyes, and a part of itself."""

_LEAST = 6
"""A number of so much or more that lost its last digit is out of that range."""


def target_in_box(lines: DebugLines, player: XYZ) -> Target | None:
    """The block that a player at ``player`` looks at, or None. Raises Unreadable where that isn't sure."""
    title = only_line(lines, TITLE)
    if title is None:
        _check_nothing_hidden(lines)
        return None
    cut_to(lines, title, TITLE)
    place = _below(lines, title, _PLACE, title.row + lines.layout.pitch, title.start)
    kind = _below(lines, title, _KIND, place.row + lines.layout.pitch, place.start)
    form, named = _COORDINATES.fullmatch(place.text), _TYPE.fullmatch(kind.text)
    if form is None or named is None:
        raise not_a_form(kind if form else place)
    x, y, z = (int(part) for part in form.groups()[1:])
    if any(abs(part - own) > _RANGE for part, own in zip((x, y, z), player, strict=True)):
        raise Unreadable(f"no block at {x}, {y}, {z} can be looked at from where the player is: look again, or {CLEAR}")
    whole = cut_to(lines, place, form[1])
    if abs(z) < _LEAST:
        check_whole(whole)
    check_whole(cut_to(lines, kind, named[1]))
    return Target((x, y, z), named[2])


def _below(lines: DebugLines, title: Line, label: str, row: int, start: int) -> Line:
    """The fact of a name in this row, of the box whose title that is."""
    found = [line for line in lines.starting(label) if line.row == row and abs(line.start - start) <= _NAMES]
    if len(found) != 1:
        raise Unreadable(
            f"below {title.text!r} no {label.strip(':')} can be seen: switch minecraft:looking_at_block_state on "
            f"(F3+F6), or {CLEAR}"
        )
    return found[0]


def _check_nothing_hidden(lines: DebugLines) -> None:
    for part in _PARTS:
        if lines.holds(part):
            raise Unreadable(f"of the block looked at only {part.strip()!r} can be seen: {CLEAR}")
    titles = {line.row for title in _OTHER_TITLES for line in lines.starting(title) if line.text == title}
    for line in lines.starting(_PLACE):
        if line.row - lines.layout.pitch not in titles:
            raise Unreadable(f"what {shown(line.text)} belongs to can't be seen: {CLEAR}")
    if lines.may_be_covered():
        raise Unreadable(
            "both columns of the debug screen are full, so the block looked at may have no room: switch some of its "
            "lines off (F3+F6), or set a smaller debug scale (debugGuiScale)"
        )
