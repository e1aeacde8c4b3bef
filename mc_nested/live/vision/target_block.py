"""The block looked at, as each version's debug screen shows it (FACTS: The F3 debug screen).

| version   | position                                        | id                                            |
| 1.8-1.12  | left, ``Looking at: x y z``                     | right, a line of its own                      |
| 1.13-1.15 | left, ``Looking at block: x y z``               | right, the line below ``Targeted Block``      |
| 1.16 on   | either side, ``Targeted Block: x, y, z``        | the line below                                |
| 26.4 on   | either side, ``Coordinates: x, y, z`` in a box  | the line below, ``Type: id``                  |
| stand-in  | right, ``Looking at: x y z``                    | right, without namespace, over its properties |

Fluids and entities have labels of their own, ``Targeted Fluid``, ``Looking at liquid`` and ``Targeted Entity``.
"No block is looked at" is the answer only where the right column is seen, with no part of a block's lines in it, nor a
fluid's, which would stand below a block's. To 1.21.8 that column begins with the same lines in every game.

The box's title is ``Looking At Block``; a fluid's and an entity's box have the same facts, under titles of their own.
Where nothing is looked at there is no box.
"""

import re

from mc_nested.live.model.reading import XYZ, Block, Target
from mc_nested.live.vision.overlay import TITLE, version_in
from mc_nested.live.vision.screen_lines import (
    CLEAR,
    WHOLE,
    DebugLines,
    Unreadable,
    check_nothing_over,
    check_whole,
    cut_to,
    matched,
    not_a_form,
    only_line,
    shown,
)
from mc_nested.live.vision.text_lines import UNKNOWN, Line

_BESIDE = rf"(?:[ {UNKNOWN}].*)?"
"""What is read behind a line's end where the world beside its box has the text's colour."""

_TARGETED_AT = re.compile(rf"(Targeted Block: {WHOLE}, {WHOLE}, {WHOLE}){_BESIDE}")
_LOOKING_AT = re.compile(rf"(Looking at(?: block)?: {WHOLE} {WHOLE} {WHOLE}){_BESIDE}")
_NAMESPACED = re.compile(r"([a-z0-9_.-]+):[a-z0-9_./-]+")
_ID = re.compile(rf"(([a-z0-9_.-]+):[a-z0-9_./-]+){_BESIDE}")
_ALONE = re.compile(rf"(?:.*{UNKNOWN})?minecraft:(?!overworld|the_)[a-z0-9_./-]+")
_OTHER_LABEL = re.compile(r"Targeted (?:Fluid|Entity)")

_FREE_ORDER = (1, 21, 9)
"""The first version whose lines can be chosen, and stand in either column."""

_ALWAYS = ("Java: ", "Mem: ", "CPU: ", "Display: ")
"""The right column's own lines before that, above those of the block."""

_FLUIDS = ("Targeted Fluid", "Looking at liquid")

_PARTS = ("Targeted B", "ted Block", "Looking at b", "king at block", "ooking at:", "ing at: ")
"""Parts of the labels, either half of which may be covered."""


def target_block(lines: DebugLines) -> Target | None:
    """Return the block looked at, or None. Raise Unreadable if its lines are there, but not to be read for sure."""
    if targeted := only_line(lines, "Targeted Block"):
        return _targeted(lines, targeted)
    looking = only_line(lines, "Looking at block: ") or only_line(lines, "Looking at: ")
    if looking is None:
        _check_nothing_hidden(lines)
        return None
    position = _position(lines, _LOOKING_AT, looking)
    if looking.text.startswith("Looking at block"):
        raise Unreadable(f"the 'Targeted Block' lines of the block looked at can't be seen: {CLEAR}")
    # In the right column only the stand-in writes it.
    return Target(position, _id_in_right_column(lines) if looking.is_left else _id_above(lines, looking))


def _targeted(lines: DebugLines, targeted: Line) -> Target:
    if targeted.text != "Targeted Block":
        return Target(_position(lines, _TARGETED_AT, targeted), _id_below(lines, targeted))
    looking = only_line(lines, "Looking at block: ")
    if looking is None:
        raise Unreadable(f"the place of the block looked at can't be seen: {CLEAR}")
    return Target(_position(lines, _LOOKING_AT, looking), _id_below(lines, targeted))


def _position(lines: DebugLines, form: re.Pattern[str], line: Line) -> Block:
    text, x, y, z = matched(form, line)
    whole = cut_to(lines, line, text)
    check_whole(whole)
    check_nothing_over(lines, whole)
    return int(x), int(y), int(z)


def _id_below(lines: DebugLines, label: Line) -> str:
    """Read the id from 1.13 on: it stands one line below its label, aligned with it on the column's side."""
    row = label.row + lines.layout.pitch
    line = lines.at(row, label.start) if label.is_left else lines.ending(row, label.end)
    if line is None:
        raise Unreadable(f"the id below 'Targeted Block' can't be seen: {CLEAR}")
    return _id_of(lines, line)


def _id_in_right_column(lines: DebugLines) -> str:
    """Read the id of 1.8 to 1.12: it has a line of its own in the right column, the only one with an id's form.

    A mod's id is found by where it ends, since its beginning isn't known.
    """
    right = [line for line in lines.starting("minecraft:") if not line.is_left]
    if not right:
        right = [line for line in lines.right_column() if _NAMESPACED.fullmatch(line.text)]
    if len(right) != 1:
        raise Unreadable(f"{len(right)} lines may be the id of the block looked at: {CLEAR}")
    return _id_of(lines, right[0])


def _id_of(lines: DebugLines, line: Line) -> str:
    # Bright specks of the world may stand just left of the box, where a glyph could be: the game's own namespace shows
    # where the id begins, and a part of that namespace shows that the id is partly covered.
    before = max(0, line.text.rfind("minecraft:"))
    form = _ID.fullmatch(line.text, before)
    if form is None or (form[2] != "minecraft" and "minecraft".endswith(form[2])):
        raise Unreadable(f"the id of the block looked at reads {shown(line.text)}: {CLEAR}")
    whole = cut_to(lines, line, line.text[:before] + form[1])
    check_whole(whole)
    check_nothing_over(lines, whole)
    return form[1]


def _check_nothing_hidden(lines: DebugLines) -> None:
    for part in _PARTS:
        if lines.holds(part):
            raise Unreadable(f"of the block looked at only {part.strip()!r} can be seen: {CLEAR}")
    if lines.layout.has_target_column:
        _check_target_column_is_empty(lines)
    else:
        _check_no_id_alone(lines)
        _check_column_is_seen(lines)


def _check_column_is_seen(lines: DebugLines) -> None:
    """Raise Unreadable unless the right column is seen where a block's lines would stand, and no fluid is looked at."""
    for label in _FLUIDS:
        if lines.holds(label):
            raise Unreadable(f"a fluid is looked at, and the lines of the block behind it can't be seen: {CLEAR}")
    shown_by_all = () if _has_free_order(lines) else _ALWAYS
    is_hidden = not all(any(not line.is_left for line in lines.starting(label)) for label in shown_by_all)
    if is_hidden or lines.may_be_covered():
        raise Unreadable(f"a notice may lie over the lines of the block looked at: wait until it is gone, or {CLEAR}")


def _has_free_order(lines: DebugLines) -> bool:
    """Return whether the lines can be chosen in this version; without its own line they were chosen already."""
    title = next((line for line in lines.starting(TITLE) if line.is_left), None)
    return title is None or (version_in(title.text) or ()) >= _FREE_ORDER


def _check_no_id_alone(lines: DebugLines) -> None:
    """Raise Unreadable for an id without the block's label over it: a covered one, a fluid's or an entity's."""
    for line in lines.starting("minecraft:"):
        full, over = lines.ending(line.row, line.end), line.row - lines.layout.pitch
        if full is None or not _ALONE.fullmatch(full.text):
            continue
        above = lines.at(over, line.start) if full.is_left else lines.ending(over, line.end)
        if above is None or not _OTHER_LABEL.search(above.text):
            raise Unreadable(f"what {shown(line.text)} belongs to can't be seen: {CLEAR}")
    if lines.holds("#minecraft:") and not lines.holds("Targeted "):
        raise Unreadable(f"which block the tags in the right column belong to can't be seen: {CLEAR}")


_NAME = re.compile(r"[a-z0-9_]+")
_PROPERTY = re.compile(rf"[{UNKNOWN}a-z_0-9]+: .*")

_MOST_PROPERTIES = 12
"""Lines between a block's name and its position: no block has more properties."""


def _id_above(lines: DebugLines, looking: Line) -> str:
    """Return the id of the block whose position is in the line ``looking``.

    Every line of that column ends where its first one does, so a position that ends elsewhere is not seen whole.
    """
    if looking.end != _first_on_the_right(lines).end:
        raise Unreadable(f"the end of {shown(looking.text)} may be covered: {CLEAR}")
    for above in range(1, _MOST_PROPERTIES + 1):
        line = lines.ending(looking.row - above * lines.layout.pitch, looking.end)
        if line is not None and not line.has_value and _NAME.fullmatch(line.text):
            check_whole(line)
            return line.text
        if line is not None and not _PROPERTY.fullmatch(line.text):
            raise Unreadable(f"the block's name reads {shown(line.text)}: {CLEAR}")
    raise Unreadable(f"the name of the block looked at can't be seen: {CLEAR}")


def _check_target_column_is_empty(lines: DebugLines) -> None:
    """Raise Unreadable unless the right column's first line is alone, as when no block is looked at."""
    first, pitch = _first_on_the_right(lines), lines.layout.pitch
    for row in range(first.row + 2 * pitch - 1, first.row + (_MOST_PROPERTIES + 4) * pitch, pitch):
        line = lines.ending(row, first.end)
        if line and len(line.text.replace(UNKNOWN, "")) > 1:
            raise Unreadable(f"what {shown(line.text)} in the right column belongs to can't be seen: {CLEAR}")


def _first_on_the_right(lines: DebugLines) -> Line:
    first = only_line(lines, "Renderer: ")
    if first is None:
        raise Unreadable(f"the upper right of the debug screen can't be seen: {CLEAR}")
    return first


BOX_TITLE = "Looking At Block"
_OTHER_TITLES = ("Looking At Fluid", "Looking At Entity")

_PARTS_OF_TITLE = ("Looking At B", "king At Bl", "ng At Block")
"""Parts of the title, either half of which may be covered."""

_PLACE, _KIND = "Coordinates:", "Type:"

_COORDINATES = re.compile(rf"(Coordinates: {WHOLE}, {WHOLE}, {WHOLE}){_BESIDE}")
_TYPE = re.compile(rf"(Type: ([a-z0-9_.-]+:[a-z0-9_./-]+)){_BESIDE}")

_NAMES = 60
"""Dots between the beginnings of the two names, which end in one column, are fewer: the other column is farther off."""

_RANGE = 23
"""Blocks from the player's feet within which the block is: 20 from the eyes, and a part of itself."""

_LEAST = 6
"""A number of so much or more that lost its last digit is out of that range."""


def target_in_box(lines: DebugLines, player: XYZ) -> Target | None:
    """Return the block that a player at ``player`` looks at, or None. Raise Unreadable where that isn't sure."""
    title = only_line(lines, BOX_TITLE)
    if title is None:
        _check_no_box_hidden(lines)
        return None
    cut_to(lines, title, BOX_TITLE)
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
    """Return the fact of a name in this row, of the box whose title that is."""
    found = [line for line in lines.starting(label) if line.row == row and abs(line.start - start) <= _NAMES]
    if len(found) != 1:
        raise Unreadable(
            f"below {title.text!r} no {label.strip(':')} can be seen: switch minecraft:looking_at_block_state on "
            f"(F3+F6), or {CLEAR}"
        )
    return found[0]


def _check_no_box_hidden(lines: DebugLines) -> None:
    for part in _PARTS_OF_TITLE:
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
