"""The block looked at, as each version's debug screen shows it (FACTS: The F3 debug screen).

| version   | place                                           | id                                            |
| 1.8-1.12  | left, ``Looking at: x y z``                     | right, a line of its own                      |
| 1.13-1.15 | left, ``Looking at block: x y z``               | right, the line below ``Targeted Block``      |
| 1.16 on   | either side, ``Targeted Block: x, y, z``        | the line below                                |
| stand-in  | right, ``Looking at: x y z``                    | right, without namespace, over its properties |

Fluids and entities have labels of their own, ``Targeted Fluid``, ``Looking at liquid`` and ``Targeted Entity``.
"No block is looked at" is said only if no part of a block's lines is left that something else may cover.
"""

import re

from mc_nested.live.reading import Block, Target
from mc_nested.live.screen_lines import CLEAR, WHOLE, Screen, Unreadable, check_whole, matched, shown
from mc_nested.live.text_lines import STANDIN_PITCH, UNKNOWN, Line

_BESIDE = rf"(?:[ {UNKNOWN}].*)?"
"""What is read behind a line's end where the world beside its box has the text's colour."""

_TARGETED_AT = re.compile(rf"(Targeted Block: {WHOLE}, {WHOLE}, {WHOLE}){_BESIDE}")
_LOOKING_AT = re.compile(rf"(Looking at(?: block)?: {WHOLE} {WHOLE} {WHOLE}){_BESIDE}")
_NAMESPACED = re.compile(r"([a-z0-9_.-]+):[a-z0-9_./-]+")
_ID = re.compile(rf"(([a-z0-9_.-]+):[a-z0-9_./-]+){_BESIDE}")
_BARE = re.compile(r"[a-z0-9_]+")
_PROPERTY = re.compile(rf"[{UNKNOWN}a-z_0-9]+: .*")
_ALONE = re.compile(rf"(?:.*{UNKNOWN})?minecraft:(?!overworld|the_)[a-z0-9_./-]+")
_OTHER_LABEL = re.compile(r"Targeted (?:Fluid|Entity)")

_PARTS = ("Targeted B", "ted Block", "Looking at b", "king at block", "ooking at:", "ing at: ")
"""Parts of the labels, either half of which may be covered."""

_MOST_PROPERTIES = 12
"""Lines between a block's name and its place in the stand-in: no block has more properties."""


def looked_at(screen: Screen) -> Target | None:
    """The block looked at, or None. Raises Unreadable if its lines are there, but not to be read for sure."""
    targeted = screen.line("Targeted Block")
    if targeted:
        return _targeted(screen, targeted)
    looking = screen.line("Looking at block: ") or screen.line("Looking at: ")
    if looking is None:
        _check_nothing_hidden(screen)
        return None
    place = _place(screen, _LOOKING_AT, looking)
    if looking.text.startswith("Looking at block"):
        raise Unreadable(f"the 'Targeted Block' lines of the block looked at can't be seen: {CLEAR}")
    return Target(place, _id_in_right_column(screen) if screen.is_left(looking) else _id_above(screen, looking))


def _targeted(screen: Screen, targeted: Line) -> Target:
    if targeted.text != "Targeted Block":
        return Target(_place(screen, _TARGETED_AT, targeted), _id_below(screen, targeted))
    looking = screen.line("Looking at block: ")
    if looking is None:
        raise Unreadable(f"the place of the block looked at can't be seen: {CLEAR}")
    return Target(_place(screen, _LOOKING_AT, looking), _id_below(screen, targeted))


def _place(screen: Screen, form: re.Pattern[str], line: Line) -> Block:
    text, x, y, z = matched(form, line)
    check_whole(screen.without_what_follows(line, text))
    return int(x), int(y), int(z)


def _id_below(screen: Screen, label: Line) -> str:
    """1.13 and later: the id stands one line below its label, aligned with it on the column's side."""
    row = label.row + screen.sight.overlay.pitch
    if screen.is_left(label):
        line: Line | None = screen.line_at(row, label.start)
    else:
        line = screen.line_ending(row, label.end)
    if line is None:
        raise Unreadable(f"the id below 'Targeted Block' can't be seen: {CLEAR}")
    return _id_of(screen, line)


def _id_in_right_column(screen: Screen) -> str:
    """1.8 to 1.12: a line of its own in the right column, the only one there that has an id's form.

    A mod's id is found by where it ends, since nobody knows how it begins.
    """
    lines = [screen.line_at(row, column) for row, column in screen.places("minecraft:")]
    right = [line for line in lines if not screen.is_left(line)]
    if not right:
        right = [line for line in screen.right_column() if _NAMESPACED.fullmatch(line.text)]
    if len(right) != 1:
        raise Unreadable(f"{len(right)} lines may be the id of the block looked at: {CLEAR}")
    return _id_of(screen, right[0])


def _id_above(screen: Screen, looking: Line) -> str:
    """The stand-in: the id without a namespace, then the properties, then the place, all in the right column.

    Every line of that column ends where its first one does, so a place that ends elsewhere is not seen whole.
    """
    if looking.end != _first_on_the_right(screen).end:
        raise Unreadable(f"the end of {shown(looking.text)} may be covered: {CLEAR}")
    for lines in range(1, _MOST_PROPERTIES + 1):
        line = screen.line_ending(looking.row - lines * screen.sight.overlay.pitch, looking.end)
        if line is not None and not line.has_value and _BARE.fullmatch(line.text):
            check_whole(line)
            return line.text
        if line is not None and not _PROPERTY.fullmatch(line.text):
            raise Unreadable(f"the block's name reads {shown(line.text)}: {CLEAR}")
    raise Unreadable(f"the name of the block looked at can't be seen: {CLEAR}")


def _id_of(screen: Screen, line: Line) -> str:
    # Bright specks of the world may stand just left of the box, where a glyph could be: the game's own namespace tells
    # where the id begins, and a part of it that some of it is covered.
    before = max(0, line.text.rfind("minecraft:"))
    form = _ID.fullmatch(line.text, before)
    if form is None or (form[2] != "minecraft" and "minecraft".endswith(form[2])):
        raise Unreadable(f"the id of the block looked at reads {shown(line.text)}: {CLEAR}")
    check_whole(screen.without_what_follows(line, line.text[:before] + form[1]))
    return form[1]


def _check_nothing_hidden(screen: Screen) -> None:
    for part in _PARTS:
        if screen.places(part):
            raise Unreadable(f"of the block looked at only {part.strip()!r} can be seen: {CLEAR}")
    if screen.sight.overlay.pitch == STANDIN_PITCH:
        _check_right_column_is_empty(screen)
    else:
        _check_no_id_alone(screen)


def _check_right_column_is_empty(screen: Screen) -> None:
    """The stand-in's right column holds nothing but its first line when no block is looked at."""
    first = _first_on_the_right(screen)
    pitch = screen.sight.overlay.pitch
    for row in range(first.row + 2 * pitch - 1, first.row + (_MOST_PROPERTIES + 4) * pitch, pitch):
        line = screen.line_ending(row, first.end)
        if line and len(line.text.replace(UNKNOWN, "")) > 1:
            raise Unreadable(f"what {shown(line.text)} in the right column belongs to can't be seen: {CLEAR}")


def _first_on_the_right(screen: Screen) -> Line:
    first = screen.line("Renderer: ")
    if first is None:
        raise Unreadable(f"the upper right of the debug screen can't be seen: {CLEAR}")
    return first


def _check_no_id_alone(screen: Screen) -> None:
    """An id without the block's label over it: that is covered, or the id is a fluid's or an entity's."""
    for row, column in screen.places("minecraft:"):
        line = screen.line_at(row, column)
        full, over = screen.line_ending(row, line.end), row - screen.sight.overlay.pitch
        if full is None or not _ALONE.fullmatch(full.text):
            continue
        above = screen.line_at(over, line.start) if screen.is_left(full) else screen.line_ending(over, line.end)
        if above is None or not _OTHER_LABEL.search(above.text):
            raise Unreadable(f"what {shown(line.text)} belongs to can't be seen: {CLEAR}")
    if screen.places("#minecraft:") and not screen.places("Targeted "):
        raise Unreadable(f"which block the tags in the right column belong to can't be seen: {CLEAR}")
